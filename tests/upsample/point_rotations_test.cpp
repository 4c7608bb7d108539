// How points turn with what moves them.

#include "upsample/point_rotations.h"

#include "upsample/scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace knead::test {
namespace {

Quatd turn_at(const std::vector<float>& rotations, std::size_t i) {
    const auto part = [&](std::size_t at) { return static_cast<double>(rotations[4 * i + at]); };
    return {part(0), part(1), part(2), part(3)};
}

TEST(PointRotations, BlendTurnsOfWhicheverSign) {
    const Scene scene = random_scene(2000, 60, 3);
    const Quatd turn = Quatd(0.2, 0.4, -0.6, 0.5).normalized();
    std::vector<Quatd> turns;
    for (std::size_t m = 0; m < scene.motions.size(); ++m) {
        const Quatd nearly =
            turn * Quatd(Eigen::AngleAxisd(0.01 * static_cast<double>(m % 7), Vec3d::UnitX()));
        turns.emplace_back(m % 2 == 0 ? nearly.coeffs() : Eigen::Vector4d(-nearly.coeffs()));
    }
    Workers workers(2);
    const std::vector<float> rotations = point_rotations(scene.input(), turns, {}, workers);
    for (std::size_t i = 0; i < scene.mover.size(); ++i)
        ASSERT_GT(std::abs(turn_at(rotations, i).dot(turn)), 0.99) << i;
}

TEST(PointRotations, KeepEveryBitWhereNothingTurnsAnyFurther) {
    const Scene scene = random_scene(2000, 60, 4);
    Workers workers(2);
    std::vector<Quatd> turns;
    for (std::size_t m = 0; m < scene.motions.size(); ++m)
        turns.push_back(Quatd(1, 0.1 * static_cast<double>(m), -2, 0.3).normalized());
    const std::vector<float> before = point_rotations(scene.input(), turns, {}, workers);
    const std::vector<Quatd> none(turns.size(), Quatd::Identity());
    EXPECT_EQ(point_rotations(scene.input(), none, before, workers), before);
}

} // namespace
} // namespace knead::test
