// How finely handles divide a cloud.

#include "edit/handle_spread.h"

#include "edit/editing.h"

#include <cmath>

namespace knead::test {

namespace {

constexpr Index length = 100;

Graph chain(Index vertices) {
    Graph graph{{0}, {}};
    for (Index v = 0; v < vertices; ++v) {
        if (v > 0) graph.neighbor.push_back(v - 1);
        if (v + 1 < vertices) graph.neighbor.push_back(v + 1);
        graph.first.push_back(static_cast<Index>(graph.neighbor.size()));
    }
    return graph;
}

// A chain with a handle up to a vertex, and another from a vertex on; every so manieth vertex is a sample.
HandleSpread spread_of_chain(Index first_ends, Index second_begins, Index step, Index handles = 2) {
    HandleLabels labels;
    labels.vertex.assign(length, no_index);
    labels.outside = handles;
    for (Index v = 0; v < length; ++v)
        labels.vertex[v] = v < first_ends ? 0 : v >= second_begins ? 1 : no_index;
    std::vector<Index> samples;
    for (Index v = 0; v < length; v += step) samples.push_back(v);
    return spread_of(labels, chain(length), samples, chain(static_cast<Index>(samples.size())));
}

// Of handles at both ends of the bar.
HandleSpread spread_of_bar(std::size_t samples) {
    Settings settings;
    settings.samples = samples;
    Desk desk(bar(20000), settings);
    SilentProgress progress;
    desk.play(ends).document().prepare_ahead(progress);
    const Pipeline& pipeline = desk.pipeline();
    return spread_of(pipeline.labels(), pipeline.graph(), pipeline.samples(), pipeline.sample_graph().graph);
}

} // namespace

TEST(HandleSpread, CountsHandlesAndLinksBetweenThem) {
    const HandleSpread spread = spread_of_chain(40, 45, 1);
    EXPECT_EQ(spread.count, 2U);
    EXPECT_DOUBLE_EQ(spread.smallest, 0.4);
    EXPECT_DOUBLE_EQ(spread.closest, 6 / 10.0);                              // from vertex 39 to vertex 45
    EXPECT_DOUBLE_EQ(spread_of_chain(40, 45, 2).closest, 4 / std::sqrt(50)); // 38, 40, 42, 44, 46
}

TEST(HandleSpread, AGapWithNoSampleInItIsOneLink) {
    EXPECT_DOUBLE_EQ(spread_of_chain(41, 41, 2).closest, 1) << "they touch: nothing bends between them";
    EXPECT_DOUBLE_EQ(spread_of_chain(41, 42, 2).closest, 1 / std::sqrt(50)) << "only vertex 41 is free";
    EXPECT_DOUBLE_EQ(spread_of_chain(41, 44, 4).closest, 1 / std::sqrt(25)) << "from 40 to 44";
}

TEST(HandleSpread, OneHandleOrNoneIsAloneButForWhatIsOutside) {
    EXPECT_EQ(spread_of_chain(0, length, 1).count, 0U);
    EXPECT_DOUBLE_EQ(spread_of_chain(0, length, 1).smallest, 1);
    EXPECT_DOUBLE_EQ(spread_of_chain(1, length, 1).closest, 1);
    EXPECT_DOUBLE_EQ(spread_of_chain(1, length, 1).smallest, 0.01);
    const HandleSpread region = spread_of_chain(40, 45, 1, 1); // the second label is what lies outside
    EXPECT_EQ(region.count, 1U);
    EXPECT_DOUBLE_EQ(region.closest, 6 / 10.0);
}

TEST(HandleSpread, IsMuchTheSameForAnyNumberOfSamples) {
    const HandleSpread few = spread_of_bar(200), many = spread_of_bar(5000);
    EXPECT_EQ(few.count, 2U);
    EXPECT_DOUBLE_EQ(few.smallest, many.smallest);
    EXPECT_NEAR(few.closest / many.closest, 1, 0.35);
}

} // namespace knead::test
