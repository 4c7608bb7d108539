#include "graph/balanced_weights.h"
#include "graph/clouds.h"
#include "graph/flood.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace knead {
namespace {

using test::Machine;
using Weights = std::array<float, influences_per_row>;

SampleOffsets offsets_of(const std::vector<Vec3d>& samples, double unit = 1) {
    SampleOffsets offsets;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        offsets.x.at(k) = static_cast<float>(unit * samples[k].x());
        offsets.y.at(k) = static_cast<float>(unit * samples[k].y());
        offsets.z.at(k) = static_cast<float>(unit * samples[k].z());
    }
    return offsets;
}

Weights balanced(const SampleOffsets& offsets, Weights weight) {
    balance(offsets, weight);
    const float sum = std::accumulate(weight.begin(), weight.end(), 0.0F);
    for (float& w : weight) w /= sum;
    return weight;
}

Vec3d mean_of(const std::vector<Vec3d>& samples, const Weights& weight) {
    Vec3d mean = Vec3d::Zero();
    for (std::size_t k = 0; k < samples.size(); ++k) mean += static_cast<double>(weight.at(k)) * samples[k];
    return mean;
}

// Eight around the point, not too near one line, and not evenly.
std::vector<Vec3d> around(std::mt19937& random) {
    std::uniform_real_distribution<double> turn(-0.3, 0.3), reach(0.5, 1.5);
    std::vector<Vec3d> samples;
    for (int k = 0; k < 8; ++k) {
        const double angle = 0.785 * k + turn(random);
        samples.emplace_back(reach(random) * Vec3d(std::cos(angle), std::sin(angle), 0));
    }
    return samples;
}

constexpr Weights uneven = {0.3F, 0.05F, 0.1F, 0.2F, 0.05F, 0.1F, 0.15F, 0.05F};

TEST(BalancedWeights, BringTheMeanPlaceToThePoint) {
    std::mt19937 random(1);
    double before = 0, after = 0;
    for (int round = 0; round < 200; ++round) {
        const std::vector<Vec3d> samples = around(random);
        const Weights weight = balanced(offsets_of(samples), uneven);
        before += mean_of(samples, uneven).squaredNorm();
        after += mean_of(samples, weight).squaredNorm();
    }
    EXPECT_LT(after, before / 5);
    EXPECT_GT(before, 200 * 0.01); // there was something to balance
}

TEST(BalancedWeights, OfASurfaceReproducePlacesMoreNearlyThanThoseByDistance) {
    const test::Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 20'000));
    Machine machine;
    std::vector<Index> samples; // along Morton's curve, so about evenly
    for (Index v = 30; v < cloud.size(); v += 60) samples.push_back(v);
    const InfluenceRows nearest =
        flood(cloud.graph, cloud.lengths, samples, machine.workers, machine.progress);
    std::vector<Vec3d> places;
    for (const Index v : samples) places.push_back(cloud.at(v));
    double by_distance = 0, with_balance = 0;
    for (Index v = 0; v < cloud.size(); ++v) {
        const auto square_miss = [&](const Influence& influence) {
            Vec3d mean = Vec3d::Zero();
            double sum = 0;
            for (std::size_t k = 0; k < influence.count; ++k) {
                EXPECT_GE(influence.weight.at(k), 0) << v;
                sum += static_cast<double>(influence.weight.at(k));
                mean +=
                    static_cast<double>(influence.weight.at(k)) * cloud.at(samples[influence.motion.at(k)]);
            }
            EXPECT_NEAR(sum, 1, 1e-6) << v;
            return (mean - cloud.at(v)).squaredNorm();
        };
        by_distance += square_miss(influence_of(nearest, InfluenceWeights::smooth, v));
        with_balance += square_miss(influence_of(nearest, InfluenceWeights::smooth, places, v, cloud.at(v)));
    }
    EXPECT_LT(with_balance, 0.85 * by_distance); // what is left is across the surface, and at tips
    const auto some = static_cast<Index>(cloud.size() / 2);
    EXPECT_EQ(influence_of(nearest, InfluenceWeights::paper, places, some, cloud.at(some)).weight,
              influence_of(nearest, InfluenceWeights::paper, some).weight)
        << "the paper's weights are the paper's";
}

TEST(BalancedWeights, StayWhereThereIsNothingToBalance) {
    std::vector<Vec3d> even;
    for (int k = 0; k < 8; ++k) even.emplace_back(std::cos(0.785398 * k), std::sin(0.785398 * k), 0);
    Weights alike;
    alike.fill(0.125F);
    const Weights weight = balanced(offsets_of(even), alike);
    for (const float w : weight) EXPECT_NEAR(w, 0.125F, 1e-6);

    Weights handles = uneven;
    balance({}, handles); // each is where the point is
    EXPECT_EQ(handles, uneven);
    Weights one = {2, 0, 0, 0, 0, 0, 0, 0};
    EXPECT_EQ(balanced(offsets_of({{1, 2, 3}}), one), (Weights{1, 0, 0, 0, 0, 0, 0, 0}));
    const std::vector<Vec3d> heap(8, Vec3d(1, 2, 3)); // all in one place
    const Weights of_heap = balanced(offsets_of(heap), uneven);
    for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(of_heap.at(k), uneven.at(k), 1e-6);
}

TEST(BalancedWeights, DoNotDependOnTheUnitOrTheDirection) {
    std::mt19937 random(2);
    const Mat3d turn = Eigen::AngleAxisd(1, Vec3d(1, 2, 3).normalized()).toRotationMatrix();
    for (int round = 0; round < 50; ++round) {
        const std::vector<Vec3d> samples = around(random);
        std::vector<Vec3d> turned;
        for (const Vec3d& sample : samples) turned.push_back(turn * sample);
        const Weights weight = balanced(offsets_of(samples), uneven);
        const Weights small = balanced(offsets_of(samples, 1e-9), uneven);
        const Weights large = balanced(offsets_of(turned, 1e12), uneven);
        for (std::size_t k = 0; k < 8; ++k) {
            EXPECT_NEAR(small.at(k), weight.at(k), 1e-5);
            EXPECT_NEAR(large.at(k), weight.at(k), 1e-5);
        }
    }
}

// All on one side of the point, as at a rim: they cannot reach it, and must not break for it.
TEST(BalancedWeights, AreNoneBelowZeroAndSumToSomethingAtARim) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> along(-1, 1), away(0.01, 3);
    for (int round = 0; round < 1000; ++round) {
        std::vector<Vec3d> samples;
        for (int k = 0; k < 8; ++k) samples.emplace_back(away(random), along(random), 0);
        const Weights weight = balanced(offsets_of(samples), uneven);
        for (const float w : weight) ASSERT_GE(w, 0);
        ASSERT_LE(mean_of(samples, weight).x(), mean_of(samples, uneven).x());
    }
}

TEST(BalancedWeights, OfWhatNoFloatCanSquareStayAsTheyAre) {
    std::mt19937 random(4);
    const std::vector<Vec3d> samples = around(random);
    for (const double unit : {1e30, 1e-30, std::numeric_limits<double>::infinity()}) {
        Weights weight = uneven;
        balance(offsets_of(samples, unit), weight);
        EXPECT_EQ(weight, uneven) << unit;
    }
}

} // namespace
} // namespace knead
