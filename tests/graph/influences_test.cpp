#include "graph/clouds.h"
#include "graph/flood.h"
#include "graph/influences.h"

#include <cmath>

namespace knead {
namespace {

using test::Machine;

constexpr InfluenceWeights both_kinds[] = {InfluenceWeights::smooth, InfluenceWeights::paper};

template<typename Number>
SampleRow<Number> row_of(const std::vector<std::uint32_t>& distances) {
    SampleRow<Number> row;
    row.sample.fill(row.none);
    row.distance.fill(row.none);
    for (std::size_t place = 0; place < distances.size(); ++place) {
        row.sample.at(place) = static_cast<Number>(10 + place);
        row.distance.at(place) = static_cast<Number>(distances[place]);
    }
    return row;
}

// Of a narrow row, and of a wide one, which must be the same.
std::vector<float> weights_of(const std::vector<std::uint32_t>& distances, InfluenceWeights kind) {
    const InfluenceRows narrow{std::vector{row_of<std::uint16_t>(distances)}};
    const InfluenceRows wide{std::vector{row_of<Index>(distances)}};
    const Influence influence = influence_of(narrow, kind, 0);
    EXPECT_EQ(influence.weight, influence_of(wide, kind, 0).weight);
    EXPECT_EQ(influence.motion, influence_of(wide, kind, 0).motion);
    EXPECT_EQ(influence.count, distances.size());
    for (std::size_t place = 0; place < influences_per_row; ++place)
        EXPECT_EQ(influence.motion.at(place), place < distances.size() ? 10 + place : 0);
    return {influence.weight.begin(), influence.weight.end()};
}

TEST(Influences, AreWeightsThatSumToOne) {
    const test::Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 3000));
    Machine machine;
    for (const std::size_t count : {1U, 3U, 8U, 200U}) {
        const auto samples = test::random_vertices(cloud.size(), count, 1);
        const auto nearest = flood(cloud.graph, cloud.lengths, samples, machine.workers, machine.progress);
        ASSERT_EQ(nearest.size(), cloud.size());
        for (const InfluenceWeights kind : both_kinds) {
            for (Index v = 0; v < cloud.size(); ++v) {
                const Influence influence = influence_of(nearest, kind, v);
                double sum = 0;
                for (std::size_t place = 0; place < influences_per_row; ++place) {
                    ASSERT_GE(influence.weight.at(place), 0.0F);
                    ASSERT_LT(influence.motion.at(place), count);
                    sum += static_cast<double>(influence.weight.at(place));
                }
                // Eight floats, each rounded by half of 2^-24 of at most 1.
                ASSERT_NEAR(sum, nearest[v].count() > 0 ? 1 : 0, 8 * 6e-8);
            }
        }
    }
}

TEST(Influences, OfThePaperTakeTheSampleThatAPointIs) {
    EXPECT_EQ(weights_of({0, 1, 1, 2, 3, 4, 5, 6}, InfluenceWeights::paper),
              (std::vector<float>{1, 0, 0, 0, 0, 0, 0, 0}));
}

// Alone it would stick out of the points around it, which are blends.
TEST(Influences, ThatAreSmoothBlendASamplesOwnPointLikeThoseBesideIt) {
    const std::vector<float> own = weights_of({0, 40, 40, 50, 60, 70, 80, 90}, InfluenceWeights::smooth);
    const std::vector<float> beside = weights_of({1, 40, 40, 50, 60, 70, 80, 90}, InfluenceWeights::smooth);
    for (std::size_t place = 0; place < 8; ++place) EXPECT_NEAR(own[place], beside[place], 0.01) << place;
    EXPECT_LT(own[0], 0.6F);
    EXPECT_EQ(weights_of({0}, InfluenceWeights::smooth)[0], 1.0F) << "but where it is the only one";
}

TEST(Influences, TakeAHandleWhereItIs) {
    for (const InfluenceWeights kind : both_kinds)
        for (const std::vector<std::uint32_t>& distances :
             {std::vector<std::uint32_t>{0, 0, 3, 4, 5, 6, 7, 8}, std::vector<std::uint32_t>{0, 0}}) {
            InfluenceRows rows{std::vector{row_of<std::uint16_t>(distances)}};
            std::get<0>(rows.rows)[0].sample[1] = 90; // behind a sample that is there, too
            rows.first_handle = 90;
            const Influence influence = influence_of(rows, kind, 0);
            EXPECT_EQ(influence.weight[kind == InfluenceWeights::paper ? 0 : 1], 1.0F);
        }
}

TEST(Influences, GiveALoneSampleEverything) {
    for (const InfluenceWeights kind : both_kinds)
        EXPECT_EQ(weights_of({17}, kind), (std::vector<float>{1, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(Influences, ShareEvenlyAtEqualDistances) {
    for (const InfluenceWeights kind : both_kinds) {
        EXPECT_EQ(weights_of({5, 5, 5, 5, 5, 5, 5, 5}, kind), std::vector<float>(8, 0.125F));
        EXPECT_EQ(weights_of({5, 5}, kind), (std::vector<float>{0.5, 0.5, 0, 0, 0, 0, 0, 0}));
    }
}

TEST(Influences, OfAVertexWithoutSamplesAreZero) {
    for (const InfluenceWeights kind : both_kinds)
        EXPECT_EQ(weights_of({}, kind), std::vector<float>(8, 0.0F));
}

TEST(Influences, OfThePaperFallWithTheSquareOfTheDistance) {
    const std::vector<std::uint32_t> distances{2, 3, 3, 4, 6, 8, 9, 11};
    const std::vector<float> weight = weights_of(distances, InfluenceWeights::paper);
    for (std::size_t place = 1; place < 8; ++place) {
        const double ratio = static_cast<double>(distances[place]) / distances[0];
        EXPECT_NEAR(weight[0] / weight[place], ratio * ratio, 1e-5 * ratio * ratio); // floats
    }
}

TEST(Influences, ThatAreSmoothFallToNothingAtTheFarthest) {
    const std::vector<std::uint32_t> distances{2, 3, 3, 4, 6, 8, 9, 11};
    const std::vector<float> weight = weights_of(distances, InfluenceWeights::smooth);
    EXPECT_EQ(weight[7], 0.0F);
    for (std::size_t place = 1; place < 7; ++place) {
        const double ratio = (11.0 - distances[place]) / (11.0 - distances[0]);
        EXPECT_NEAR(weight[place] / weight[0], ratio * ratio, 1e-5);
    }
}

TEST(Influences, OfAHandleGrowWithoutBoundTowardsItsBorder) {
    // The first of the row is a handle; from one level on, its share falls steadily to what a sample has at
    // handle_reach of the way to the farthest, and further.
    double before = 1;
    for (std::uint32_t distance = 1; distance < 1000; ++distance) {
        std::vector<std::uint32_t> distances{distance, 1000, 1000, 1000, 1100, 1300, 1500, 2000};
        InfluenceRows narrow{std::vector{row_of<std::uint16_t>(distances)}};
        std::get<0>(narrow.rows)[0].sample[0] = 90;
        narrow.first_handle = 90;
        InfluenceRows wide = narrow;
        widen(wide);
        const Influence influence = influence_of(narrow, InfluenceWeights::smooth, 0);
        EXPECT_EQ(influence.weight, influence_of(wide, InfluenceWeights::smooth, 0).weight);
        const double share = static_cast<double>(influence.weight[0]);
        EXPECT_LT(share, before);
        before = share;
        if (distance == 1) {
            EXPECT_GT(share, 0.99);
        }
        if (distance == std::lround(2000 * handle_reach)) {
            narrow.first_handle = no_index;
            EXPECT_EQ(influence_of(narrow, InfluenceWeights::smooth, 0).weight, influence.weight);
        }
        EXPECT_EQ(influence_of(narrow, InfluenceWeights::paper, 0).weight,
                  influence_of({narrow.rows}, InfluenceWeights::paper, 0).weight);
    }
}

TEST(Influences, BeyondTheRowsAreOneMotion) {
    const InfluenceRows rows{std::vector(3, row_of<std::uint16_t>({1, 2, 3}))};
    for (const Index number : {3U, 42U}) {
        const Influence influence = influence_of(rows, InfluenceWeights::smooth, number);
        EXPECT_EQ(influence.count, 1U);
        EXPECT_EQ(influence.motion[0], number - 3);
        EXPECT_EQ(influence.weight, (std::array<float, influences_per_row>{1}));
    }
    EXPECT_EQ(influence_of({}, InfluenceWeights::paper, 7).motion[0], 7U); // every point is a sample
}

TEST(InfluenceRows, MeanTheSameNarrowAndWide) {
    InfluenceRows rows{std::vector{row_of<std::uint16_t>({0, 9, 65'534}), row_of<std::uint16_t>({})}};
    const WideRow first = rows[0], second = rows[1];
    widen(rows);
    ASSERT_TRUE(rows.are_wide());
    EXPECT_EQ(rows[0].sample, first.sample);
    EXPECT_EQ(rows[0].distance,
              (std::array<Index, 8>{0, 9, 65'534, no_index, no_index, no_index, no_index, no_index}));
    EXPECT_EQ(rows[1].distance, second.distance);
    EXPECT_EQ(rows[1].count(), 0U);
}

} // namespace
} // namespace knead
