#include "upsample/scene.h"

#include <random>

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

void append_row(Random& random, std::size_t number, std::size_t motions, InfluenceRows& rows) {
    const std::size_t used = number % 4 == 3 ? 1 : number % 5 == 4 ? 5 : influences_per_row;
    double weight[influences_per_row] = {};
    double sum = 0;
    for (std::size_t k = 0; k < used; ++k) sum += weight[k] = between(random, 0.01, 1);
    Index first = 0;
    for (std::size_t k = 0; k < influences_per_row; ++k) {
        const auto sample = static_cast<Index>(random() % motions);
        if (k == 0) first = sample;
        rows.sample.push_back(k < used ? sample : first);
        rows.weight.push_back(static_cast<float>(weight[k] / sum));
    }
}

Eigen::Matrix<double, 3, 4> exact_blend(const Scene& scene, std::size_t point) {
    Eigen::Matrix<double, 3, 4> sum = Eigen::Matrix<double, 3, 4>::Zero();
    for (std::size_t k = 0; k < influences_per_row; ++k) {
        const std::size_t place = influences_per_row * scene.row[point] + k;
        const Eigen::Map<const Eigen::Matrix<float, 3, 4, Eigen::RowMajor>> map(
            scene.motions[scene.rows.sample[place]].map);
        sum += static_cast<double>(scene.rows.weight[place]) * map.cast<double>();
    }
    return sum;
}

} // namespace

Scene random_scene(std::size_t points, std::size_t motions, unsigned seed, bool with_normals) {
    Random random(seed);
    Scene scene;
    const std::size_t rows =
        points == 0 ? 0 : points / 2 + 1; // rows are shared, and not in the points' order
    for (std::size_t r = 0; r < rows; ++r) append_row(random, r, motions, scene.rows);
    for (std::size_t i = 0; i < points; ++i) {
        append(in_cube(random), scene.positions);
        if (with_normals) append((in_cube(random) + Vec3d(0, 0, 1.5)).normalized(), scene.normals);
        scene.row.push_back(static_cast<Index>(random() % rows));
    }
    for (std::size_t m = 0; m < motions; ++m) {
        const Vec3d axis = (in_cube(random) + Vec3d(0, 1.5, 0)).normalized();
        const Mat3d turn = Eigen::AngleAxisd(between(random, 0, 3.1), axis).toRotationMatrix();
        scene.motions.push_back(motion_of(turn, in_cube(random)));
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
    upsampler.run(scene.motions, posed.positions, posed.normals);
    return posed;
}

Vec3d exact_position(const Scene& scene, std::size_t point) {
    const Eigen::Matrix<double, 3, 4> map = exact_blend(scene, point);
    const Vec3d p = at(scene.positions, point);
    return p + map.leftCols<3>() * p + map.col(3);
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
