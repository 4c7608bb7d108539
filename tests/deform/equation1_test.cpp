// Equation (1) of the paper as it stands, q_j - q_i q_i^j = 0 with frames from the points and their
// quaternion differences, is a Laplacian of the rotations r_i = q_i q̄_i⁰: the same shape from 4m×4m numbers
// and from m×m.

#include "deform/sample_rest.h"
#include "graph/local_frames.h"

#include <Eigen/Dense>

namespace knead {
namespace {

using Eigen::Matrix4d;
using Eigen::MatrixXd;
using Eigen::Vector4d;
using Eigen::VectorXd;

Vector4d components(const Quatd& q) {
    return {q.w(), q.x(), q.y(), q.z()};
}

// The matrix M of q → q p, so that components(q * p) = M components(q).
Matrix4d times(const Quatd& p) {
    Matrix4d matrix;
    const Quatd unit[4] = {Quatd(1, 0, 0, 0), Quatd(0, 1, 0, 0), Quatd(0, 0, 1, 0), Quatd(0, 0, 0, 1)};
    for (int c = 0; c < 4; ++c) matrix.col(c) = components(unit[c] * p);
    return matrix;
}

// Least squares over both directions of every edge of Equation (1), handles' frames given; the frames of the
// free samples, not normalised.
std::vector<Vector4d> frames_by_equation1(const SampleSystem& system, const std::vector<Quatd>& frame,
                                          const std::vector<HandleMotion>& handles) {
    const SampleRest& rest = system.rest;
    const auto unknowns = static_cast<Eigen::Index>(4 * system.free_sample.size());
    MatrixXd normal = MatrixXd::Zero(unknowns, unknowns);
    VectorXd side = VectorXd::Zero(unknowns);
    for (Index i = 0; i < rest.graph.size(); ++i) {
        for (Index link = rest.graph.first[i]; link < rest.graph.first[i + 1]; ++link) {
            const Index j = rest.graph.neighbor[link];
            // Residual q_j - q_i q_i^j with q_i^j = q̄_i⁰ q_j⁰: the coefficients of q_i and of q_j.
            const Matrix4d coefficient[2] = {-times(frame[i].conjugate() * frame[j]), Matrix4d::Identity()};
            const Index end[2] = {i, j};
            for (int a = 0; a < 2; ++a) {
                if (system.unknown[end[a]] == no_index) continue;
                const auto row = static_cast<Eigen::Index>(4 * system.unknown[end[a]]);
                for (int b = 0; b < 2; ++b) {
                    const Matrix4d product = rest.weight[link] * coefficient[a].transpose() * coefficient[b];
                    if (rest.handle[end[b]] == no_index)
                        normal.block<4, 4>(row, static_cast<Eigen::Index>(4 * system.unknown[end[b]])) +=
                            product;
                    else
                        side.segment<4>(row) -=
                            product * components(handles[rest.handle[end[b]]].rotation * frame[end[b]]);
                }
            }
        }
    }
    const VectorXd solution = normal.ldlt().solve(side);
    std::vector<Vector4d> frames;
    for (Eigen::Index at = 0; at < unknowns; at += 4) frames.emplace_back(solution.segment<4>(at));
    return frames;
}

TEST(Equation1, IsTheLaplacianOfTheRotations) {
    const test::Cloud cloud = test::cloud_of(test::shape_positions(Shape::bar, 150));
    SampleSystem system;
    ASSERT_TRUE(test::built(test::rest_of(cloud, test::both_ends(-2, 2)), system).solved);
    Workers workers(2);
    std::vector<Quatd> frame = local_frames(cloud.graph, cloud.positions, workers);
    for (std::size_t v = 0; v < frame.size(); v += 3) frame[v].coeffs() *= -1; // no sign is better
    const std::vector<HandleMotion> handles{
        {}, test::motion_about(Vec3d(1, 2, 3), 130 * test::degrees, Vec3d(0, 0, 2), Vec3d(1, 0, 0))};

    SampleState state = rest_state(system);
    follow_handles(system, handles, state, workers);
    const std::vector<Vector4d> frames = frames_by_equation1(system, frame, handles);
    ASSERT_GT(frames.size(), 50U);
    double largest_turn = 0;
    for (std::size_t row = 0; row < frames.size(); ++row) {
        const Index s = system.free_sample[row];
        // q_i = r_i q_i⁰; knead normalises what it solved. Rounding of a 500 × 500 system.
        const Vector4d rotation = times(frame[s].conjugate()) * frames[row];
        EXPECT_LT((rotation.normalized() - components(state.rotation[s])).norm(), 1e-10);
        largest_turn = std::max(largest_turn, state.rotation[s].angularDistance(Quatd::Identity()));
    }
    EXPECT_GT(largest_turn, 1) << "the test means something to be turned";
}

} // namespace
} // namespace knead
