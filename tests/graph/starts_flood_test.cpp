// Starts that change from time to time: the rows are always those of the starts that there are.

#include "graph/clouds.h"
#include "graph/starts_flood.h"

#include <random>

namespace knead {
namespace {

using test::Cloud;
using test::Machine;

// Handles of a few neighbouring vertices each, one after the other, numbered from `first`.
std::vector<FloodStart> starts_of_handles(const std::vector<Index>& handles, Index first) {
    std::vector<FloodStart> starts;
    for (const Index vertex : handles) {
        for (Index v = vertex; v < vertex + 5; ++v) starts.push_back({v, first});
        ++first;
    }
    return starts;
}

void expect_same(const InfluenceRows& rows, const InfluenceRows& expected) {
    for (Index v = 0; v < expected.size(); ++v) {
        ASSERT_EQ(rows[v].sample, expected[v].sample) << v;
        ASSERT_EQ(rows[v].distance, expected[v].distance) << v;
    }
}

// Rows of a cloud whose starts change.
struct Changing {
    const Cloud& cloud;
    InfluenceRows base;
    InfluenceRows rows = base;
    std::vector<StartsFlood<influences_per_row>> floods;
    Machine machine;

    Changing(const Cloud& flooded_cloud, const std::vector<Index>& samples)
        : cloud(flooded_cloud), base(flooded(flooded_cloud, samples)) {}

    static InfluenceRows flooded(const Cloud& cloud, const std::vector<Index>& samples) {
        Machine machine;
        return flood(cloud.graph, cloud.lengths, samples, machine.workers, machine.progress);
    }

    void change(const std::vector<FloodStart>& starts) {
        const InfluenceRows before = rows;
        std::vector<std::uint8_t> changed(blocks_of_rows(rows.size()), 0);
        change_starts(floods, starts, rows, changed, cloud.graph, cloud.lengths, machine.workers,
                      machine.progress);
        for (Index v = 0; v < rows.size(); ++v) {
            const bool same = rows[v].sample == before[v].sample && rows[v].distance == before[v].distance;
            ASSERT_TRUE(same || changed[v / rows_in_block] == 1) << v;
        }
        const std::vector<Index> some = test::random_vertices(rows.size(), 500, 4);
        const std::vector<WideRow> without =
            rows_without<influences_per_row>(floods, rows, some, machine.workers);
        for (std::size_t i = 0; i < some.size(); ++i) {
            ASSERT_EQ(without[i].sample, base[some[i]].sample);
            ASSERT_EQ(without[i].distance, base[some[i]].distance);
        }
        InfluenceRows expected = base;
        add_starts(expected, cloud.graph, cloud.lengths, starts, machine.workers, machine.progress);
        expect_same(rows, expected);
    }

    // Of each flood, how many starts.
    std::vector<std::size_t> sizes() const {
        std::vector<std::size_t> sizes;
        for (const auto& flood : floods) sizes.push_back(flood.starts.size());
        return sizes;
    }
};

TEST(StartsFlood, HoldsTheStartsThatThereAre) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::knot, 20'000));
    Changing changing(cloud, test::random_vertices(cloud.size(), 40, 9));
    std::mt19937 random(3);
    std::vector<Index> handles;
    for (int step = 0; step < 40; ++step) {
        SCOPED_TRACE("step " + std::to_string(step));
        const auto any = [&] {
            return handles.begin() + static_cast<std::ptrdiff_t>(random() % handles.size());
        };
        const auto vertex = static_cast<Index>(random() % (cloud.size() - 5));
        const auto what = random() % 4;
        if (handles.empty() || what < 2)
            handles.push_back(vertex);
        else if (what == 2)
            handles.erase(any());
        else
            *any() = vertex;
        changing.change(starts_of_handles(handles, 40));
    }
    changing.change({});
    EXPECT_TRUE(changing.floods.empty());
    expect_same(changing.rows, changing.base);
}

TEST(StartsFlood, LeavesWhatStays) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::plane, 3000));
    Changing changing(cloud, test::random_vertices(cloud.size(), 40, 9));
    changing.change(starts_of_handles({100, 900}, 40));
    EXPECT_EQ(changing.sizes(), (std::vector<std::size_t>{10}));
    changing.change(starts_of_handles({100, 900, 2000}, 40));
    EXPECT_EQ(changing.sizes(), (std::vector<std::size_t>{10, 5}));
    changing.change(starts_of_handles({100, 900, 2500, 2700}, 40));
    EXPECT_EQ(changing.sizes(), (std::vector<std::size_t>{10, 10}));
    changing.change(starts_of_handles({100, 900}, 40));
    EXPECT_EQ(changing.sizes(), (std::vector<std::size_t>{10}));
    changing.change(starts_of_handles({100, 1200}, 40)); // what is left of a flood is one by itself
    EXPECT_EQ(changing.sizes(), (std::vector<std::size_t>{5, 5}));
    changing.change(starts_of_handles({100}, 40));
    EXPECT_EQ(changing.sizes(), (std::vector<std::size_t>{5}));
}

TEST(StartsFlood, DoesNotAskForTheOrder) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::plane, 3000));
    Changing changing(cloud, test::random_vertices(cloud.size(), 40, 9));
    const std::vector<FloodStart> late{{100, 50}, {900, 51}}, early{{2000, 45}};
    changing.change(late);
    std::vector<FloodStart> both = early; // a handle that is put first in the list
    both.insert(both.end(), late.begin(), late.end());
    changing.change(both);
    EXPECT_EQ(changing.sizes(), (std::vector<std::size_t>{2, 1})) << "the others stay";
    changing.change(late);
    EXPECT_EQ(changing.sizes(), (std::vector<std::size_t>{2}));
    changing.change({{900, 51}, {100, 50}});
    EXPECT_EQ(changing.sizes(), (std::vector<std::size_t>{2}));
}

TEST(StartsFlood, TakesNarrowRowsBackFromWideOnes) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::plane, 3000));
    Changing changing(cloud, test::random_vertices(cloud.size(), 40, 9));
    std::vector<FloodStart> starts = starts_of_handles({100, 900}, 40);
    changing.change(starts);
    ASSERT_FALSE(changing.rows.are_wide());
    starts.push_back({2000, 70'000}); // more than a narrow row can tell
    changing.change(starts);
    ASSERT_TRUE(changing.rows.are_wide());
    changing.change({});
    expect_same(changing.rows, changing.base);
}

} // namespace
} // namespace knead
