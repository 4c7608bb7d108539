#include "edit/extent_change.h"

#include "edit/editing.h"

namespace knead {
namespace {

using namespace test;

struct Measured {
    ExtentChange change;

    // Of a cloud under a linear map, without any handle.
    Measured(Shape shape, const Mat3d& map, bool with_normals = true)
        : Measured(made(shape, 4000), map, with_normals) {}
    Measured(const PointCloud& cloud, const Mat3d& map, bool with_normals = true) {
        Workers workers(2);
        SilentProgress progress;
        const auto upsampler = make_reference_upsampler(workers);
        Pipeline pipeline(cloud, workers, *upsampler);
        pipeline.prepare_ahead(Settings{}, progress);
        const RestShape& opened = pipeline.opened();
        std::vector<float> now;
        for (std::size_t i = 0; i < opened.positions.size(); i += 3) {
            const Vec3f p = Eigen::Map<const Vec3f>(opened.positions.data() + i);
            const Vec3f moved = (map * p.cast<double>()).cast<float>();
            now.insert(now.end(), moved.begin(), moved.end());
        }
        const LineArray<float> normals = with_normals ? opened.normals : LineArray<float>{};
        change = extent_change(pipeline.standing_points(), pipeline.graph(), opened.positions, normals, now,
                               workers);
    }
};

TEST(ExtentChange, IsNothingAtRest) {
    const Measured same(Shape::sphere, Mat3d::Identity());
    EXPECT_NEAR(same.change.area.value(), 0, 1e-9);
    EXPECT_NEAR(same.change.volume.value(), 0, 1e-9);
}

TEST(ExtentChange, IsThatOfALinearMap) {
    const Mat3d map = Vec3d(1.2, 0.9, 1.5).asDiagonal();
    EXPECT_NEAR(Measured(Shape::sphere, map).change.volume.value(), 1.2 * 0.9 * 1.5 - 1, 1e-3);
    EXPECT_NEAR(Measured(Shape::bar, map).change.volume.value(), 1.2 * 0.9 * 1.5 - 1, 1e-2);
    const Measured solid(Shape::solid_bar, map);
    EXPECT_NEAR(solid.change.volume.value(), 1.2 * 0.9 * 1.5 - 1, 1e-3);
    EXPECT_FALSE(solid.change.area);
    // The bar's long sides in the ratio 1 : 1, its caps are a tenth as large as one.
    const double sides = 10 * (1.2 * 1.5 + 0.9 * 1.5), caps = 2 * 1.2 * 0.9;
    EXPECT_NEAR(Measured(Shape::bar, map).change.area.value(), (sides + caps) / 22 - 1, 0.01);
}

TEST(ExtentChange, OfAnOpenSurfaceIsItsArea) {
    const Measured plane(Shape::plane, 2 * Mat3d::Identity());
    EXPECT_NEAR(plane.change.area.value(), 3, 1e-3);
    EXPECT_FALSE(plane.change.volume);
}

TEST(ExtentChange, OfHalfASphereIsItsArea) {
    const PointCloud sphere = made(Shape::sphere, 8000);
    std::vector<float> positions;
    for (std::size_t i = 0; i < sphere.positions.size(); i += 3)
        if (sphere.positions[i + 2] > 0)
            positions.insert(positions.end(), &sphere.positions[i], &sphere.positions[i] + 3);
    PointCloud half = make_cloud(positions);
    const char* const names[] = {"nx", "ny", "nz"}; // which point away from the middle
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<float> component;
        for (std::size_t i = axis; i < positions.size(); i += 3) component.push_back(positions[i]);
        add_attribute(half, names[axis], component);
    }
    const Measured bowl(half, 2 * Mat3d::Identity());
    EXPECT_NEAR(bowl.change.area.value(), 3, 1e-3);
    EXPECT_FALSE(bowl.change.volume);
}

TEST(ExtentChange, HasNoVolumeWhereNormalsAreMissing) {
    const Measured sphere(Shape::sphere, 2 * Mat3d::Identity(), false);
    EXPECT_NEAR(sphere.change.area.value(), 3, 1e-3);
    EXPECT_FALSE(sphere.change.volume);
}

} // namespace
} // namespace knead
