#include "graph/clouds.h"
#include "graph/held_blocks.h"

#include <random>

namespace knead {
namespace {

using test::Cloud;
using test::Machine;

struct Labels {
    std::vector<Index> label;
    std::vector<std::uint8_t> held, changed;

    explicit Labels(std::size_t vertices)
        : label(vertices, no_index), held(blocks_of_rows(vertices), 0), changed(held.size(), 0) {}

    void set(Index v, Index to) {
        if (label[v] == to) return;
        label[v] = to;
        held[v / rows_in_block] = changed[v / rows_in_block] = 1;
    }
    VertexLabels view() const { return {label, held}; }
};

// What is held, vertex by vertex.
std::vector<HeldBlock> counted(const Cloud& cloud, std::span<const Index> label) {
    std::vector<HeldBlock> blocks(blocks_of_rows(cloud.size()));
    for (Index v = 0; v < cloud.size(); ++v) {
        if (label[v] == no_index) continue;
        HeldBlock& block = blocks[v / rows_in_block];
        const HeldPart part{label[v], cloud.components.component[v]};
        if (std::ranges::find(block.parts, part) == block.parts.end()) block.parts.push_back(part);
        const auto is_free = [&](Index u) { return label[u] == no_index; };
        if (std::ranges::any_of(cloud.graph.row(v), is_free)) block.borders.push_back({label[v], v});
        if (std::ranges::find(block.extents, label[v], &HeldExtent::label) == block.extents.end())
            block.extents.push_back({label[v]});
        std::ranges::find(block.extents, label[v], &HeldExtent::label)->add(cloud.at(v) - cloud.at(0));
    }
    for (HeldBlock& block : blocks) std::sort(block.parts.begin(), block.parts.end());
    return blocks;
}

void expect_same(const std::vector<HeldBlock>& found, const std::vector<HeldBlock>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t b = 0; b < found.size(); ++b) {
        EXPECT_EQ(found[b].parts, expected[b].parts) << "block " << b;
        ASSERT_EQ(found[b].extents.size(), expected[b].extents.size()) << "block " << b;
        for (std::size_t i = 0; i < found[b].extents.size(); ++i) {
            EXPECT_EQ(found[b].extents[i].label, expected[b].extents[i].label) << "block " << b;
            EXPECT_EQ(found[b].extents[i].count, expected[b].extents[i].count) << "block " << b;
            EXPECT_EQ(found[b].extents[i].sum, expected[b].extents[i].sum) << "block " << b;
            EXPECT_EQ(found[b].extents[i].squares, expected[b].extents[i].squares) << "block " << b;
        }
        ASSERT_EQ(found[b].borders.size(), expected[b].borders.size()) << "block " << b;
        for (std::size_t i = 0; i < found[b].borders.size(); ++i) {
            EXPECT_EQ(found[b].borders[i].label, expected[b].borders[i].label) << "block " << b;
            EXPECT_EQ(found[b].borders[i].vertex, expected[b].borders[i].vertex) << "block " << b;
        }
    }
}

TEST(HeldBlocks, FollowHandlesThatComeAndGo) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::cylinder, 6000));
    Machine machine;
    Labels labels(cloud.size());
    std::vector<HeldBlock> blocks;
    std::mt19937 random(3);
    for (int step = 0; step < 12; ++step) {
        SCOPED_TRACE("step " + std::to_string(step));
        const Vec3d center = cloud.at(random() % cloud.size());
        const Index to = random() % 3 == 0 ? no_index : Index{static_cast<Index>(random() % 4)};
        for (Index v = 0; v < cloud.size(); ++v)
            if ((cloud.at(v) - center).norm() < 0.8) labels.set(v, to);
        find_held(labels.view(), labels.changed, cloud.graph, cloud.positions, cloud.components,
                  machine.workers, blocks);
        std::ranges::fill(labels.changed, std::uint8_t{0});
        expect_same(blocks, counted(cloud, labels.label));
    }
}

TEST(HeldExtent, IsThatOfADisc) {
    HeldExtent disc, half, rest;
    for (int i = -100; i <= 100; ++i)
        for (int j = -100; j <= 100; ++j) {
            const Vec3d p(0.02 * i + 7, 0.02 * j, 3);
            if ((p - Vec3d(7, 0, 3)).norm() > 1.5) continue;
            disc.add(p);
            (i < 0 ? half : rest).add(p);
        }
    EXPECT_NEAR(disc.radius(), 1.5, 0.01);
    half.add(rest);
    EXPECT_EQ(half.count, disc.count);
    EXPECT_NEAR(half.radius(), disc.radius(), 1e-9);
}

} // namespace
} // namespace knead
