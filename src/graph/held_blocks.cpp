#include "graph/held_blocks.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace knead {

namespace {

constexpr std::size_t blocks_at_once = 64;

void mark(std::uint8_t& flag) {
    const std::atomic_ref<std::uint8_t> here(flag);
    if (!here.load(std::memory_order_relaxed)) here.store(1, std::memory_order_relaxed);
}

// Of each block, 1 if it changed or has neighbours in one that did.
std::vector<std::uint8_t> near_changed(std::span<const std::uint8_t> changed, const Graph& graph,
                                       Workers& workers) {
    std::vector<std::uint8_t> marks(changed.size(), 0);
    workers.for_each(changed.size(), blocks_at_once, [&](std::size_t block) {
        if (!changed[block]) return;
        mark(marks[block]);
        const auto [begin, end] = rows_of_block(block, graph.size());
        for (std::size_t v = begin; v < end; ++v)
            for (const Index neighbor : graph.row(v)) mark(marks[neighbor / rows_in_block]);
    });
    return marks;
}

bool touches_free(const Graph& graph, std::span<const Index> label, Index v) {
    return std::ranges::any_of(graph.row(v), [&](Index u) { return label[u] == no_index; });
}

HeldExtent& extent_of(Index label, std::vector<HeldExtent>& extents) {
    const auto found = std::ranges::find(extents, label, &HeldExtent::label);
    if (found != extents.end()) return *found;
    extents.push_back({label});
    return extents.back();
}

void look_at(std::size_t block, const VertexLabels& labels, const Graph& graph,
             std::span<const float> positions, const Components& components, HeldBlock& found) {
    found.parts.clear();
    found.borders.clear();
    found.extents.clear();
    const auto [begin, end] = rows_of_block(block, graph.size());
    for_each_held(labels, begin, end, [&](Index v) {
        const HeldPart part{labels.label[v], components.component[v]};
        if (found.parts.empty() || found.parts.back() != part) found.parts.push_back(part);
        if (touches_free(graph, labels.label, v)) found.borders.push_back({labels.label[v], v});
        extent_of(labels.label[v], found.extents).add(point_at(positions, v) - point_at(positions, 0));
    });
    std::sort(found.parts.begin(), found.parts.end());
    found.parts.erase(std::unique(found.parts.begin(), found.parts.end()), found.parts.end());
}

} // namespace

void HeldExtent::add(const Vec3d& position) {
    ++count;
    sum += position;
    squares += position.squaredNorm();
}

void HeldExtent::add(const HeldExtent& other) {
    count += other.count;
    sum += other.sum;
    squares += other.squares;
}

double HeldExtent::radius() const {
    return std::sqrt(std::max(0.0, 2 * (squares / count - (sum / count).squaredNorm())));
}

void find_held(const VertexLabels& labels, std::span<const std::uint8_t> changed, const Graph& graph,
               std::span<const float> positions, const Components& components, Workers& workers,
               std::vector<HeldBlock>& blocks) {
    const std::vector<std::uint8_t> marks =
        blocks.empty() ? std::vector<std::uint8_t>(changed.size(), 1) : near_changed(changed, graph, workers);
    blocks.resize(changed.size());
    workers.for_each(blocks.size(), blocks_at_once, [&](std::size_t block) {
        if (marks[block]) look_at(block, labels, graph, positions, components, blocks[block]);
    });
}

} // namespace knead
