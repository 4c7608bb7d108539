#include "deform/bodies.h"

#include "graph/clouds.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace knead {
namespace {

// Some bodies, and what they do in plain matrices; and pairs of a sample with some of them.
struct Plain {
    std::vector<Body> body;
    std::vector<Vec3d> way;
    std::vector<Mat3d> map, turn;
    PointEnergy energy;

    Plain() {
        std::mt19937 random(1);
        const auto matrix = [&] {
            Mat3d result;
            for (int k = 0; k < 3; ++k) result.col(k) = test::random_vector(random);
            return result;
        };
        for (Index s = 0; s < 40; ++s) {
            way.push_back(test::random_vector(random));
            map.push_back(matrix());
            turn.push_back(matrix());
            body.push_back({});
            set_four(way[s], body[s].way);
            set_columns(map[s], body[s].map);
            set_columns(turn[s], body[s].turn);
            body[s].placed = s % 3 == 0;
        }
        energy.first = {0, 5, 5, 18}; // of a sample before, of one without any, and of the one below
        for (Index at = 0; at < energy.first.back(); ++at) {
            energy.body.push_back(2 * at + 1);
            energy.pair.push_back({test::random_vector(random).x(), 7, test::random_vector(random),
                                   test::random_vector(random)});
            energy.slopes.push_back({test::random_vector(random), matrix(), matrix()});
            energy.fits.push_back({test::random_vector(random), matrix()});
            energy.map_products.push_back(matrix());
        }
    }
};

TEST(Bodies, AddUpToTheSumOfStepOne) {
    const Plain plain;
    const PointEnergy& energy = plain.energy;
    const double midway = 0.75;
    Mat3d expected = Mat3d::Zero();
    for (Index at = energy.first[2]; at < energy.first[3]; ++at) {
        const Index s = energy.body[at];
        const PairSlopes& slopes = energy.slopes[at];
        expected += plain.way[s] * slopes.way_slope.transpose() + plain.map[s] * slopes.map_slope -
                    midway * plain.turn[s] * slopes.target_spread;
    }
    EXPECT_LT((local_sum_of(bodies_around(energy, plain.body, 2), midway) - expected).norm(), 1e-13);
    EXPECT_EQ(local_sum_of(bodies_around(energy, plain.body, 1), midway), Mat3d(Mat3d::Zero()));
}

TEST(Bodies, AddUpToTheForceOfStepThree) {
    const Plain plain;
    const PointEnergy& energy = plain.energy;
    Vec3d expected = Vec3d::Zero();
    for (Index at = energy.first[2]; at < energy.first[3]; ++at) {
        const Index s = energy.body[at];
        const BodyPair& pair = energy.pair[at];
        expected -= plain.map[s] * pair.map_force - plain.turn[s] * pair.target_force;
        if (s % 3 == 0) expected -= pair.way * plain.way[s];
    }
    EXPECT_LT((force_of(bodies_around(energy, plain.body, 2)) - expected).norm(), 1e-13);
    EXPECT_EQ(force_of(bodies_around(energy, plain.body, 1)), Vec3d(Vec3d::Zero()));
}

TEST(Bodies, AddUpToTheMisfitOfMaps) {
    const Plain plain;
    const PointEnergy& energy = plain.energy;
    Mat3d expected = Mat3d::Zero();
    for (Index at = energy.first[2]; at < energy.first[3]; ++at) {
        const Index s = energy.body[at];
        expected += plain.turn[s] * energy.fits[at].target - plain.map[s] * energy.map_products[at] -
                    plain.way[s] * energy.fits[at].way.transpose();
    }
    EXPECT_LT((matrix_of(misfit_of(bodies_around(energy, plain.body, 2))) - expected).norm(), 1e-13);
    EXPECT_EQ(matrix_of(misfit_of(bodies_around(energy, plain.body, 1))), Mat3d(Mat3d::Zero()));
}

} // namespace
} // namespace knead
