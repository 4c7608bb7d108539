#include "graph/clouds.h"
#include "graph/local_frames.h"

#include <cmath>

namespace knead {
namespace {

using test::Cloud;
using test::Machine;

std::vector<Quatd> frames_of(const Cloud& cloud, unsigned threads = 2) {
    Machine machine(threads);
    return local_frames(cloud.graph, cloud.positions, machine.workers);
}

TEST(LocalFrames, AreRotations) {
    for (const auto& [name, cloud] : test::several_clouds()) {
        SCOPED_TRACE(name);
        for (const Quatd& frame : frames_of(cloud)) {
            ASSERT_NEAR(frame.norm(), 1, 1e-12); // rounding only
            ASSERT_NEAR(frame.toRotationMatrix().determinant(), 1, 1e-12);
        }
    }
}

TEST(LocalFrames, OfAPlaneStandOnIt) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::plane, 2000));
    for (const Quatd& frame : frames_of(cloud))
        EXPECT_NEAR(std::abs((frame * Vec3d::UnitZ()).z()), 1, 1e-9); // all z are 0: rounding only
}

TEST(LocalFrames, OfASphereFollowItsNormals) {
    // Neighbours lie about 0.05 away, so that the surface bends by some hundredths between them; a lopsided
    // neighbourhood tilts the frame by as much.
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::sphere, 5000), 10);
    const std::vector<Quatd> frames = frames_of(cloud);
    for (std::size_t v = 0; v < cloud.size(); ++v) {
        const Vec3d normal = frames[v] * Vec3d::UnitZ();
        EXPECT_GT(std::abs(normal.dot(cloud.at(v).normalized())), std::cos(0.1));
    }
}

TEST(LocalFrames, HaveTheirFirstAxisAlongTheLargestSpread) {
    const Cloud cloud = test::cloud_of(test::grid_positions(60, 2), 8); // a ribbon along x
    for (const Quatd& frame : frames_of(cloud))
        EXPECT_NEAR(std::abs((frame * Vec3d::UnitX()).x()), 1, 0.05); // its ends are a little askew
}

TEST(LocalFrames, OfALonelyVertexAreTheIdentity) {
    const Cloud cloud = test::cloud_of({1, 2, 3});
    EXPECT_TRUE(frames_of(cloud)[0].isApprox(Quatd::Identity(), 0));
}

TEST(LocalFrames, AreTheSameForAnyNumberOfThreads) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 5000));
    const std::vector<Quatd> one = frames_of(cloud, 1);
    const std::vector<Quatd> five = frames_of(cloud, 5);
    for (std::size_t v = 0; v < one.size(); ++v) ASSERT_EQ(one[v].coeffs(), five[v].coeffs());
}

} // namespace
} // namespace knead
