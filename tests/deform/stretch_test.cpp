#include "deform/stretch.h"

#include "graph/clouds.h"

#include <gtest/gtest.h>

#include <cmath>

namespace knead {
namespace {

// Σ e eᵀ of random edges, in space or in the plane z = 0, turned.
struct Star {
    std::vector<Vec3d> edges;
    Mat3d spread = Mat3d::Zero();

    Star(std::mt19937& random, bool flat, const Mat3d& turn) {
        for (int k = 0; k < 12; ++k) {
            Vec3d edge = test::random_vector(random);
            if (flat) edge.z() = 0;
            edges.emplace_back(turn * edge);
            spread += edges.back() * edges.back().transpose();
        }
    }

    // Σ (F e - e) eᵀ.
    Mat3d displaced(const Mat3d& map) const {
        Mat3d sum = Mat3d::Zero();
        for (const Vec3d& edge : edges) sum += (map * edge - edge) * edge.transpose();
        return sum;
    }
};

const Mat3d tilt = Eigen::AngleAxisd(0.8, Vec3d(1, 2, 3).normalized()).toRotationMatrix();

TEST(Surroundings, TellASurfaceFromASolid) {
    std::mt19937 random(1);
    const Surroundings surface = surroundings_of(Star(random, true, tilt).spread);
    EXPECT_EQ(surface.thickness, 0);
    const Vec3d normal = tilt.col(2);
    EXPECT_LT((surface.open - normal * normal.transpose()).norm(), 1e-12);
    const Surroundings solid = surroundings_of(Star(random, false, tilt).spread);
    EXPECT_EQ(solid.thickness, 1);
    EXPECT_LT(solid.open.norm(), 1e-12);
    const Surroundings nothing = surroundings_of(Mat3d::Zero());
    EXPECT_EQ(nothing.open, Mat3d::Identity());
    EXPECT_EQ(nothing.inverse, Mat3d::Zero());
}

TEST(Gradient, IsThatOfALinearMap) {
    std::mt19937 random(2);
    const Mat3d map = Mat3d::Identity() + 0.3 * Mat3d::Random();
    const Star solid(random, false, tilt);
    const Mat3d found = gradient_of(surroundings_of(solid.spread), solid.displaced(map), Mat3d::Zero());
    EXPECT_LT((found - (map - Mat3d::Identity())).norm(), 1e-10);
    // Along a surface; across it the sample's own turn decides.
    const Star surface(random, true, tilt);
    const Mat3d turn = Eigen::AngleAxisd(0.5, Vec3d::UnitY()).toRotationMatrix() - Mat3d::Identity();
    const Mat3d along = gradient_of(surroundings_of(surface.spread), surface.displaced(map), turn);
    EXPECT_LT(((along - map + Mat3d::Identity()) * tilt.leftCols<2>()).norm(), 1e-10);
    EXPECT_LT(((along - turn) * tilt.col(2)).norm(), 1e-10);
}

TEST(Gradient, IsExactlyZeroAtRest) {
    std::mt19937 random(3);
    const Star star(random, true, tilt);
    const Surroundings surroundings = surroundings_of(star.spread);
    const Mat3d gradient = gradient_of(surroundings, Mat3d::Zero(), Mat3d::Zero());
    EXPECT_EQ(gradient, Mat3d::Zero());
    EXPECT_EQ(elastic_target(surroundings, gradient, 0.4), Mat3d::Zero());
}

// A strip pulled to `along` whose sides contracted as the material wants: across it, the edges are then
// pulled to where they are, whichever way the strip is turned.
TEST(ElasticTarget, LeavesFreeSidesOfAPulledStripWithoutStress) {
    std::mt19937 random(4);
    for (const bool flat : {true, false})
        for (const double poisson : {-0.95, -0.5, 0.2, 0.45, 0.499})
            for (const double along : {0.6, 1.3, 2.0}) {
                SCOPED_TRACE(std::to_string(flat) + " " + std::to_string(poisson));
                const Surroundings surroundings = surroundings_of(Star(random, flat, tilt).spread);
                const double across = std::pow(along, -poisson);
                const Mat3d stretch =
                    tilt * Vec3d(along, across, flat ? 1 : across).asDiagonal() * tilt.transpose();
                const Mat3d rotated = tilt * stretch; // and turned by something
                const Mat3d target =
                    elastic_target(surroundings, rotated - Mat3d::Identity(), poisson) + Mat3d::Identity();
                EXPECT_LT(((target - stretch) * tilt.col(1)).norm(), 1e-7); // closed-form eigenvalues
                if (!flat) {
                    EXPECT_LT(((target - stretch) * tilt.col(2)).norm(), 1e-7);
                }
                // Along the strip it is pulled back towards where it was.
                const double pulled = tilt.col(0).dot(target * tilt.col(0));
                EXPECT_LT((pulled - along) * (along - 1), 0);
            }
}

TEST(ElasticTarget, IsRestForPoissonsRatioZero) {
    const Mat3d map = 0.4 * Mat3d::Random();
    EXPECT_EQ(elastic_target(Surroundings{}, map, 0), Mat3d::Zero());
}

TEST(ElasticTarget, IsFiniteForWhatHandsCanDo) {
    std::mt19937 random(5);
    for (const bool flat : {true, false}) {
        const Surroundings surroundings = surroundings_of(Star(random, flat, tilt).spread);
        for (const double poisson : {-0.999, 0.499})
            for (const Mat3d& gradient :
                 {Mat3d(-Mat3d::Identity()), Mat3d(1e6 * Mat3d::Identity()), Mat3d(-2 * Mat3d::Identity())})
                EXPECT_TRUE(elastic_target(surroundings, gradient, poisson).allFinite());
    }
}

// A sample sees h = H - c (H - S) of the strain H of the whole, which resists by (1 - c) (H - S): Hooke's law
// of H.
TEST(ElasticTarget, OfLooseEdgesMakesTheWholeObey) {
    for (const double poisson : {-0.7, 0.3, 0.49})
        for (const double part : {0.0, 0.1, 0.3}) {
            SCOPED_TRACE(std::to_string(poisson) + ", " + std::to_string(part));
            Surroundings surface = surroundings_of(Vec3d(1, 1, 0).asDiagonal());
            surface.looseness = part / (1 - part);
            const Mat3d whole = Vec3d(1e-4, 0.3e-4, 0).asDiagonal();
            Mat3d target = Mat3d::Zero();
            for (int step = 0; step < 200; ++step)
                target = elastic_target(surface, whole - part * (whole - target), poisson);
            const Mat3d resisted = (1 - part) * (whole - target);
            const double along = whole(0, 0) + poisson * whole(1, 1),
                         across = whole(1, 1) + poisson * whole(0, 0);
            EXPECT_NEAR(resisted(1, 1) / resisted(0, 0), across / along, 1e-3);
            EXPECT_GT(resisted(0, 0), 0);
        }
}

} // namespace
} // namespace knead
