#include "upsample/scene.h"

#include "graph/balanced_weights.h"

#include <Eigen/LU>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

namespace knead::test {

namespace {

using Random = std::mt19937;

double between(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3d in_cube(Random& random) {
    const double x = between(random, -1, 1);
    const double y = between(random, -1, 1);
    return {x, y, between(random, -1, 1)};
}

void append(const Vec3d& v, std::vector<float>& packed) {
    for (int i = 0; i < 3; ++i) packed.push_back(static_cast<float>(v[i]));
}

NarrowRow random_row(Random& random, std::size_t number, std::size_t motions) {
    NarrowRow row;
    row.sample.fill(NarrowRow::none);
    row.distance.fill(NarrowRow::none);
    const std::size_t wanted = number % 4 == 3 ? 1 : number % 5 == 4 ? 5 : influences_per_row;
    const std::size_t used = std::min(wanted, motions); // each at most once
    const std::size_t first = random();
    std::multiset<std::uint16_t> distances;
    for (std::size_t k = 0; k < used; ++k) {
        row.sample.at(k) = static_cast<std::uint16_t>((first + k) % motions);
        distances.insert(static_cast<std::uint16_t>(number % 11 == 5 ? 7 : 1 + random() % 3000));
    }
    std::ranges::copy(distances, row.distance.begin());
    if (number % 13 == 6) row.distance[0] = 0;
    return row;
}

Vec3d place_of(const Scene& scene, std::size_t motion, const Vec3d& p) {
    return motion < scene.places.size() ? scene.places[motion] : p;
}

// What graph/balanced_weights.h says, in double. The weights sum to 1 before and after.
void balance_exactly(const Scene& scene, const WideRow& row, const Vec3d& p, std::vector<double>& weight) {
    Vec3d mean = Vec3d::Zero();
    double square_reach = 0;
    for (std::size_t k = 0; k < row.count(); ++k)
        square_reach += (place_of(scene, row.sample.at(k), p) - p).squaredNorm() / double{influences_per_row};
    if (square_reach == 0) return;
    for (std::size_t k = 0; k < weight.size(); ++k) mean += weight[k] * place_of(scene, row.sample.at(k), p);
    Mat3d spread =
        (double{balance_ridge} * square_reach + double{balance_caution} * (p - mean).squaredNorm()) *
        Mat3d::Identity();
    for (std::size_t k = 0; k < weight.size(); ++k) {
        const Vec3d arm = place_of(scene, row.sample.at(k), p) - mean;
        spread += weight[k] * arm * arm.transpose();
    }
    const Vec3d lean = spread.inverse() * (p - mean);
    double sum = 0;
    for (std::size_t k = 0; k < weight.size(); ++k) {
        const Vec3d arm = place_of(scene, row.sample.at(k), p) - mean;
        const double factor = std::max(0.0, 1 + lean.dot(arm) / 2);
        sum += weight[k] *= factor * factor;
    }
    for (double& w : weight) w /= sum;
}

// What graph/influences.h says of the weights, in double.
std::vector<double> exact_weights_by_distance(const WideRow& row, Index first_handle, InfluenceWeights kind) {
    std::vector<double> weight;
    const double farthest = row.count() > 0 ? row.distance.at(row.count() - 1) : 0;
    for (std::size_t k = 0; k < row.count(); ++k) {
        const double d = row.distance.at(k);
        const double nearness = row.count() < influences_per_row ? 2 - d / farthest : 1 - d / farthest;
        const bool of_handle = row.sample.at(k) >= first_handle;
        const double grows = of_handle ? static_cast<double>(handle_reach) * farthest / d : 1;
        weight.push_back(kind == InfluenceWeights::paper ? 1 / (d * d) : grows * nearness * nearness);
    }
    const bool alone = kind == InfluenceWeights::paper || row.sample[0] >= first_handle;
    if (row.distance[0] == 0 && (alone || farthest == 0)) weight = {1};
    double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
    if (sum == 0) weight.assign(row.count(), 1), sum = static_cast<double>(row.count());
    for (double& w : weight) w /= sum;
    return weight;
}

std::vector<double> exact_weights(const Scene& scene, const WideRow& row, const Vec3d& p) {
    std::vector<double> weight = exact_weights_by_distance(row, scene.rows.first_handle, scene.weights);
    if (scene.weights == InfluenceWeights::smooth) balance_exactly(scene, row, p, weight);
    return weight;
}

Eigen::Matrix<double, 3, 4> matrix_of(const Motion& motion) {
    return Eigen::Map<const Eigen::Matrix<float, 3, 4, Eigen::RowMajor>>(motion.map).cast<double>();
}

Eigen::Matrix<double, 3, 4> exact_blend(const Scene& scene, std::size_t point) {
    Eigen::Matrix<double, 3, 4> sum = Eigen::Matrix<double, 3, 4>::Zero();
    const auto add = [&](double weight, std::size_t motion) {
        sum += weight * matrix_of(scene.motions.at(motion));
    };
    const std::size_t mover = scene.mover[point];
    if (mover >= scene.rows.size()) {
        add(1, mover - scene.rows.size());
        return sum;
    }
    const WideRow row = scene.rows[mover];
    const std::vector<double> weights = exact_weights(scene, row, at(scene.positions, point));
    for (std::size_t k = 0; k < weights.size(); ++k) add(weights[k], row.sample.at(k));
    return sum;
}

} // namespace

Scene random_scene(std::size_t points, std::size_t motions, unsigned seed, bool with_normals) {
    Random random(seed);
    Scene scene;
    const std::size_t rows =
        points == 0 ? 0 : points / 2 + 1; // rows are shared, and not in the points' order
    std::vector<NarrowRow> narrow;
    for (std::size_t r = 0; r < rows; ++r) narrow.push_back(random_row(random, r, motions));
    scene.rows.rows = narrow;
    scene.rows.first_handle = static_cast<Index>(motions - motions / 5);
    for (std::size_t i = 0; i < points; ++i) {
        append(in_cube(random), scene.positions);
        if (with_normals) append((in_cube(random) + Vec3d(0, 0, 1.5)).normalized(), scene.normals);
        scene.mover.push_back(static_cast<Index>(i % 7 == 4 ? rows + random() % motions : random() % rows));
    }
    for (std::size_t m = 0; m < motions; ++m) {
        const Vec3d axis = (in_cube(random) + Vec3d(0, 1.5, 0)).normalized();
        const Mat3d turn = Eigen::AngleAxisd(between(random, 0, 3.1), axis).toRotationMatrix();
        scene.motions.push_back(motion_of(turn, in_cube(random)));
        if (m >= scene.rows.first_handle) continue;
        scene.places.push_back(in_cube(random));
    }
    return scene;
}

Motion motion_of(const Mat3d& linear, const Vec3d& shift) {
    Motion motion;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j)
            motion.map[4 * i + j] = static_cast<float>(j == 3 ? shift[i] : linear(i, j) - (i == j ? 1 : 0));
    return motion;
}

Posed upsampled(Upsampler& upsampler, const Scene& scene) {
    Posed posed;
    posed.positions.assign(scene.positions.size(), -1);
    posed.normals.assign(scene.normals.size(), -1);
    upsampler.prepare(scene.input(), scene.motions.size());
    upsampler.run(scene.motions, posed.positions, posed.normals, Held::nothing);
    return posed;
}

Vec3d exact_position(const Scene& scene, std::size_t point) {
    const Eigen::Matrix<double, 3, 4> map = exact_blend(scene, point);
    const Vec3d p = at(scene.positions, point);
    const std::size_t mover = scene.mover[point];
    if (scene.weights == InfluenceWeights::paper || mover >= scene.rows.size())
        return p + map.leftCols<3>() * p + map.col(3);
    const WideRow row = scene.rows[mover];
    const std::vector<double> weights = exact_weights(scene, row, p);
    Vec3d displacement = Vec3d::Zero();
    for (std::size_t k = 0; k < weights.size(); ++k) {
        const auto own = matrix_of(scene.motions[row.sample.at(k)]);
        const Vec3d place = place_of(scene, row.sample.at(k), p);
        const Vec3d moved = own.leftCols<3>() * place + own.col(3); // x_s - p_s
        displacement += weights[k] * (moved + 0.5 * (own + map).leftCols<3>() * (p - place));
    }
    return p + displacement;
}

Vec3d exact_turned(const Scene& scene, std::size_t point) {
    const Mat3d linear = Mat3d::Identity() + exact_blend(scene, point).leftCols<3>();
    const Vec3d n = at(scene.normals, point);
    Mat3d cofactor;
    cofactor << linear.col(1).cross(linear.col(2)), linear.col(2).cross(linear.col(0)),
        linear.col(0).cross(linear.col(1));
    return cofactor * n;
}

Vec3d at(const std::vector<float>& packed, std::size_t i) {
    return Eigen::Map<const Vec3f>(&packed[3 * i]).cast<double>();
}

} // namespace knead::test
