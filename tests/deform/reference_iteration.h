#pragma once
// One iteration as sample_system.h writes it for ν = 0, with dense matrices, the singular value decomposition
// and positions instead of displacements: the yardstick for iterate().

#include "deform/sample_rest.h"

#include <Eigen/Dense>

namespace knead::test {

class ReferenceIteration {
public:
    explicit ReferenceIteration(const SampleRest& rest) : rest_(rest) {
        Workers workers(1);
        const Components components = find_components(rest.graph, workers);
        std::vector<bool> held(components.size.size(), false);
        for (Index s = 0; s < rest.graph.size(); ++s)
            if (rest.handle[s] != no_index) held[components.component[s]] = true;
        row_.assign(rest.graph.size(), -1);
        for (Index s = 0; s < rest.graph.size(); ++s) {
            rotation.push_back(Quatd::Identity());
            linear_.push_back(Mat3d::Identity());
            position.push_back(rest.position[s]);
            if (rest.handle[s] != no_index || !held[components.component[s]]) continue;
            row_[s] = static_cast<int>(free_.size());
            free_.push_back(s);
        }
        laplacian_ = assemble_laplacian();
    }

    std::vector<Quatd> rotation;
    std::vector<Vec3d> position;

    // Equation (1) for how far the handles turned since the last frame, then step 3.
    void follow(const std::vector<HandleMotion>& handles) {
        const std::vector<Quatd> before = rotation;
        place(handles);
        std::vector<Quatd> turned(rotation.size(), Quatd::Identity());
        for (Index s = 0; s < rotation.size(); ++s)
            if (rest_.handle[s] != no_index) turned[s] = rotation[s] * before[s].conjugate();
        take(laplacian_.ldlt().solve(neighbours_rotations(turned, 1)));
        for (const Index i : free_) {
            rotation[i] = rotation[i] * before[i];
            linear_[i] = rotation[i].toRotationMatrix();
        }
        find_positions();
    }

    void iterate(const std::vector<HandleMotion>& handles) {
        place(handles);
        const double squared = mean_square_length();
        const double beta = rest_.stiffness * rest_.cloud_size * rest_.cloud_size;
        Eigen::MatrixXd matrix = beta / squared * laplacian_;
        Eigen::MatrixXd side = neighbours_rotations(rotation, beta / squared);
        for (int row = 0; row < matrix.rows(); ++row) {
            const double confidence = star(free_[static_cast<std::size_t>(row)]).lengths / squared;
            matrix(row, row) += confidence;
            const Quatd local = local_rotation(free_[static_cast<std::size_t>(row)]);
            side.row(row) += confidence * components(local).transpose();
        }
        take(matrix.ldlt().solve(side));
        find_positions();
    }

private:
    struct Star {
        double weights = 0; // Σ w
        double lengths = 0; // Σ w |e|²
        Mat3d spread = Mat3d::Zero();
    };

    static Eigen::Vector4d components(const Quatd& q) { return {q.w(), q.x(), q.y(), q.z()}; }

    // Calls visit(j, w_ij, e_ij) for every neighbour of i.
    template<typename Visit>
    void for_links(Index i, Visit&& visit) const {
        for (Index link = rest_.graph.first[i]; link < rest_.graph.first[i + 1]; ++link) {
            const Index j = rest_.graph.neighbor[link];
            visit(j, rest_.weight[link], Vec3d(rest_.position[j] - rest_.position[i]));
        }
    }

    // M_j of a link from i.
    Mat3d linear_of(Index j, Index i) const {
        if (rest_.handle[j] == no_index || rest_.held_part.empty()) return linear_[j];
        double part = 0;
        for (Index link = rest_.graph.first[i]; link < rest_.graph.first[i + 1]; ++link)
            if (rest_.graph.neighbor[link] == j) part = rest_.held_part[link];
        return linear_[j] + 2 * part * (scaled_[rest_.handle[j]] - linear_[j]);
    }

    Star star(Index i) const {
        Star star;
        for_links(i, [&](Index j, double weight, const Vec3d& e) {
            star.weights += weight;
            star.lengths += weight * e.squaredNorm();
            const Mat3d midway = linear_[i] + 0.5 * gamma() * (linear_of(j, i) - linear_[i]);
            const Vec3d expected = midway * e;
            star.spread += weight * (rotation[i] * e + position[j] - position[i] - expected) * e.transpose();
        });
        return star;
    }

    double gamma() const { return std::pow(rest_.stiffness, 2) / (std::pow(rest_.stiffness, 2) + 1e-8); }

    double mean_square_length() const {
        double sum = 0;
        int links = 0;
        for (const Index i : free_)
            for_links(i, [&](Index, double, const Vec3d& e) {
                sum += e.squaredNorm();
                ++links;
            });
        return sum / links;
    }

    Eigen::MatrixXd assemble_laplacian() const {
        const auto size = static_cast<Eigen::Index>(free_.size());
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
        for (const Index i : free_)
            for_links(i, [&](Index j, double weight, const Vec3d&) {
                matrix(row_[i], row_[i]) += weight;
                if (row_[j] >= 0) matrix(row_[i], row_[j]) -= weight;
            });
        return matrix;
    }

    void place(const std::vector<HandleMotion>& handles) {
        scaled_.clear();
        for (const HandleMotion& motion : handles) scaled_.push_back(motion.linear);
        for (Index s = 0; s < rest_.graph.size(); ++s) {
            if (rest_.handle[s] == no_index) continue;
            const HandleMotion& motion = handles[rest_.handle[s]];
            rotation[s] = motion.rotation;
            linear_[s] = motion.rotation.toRotationMatrix();
            position[s] = motion.linear * rest_.position[s] + motion.offset;
        }
    }

    Eigen::MatrixXd neighbours_rotations(const std::vector<Quatd>& given, double factor) const {
        Eigen::MatrixXd side = Eigen::MatrixXd::Zero(laplacian_.rows(), 4);
        for (const Index i : free_)
            for_links(i, [&](Index j, double weight, const Vec3d&) {
                if (row_[j] < 0) side.row(row_[i]) += factor * weight * components(given[j]).transpose();
            });
        return side;
    }

    Quatd local_rotation(Index i) const {
        const Eigen::JacobiSVD<Mat3d> svd(star(i).spread, Eigen::ComputeFullU | Eigen::ComputeFullV);
        Vec3d signs(1, 1, 1);
        if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) signs.z() = -1;
        Quatd local(Mat3d(svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose()));
        if (local.dot(rotation[i]) < 0) local.coeffs() *= -1;
        return local;
    }

    void take(const Eigen::MatrixXd& solved) {
        for (const Index i : free_) {
            const Eigen::Vector4d q = solved.row(row_[i]).transpose().normalized();
            rotation[i] = Quatd(q[0], q[1], q[2], q[3]);
            linear_[i] = rotation[i].toRotationMatrix();
        }
    }

    void find_positions() {
        Eigen::MatrixXd side = Eigen::MatrixXd::Zero(laplacian_.rows(), 3);
        for (const Index i : free_)
            for_links(i, [&](Index j, double weight, const Vec3d& e) {
                side.row(row_[i]) -= weight * (0.5 * (linear_[i] + linear_of(j, i)) * e).transpose();
                if (row_[j] < 0) side.row(row_[i]) += weight * position[j].transpose();
            });
        const Eigen::MatrixXd solved = laplacian_.ldlt().solve(side);
        for (const Index i : free_) position[i] = solved.row(row_[i]).transpose();
    }

    const SampleRest& rest_;
    std::vector<int> row_; // of each sample; -1 where it is not unknown
    std::vector<Index> free_;
    std::vector<Mat3d> linear_;
    std::vector<Mat3d> scaled_; // of each handle
    Eigen::MatrixXd laplacian_;
};

} // namespace knead::test
