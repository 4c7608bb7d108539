#include "edit/extent_change.h"

#include "edit/editing.h"

namespace knead {
namespace {

struct Measured {
    ExtentChange change;

    // Of a made shape under a linear map, without any handle.
    Measured(Shape shape, const Mat3d& map, bool with_normals = true) {
        ShapeOptions options;
        options.points = 4000;
        Workers workers(2);
        SilentProgress progress;
        const PointCloud cloud = make_shape(shape, options, workers, progress);
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
        change = extent_change(pipeline.order(), pipeline.graph(), opened.positions, normals, now, workers);
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

TEST(ExtentChange, HasNoVolumeWhereNormalsAreMissing) {
    const Measured sphere(Shape::sphere, 2 * Mat3d::Identity(), false);
    EXPECT_NEAR(sphere.change.area.value(), 3, 1e-3);
    EXPECT_FALSE(sphere.change.volume);
}

} // namespace
} // namespace knead
