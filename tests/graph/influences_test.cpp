#include "graph/clouds.h"
#include "graph/influences.h"

#include <cmath>

namespace knead {
namespace {

using test::Machine;

constexpr InfluenceWeights both_kinds[] = {InfluenceWeights::smooth, InfluenceWeights::paper};

NearestSamples row_of(const std::vector<std::uint32_t>& distances) {
    NearestSamples row;
    row.sample.fill(no_index);
    row.distance.fill(~std::uint32_t{0});
    for (std::size_t place = 0; place < distances.size(); ++place) {
        row.sample.at(place) = static_cast<Index>(10 + place);
        row.distance.at(place) = distances[place];
    }
    return row;
}

InfluenceRows rows_of(const std::vector<NearestSamples>& nearest, InfluenceWeights weights) {
    Machine machine;
    return influence_rows(nearest, weights, machine.workers);
}

std::vector<float> weights_of(const std::vector<std::uint32_t>& distances, InfluenceWeights weights) {
    return rows_of({row_of(distances)}, weights).weight;
}

TEST(InfluenceRows, AreWeightsThatSumToOne) {
    const test::Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 3000));
    Machine machine;
    for (const std::size_t count : {1U, 3U, 8U, 200U}) {
        const auto samples = test::random_vertices(cloud.size(), count, 1);
        const auto nearest = flood(cloud.graph, cloud.lengths, samples, machine.workers, machine.progress);
        for (const InfluenceWeights kind : both_kinds) {
            const InfluenceRows rows = rows_of(nearest, kind);
            ASSERT_EQ(rows.size(), cloud.size());
            for (std::size_t v = 0; v < cloud.size(); ++v) {
                double sum = 0;
                for (std::size_t place = 0; place < influences_per_row; ++place) {
                    const float weight = rows.weight[v * influences_per_row + place];
                    ASSERT_GE(weight, 0.0F);
                    ASSERT_LT(rows.sample[v * influences_per_row + place], count);
                    sum += static_cast<double>(weight);
                }
                // Eight floats, each rounded by half of 2^-24 of at most 1.
                ASSERT_NEAR(sum, nearest[v].count() > 0 ? 1 : 0, 8 * 6e-8);
            }
        }
    }
}

TEST(InfluenceRows, TakeTheSampleThatAPointIs) {
    for (const InfluenceWeights kind : both_kinds)
        EXPECT_EQ(weights_of({0, 1, 1, 2, 3, 4, 5, 6}, kind), (std::vector<float>{1, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(InfluenceRows, GiveALoneSampleEverything) {
    for (const InfluenceWeights kind : both_kinds) {
        const InfluenceRows rows = rows_of({row_of({17})}, kind);
        EXPECT_EQ(rows.weight, (std::vector<float>{1, 0, 0, 0, 0, 0, 0, 0}));
        EXPECT_EQ(rows.sample, std::vector<Index>(8, 10)) << "unused places repeat the first sample";
    }
}

TEST(InfluenceRows, ShareEvenlyAtEqualDistances) {
    for (const InfluenceWeights kind : both_kinds) {
        EXPECT_EQ(weights_of({5, 5, 5, 5, 5, 5, 5, 5}, kind), std::vector<float>(8, 0.125F));
        EXPECT_EQ(weights_of({5, 5}, kind), (std::vector<float>{0.5, 0.5, 0, 0, 0, 0, 0, 0}));
    }
}

TEST(InfluenceRows, OfAVertexWithoutSamplesAreZero) {
    for (const InfluenceWeights kind : both_kinds) {
        const InfluenceRows rows = rows_of({row_of({})}, kind);
        EXPECT_EQ(rows.weight, std::vector<float>(8, 0.0F));
        EXPECT_EQ(rows.sample, std::vector<Index>(8, 0));
    }
}

TEST(InfluenceRows, OfThePaperFallWithTheSquareOfTheDistance) {
    const std::vector<std::uint32_t> distances{2, 3, 3, 4, 6, 8, 9, 11};
    const std::vector<float> weight = weights_of(distances, InfluenceWeights::paper);
    for (std::size_t place = 1; place < 8; ++place) {
        const double ratio = static_cast<double>(distances[place]) / distances[0];
        EXPECT_NEAR(weight[0] / weight[place], ratio * ratio, 1e-5 * ratio * ratio); // floats
    }
}

TEST(InfluenceRows, ThatAreSmoothFallToNothingAtTheFarthest) {
    const std::vector<std::uint32_t> distances{2, 3, 3, 4, 6, 8, 9, 11};
    const std::vector<float> weight = weights_of(distances, InfluenceWeights::smooth);
    EXPECT_EQ(weight[7], 0.0F);
    for (std::size_t place = 1; place < 7; ++place) {
        const double ratio = (11.0 - distances[place]) / (11.0 - distances[0]);
        EXPECT_NEAR(weight[place] / weight[0], ratio * ratio, 1e-5);
    }
}

TEST(InfluenceRows, OwnAndSingleOnesAreOneSample) {
    InfluenceRows rows = own_rows(3);
    EXPECT_EQ(append_single(rows, 42), 3U);
    ASSERT_EQ(rows.size(), 4U);
    const std::vector<Index> expected{0, 1, 2, 42};
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t place = 0; place < influences_per_row; ++place) {
            EXPECT_EQ(rows.sample[row * influences_per_row + place], expected[row]);
            EXPECT_EQ(rows.weight[row * influences_per_row + place], place == 0 ? 1.0F : 0.0F);
        }
    }
}

} // namespace
} // namespace knead
