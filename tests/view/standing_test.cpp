#include "view/standing.h"

#include "io/cloud_file.h"
#include "shapes/shapes.h"
#include "support/scans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace knead {
namespace {

// The same cloud with y where z was, so that it stands along y.
std::vector<float> turned(std::vector<float> positions) {
    for (std::size_t i = 0; i < positions.size(); i += 3) {
        std::swap(positions[i + 1], positions[i + 2]);
        positions[i + 2] *= -1;
    }
    return positions;
}

std::vector<float> made(Shape shape, std::size_t points = 6000) {
    Workers workers(2);
    SilentProgress progress;
    ShapeOptions options;
    options.points = points;
    return make_shape(shape, options, workers, progress).positions;
}

std::optional<UpAxis> standing_of(const std::vector<float>& positions) {
    return standing_axis(positions, Vec3d::Zero());
}

TEST(Standing, IsToldByTheGround) {
    for (const std::size_t points : {6000U, 200'000U}) // of the latter not all are looked at
        for (const Shape shape : {Shape::cylinder, Shape::plane}) {
            const std::vector<float> positions = made(shape, points);
            EXPECT_EQ(standing_of(positions), UpAxis::z);
            EXPECT_EQ(standing_of(turned(positions)), UpAxis::y);
        }
}

TEST(Standing, IsNotToldOfWhatStandsEitherWayOrNot) {
    EXPECT_EQ(standing_of({}), std::nullopt);
    EXPECT_EQ(standing_of(std::vector<float>{1, 2, 3}), std::nullopt);
    EXPECT_EQ(standing_of(std::vector<float>(300, 1)), std::nullopt);
    EXPECT_EQ(standing_of(made(Shape::sphere)), std::nullopt);
    EXPECT_EQ(standing_of(made(Shape::bar)), std::nullopt) << "a face below, whichever way";
}

// A pyramid that stands on its base, whatever is up there.
TEST(Standing, IsToldOfWhatStandsUpsideDown) {
    std::vector<float> positions;
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j) {
            const float x = static_cast<float>(i) - 19.5F, z = static_cast<float>(j) - 19.5F;
            for (const float y : {20 - std::max(std::abs(x), std::abs(z)), 0.0F})
                positions.insert(positions.end(), {x, y, z});
        }
    EXPECT_EQ(standing_of(positions), UpAxis::y);
    for (std::size_t i = 1; i < positions.size(); i += 3) positions[i] *= -1;
    EXPECT_EQ(standing_of(positions), UpAxis::minus_y);
}

TEST(Standing, IsNotChangedByStrays) {
    std::vector<float> positions = turned(made(Shape::cylinder));
    std::mt19937 random(1);
    std::uniform_real_distribution<float> anywhere(-50, 50);
    for (int i = 0; i < 3 * 15; ++i) positions.push_back(anywhere(random));
    EXPECT_EQ(standing_of(positions), UpAxis::y);
}

// A wall that leans, as of a terrain that one side alone is seen of: by its ground it would stand along y.
TEST(Standing, IsUpwardsInCoordinatesOfASurvey) {
    const std::vector<float> positions = turned(made(Shape::plane));
    EXPECT_EQ(standing_axis(positions, {463'000, 5'427'000, 320}), UpAxis::z);
    EXPECT_EQ(standing_axis(positions, {20, -30, 1}), UpAxis::y) << "no farther away than a tripod";
    EXPECT_EQ(standing_axis(positions, {5000, 5000, 5000}), UpAxis::y) << "nor is up anywhere";
}

TEST(Standing, IsThatOfScans) {
    const std::pair<const char*, std::optional<UpAxis>> scans[] = {
        {"bunny.ply", UpAxis::y},
        {"armadillo_86k.ply", UpAxis::y},
        {"dragon.ply", UpAxis::y},
        {"horse_48k.ply", UpAxis::z},
        {"lion_takanawa_342k.ply", UpAxis::z},
        {"pcl_room_scan1.ply", UpAxis::z},
        {"open3d_fragment_196k.ply", UpAxis::minus_y},
    };
    for (const auto& [name, up] : scans) {
        KNEAD_SCAN_OR_SKIP(path, name);
        SilentProgress progress;
        const PointCloud cloud = read_cloud(path, progress);
        EXPECT_EQ(standing_axis(cloud.positions, cloud.origin), up) << name;
    }
}

} // namespace
} // namespace knead
