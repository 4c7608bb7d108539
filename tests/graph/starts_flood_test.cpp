// Starts that change from time to time: the rows are always those of the starts that there are.

#include "graph/clouds.h"
#include "graph/starts_flood.h"

#include <random>
#include <set>

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
    AddedStarts<influences_per_row> added;
    Machine machine;

    Changing(const Cloud& flooded_cloud, const std::vector<Index>& samples)
        : cloud(flooded_cloud), base(flooded(flooded_cloud, samples)),
          added(no_starts<influences_per_row>(base, static_cast<Index>(samples.size()))) {}

    static InfluenceRows flooded(const Cloud& cloud, const std::vector<Index>& samples) {
        Machine machine;
        return flood(cloud.graph, cloud.lengths, samples, machine.workers, machine.progress);
    }

    void change(const std::vector<FloodStart>& starts) {
        const InfluenceRows before = rows;
        std::vector<std::uint8_t> changed(blocks_of_rows(rows.size()), 0);
        change_starts(added, starts, rows, changed, cloud.graph, cloud.lengths, machine.workers,
                      machine.progress);
        for (Index v = 0; v < rows.size(); ++v) {
            const bool same = rows[v].sample == before[v].sample && rows[v].distance == before[v].distance;
            ASSERT_TRUE(same || changed[v / rows_in_block] == 1) << v;
        }
        const std::vector<Index> some = test::random_vertices(rows.size(), 500, 4);
        const std::vector<WideRow> without = rows_without(added, rows, some);
        for (std::size_t i = 0; i < some.size(); ++i) {
            ASSERT_EQ(without[i].sample, base[some[i]].sample);
            ASSERT_EQ(without[i].distance, base[some[i]].distance);
        }
        InfluenceRows expected = base;
        add_starts(expected, cloud.graph, cloud.lengths, starts, machine.workers, machine.progress);
        expect_same(rows, expected);
    }

    // Of how many vertices the rows without starts are kept, each once.
    std::size_t kept() const {
        std::set<Index> vertices;
        std::size_t count = 0;
        std::visit(
            [&](const auto& blocks) {
                for (const auto& block : blocks)
                    block.each([&](const auto& old) { vertices.insert(old.vertex), ++count; });
            },
            added.without.blocks);
        EXPECT_EQ(vertices.size(), count);
        return count;
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
    EXPECT_EQ(changing.kept(), 0U);
    expect_same(changing.rows, changing.base);
}

// A vertex that many handles are near, so that whoever goes makes room for others.
TEST(StartsFlood, FillsTheRoomThatOneLeaves) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::plane, 3000));
    Changing changing(cloud, test::random_vertices(cloud.size(), 12, 9));
    std::vector<Index> handles = test::random_vertices(cloud.size() - 5, 30, 2);
    changing.change(starts_of_handles(handles, 12));
    const std::size_t all = changing.kept();
    EXPECT_EQ(all, cloud.size()) << "there are handles everywhere";
    const std::vector<FloodStart> starts = starts_of_handles(handles, 12);
    for (Index gone = 0; gone < 30; ++gone) { // the oldest first, each with its number
        SCOPED_TRACE(gone);
        changing.change({starts.begin() + 5 * (gone + 1), starts.end()});
    }
    EXPECT_EQ(changing.kept(), 0U);
}

TEST(StartsFlood, LeavesWhatItDoesNotReach) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::plane, 30'000));
    Changing changing(cloud, test::random_vertices(cloud.size(), 400, 9));
    const std::vector<FloodStart> two{{100, 450}, {20'000, 451}};
    changing.change(two);
    const auto changed_by = [&](const std::vector<FloodStart>& starts) {
        std::vector<std::uint8_t> changed(blocks_of_rows(changing.rows.size()), 0);
        change_starts(changing.added, starts, changing.rows, changed, cloud.graph, cloud.lengths,
                      changing.machine.workers, changing.machine.progress);
        return std::ranges::count(changed, 1);
    };
    EXPECT_EQ(changed_by({{20'000, 451}, {100, 450}}), 0) << "the order makes no difference";
    const auto blocks = static_cast<std::ptrdiff_t>(blocks_of_rows(changing.rows.size()));
    EXPECT_LT(changed_by({{20'000, 451}}), blocks / 5) << "the older one went";
    EXPECT_LT(changed_by({{20'000, 451}, {20'010, 451}}), blocks / 5) << "one reaches farther";
    changing.change({{20'010, 451}});
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
