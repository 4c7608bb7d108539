#include "graph/group_tree.h"

#include "base/require.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace knead {

namespace {

constexpr std::size_t vertices_a_run = 16;

GroupTree::Box empty_box() {
    constexpr float beyond = std::numeric_limits<float>::infinity();
    return {{beyond, beyond, beyond}, {-beyond, -beyond, -beyond}, no_index, false};
}

void add_group(GroupTree::Box& box, Index group, bool mixed) {
    if (group == no_index) return;
    box.mixed |= mixed || (box.group != no_index && box.group != group);
    box.group = group;
}

GroupTree::Box box_of_run(const GroupTree& tree, std::size_t run) {
    GroupTree::Box box = empty_box();
    const std::size_t first = run * tree.vertices;
    const std::size_t end = std::min(first + tree.vertices, tree.group.size());
    for (std::size_t v = first; v < end; ++v) {
        if (tree.group[v] == no_index) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box.lowest[axis] = std::min(box.lowest[axis], tree.positions[3 * v + axis]);
            box.highest[axis] = std::max(box.highest[axis], tree.positions[3 * v + axis]);
        }
        add_group(box, tree.group[v], false);
    }
    return box;
}

GroupTree::Box box_around(const GroupTree::Box& a, const GroupTree::Box& b) {
    GroupTree::Box box = a;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.lowest[axis] = std::min(a.lowest[axis], b.lowest[axis]);
        box.highest[axis] = std::max(a.highest[axis], b.highest[axis]);
    }
    add_group(box, b.group, b.mixed);
    return box;
}

double square(double number) {
    return number * number;
}

// Of someone who asks: where, of which group, and the best found so far.
struct Search {
    const GroupTree& tree;
    std::array<double, 3> place;
    Index own;
    double nearest;                    // squared
    std::span<const float> reach = {}; // of each vertex; empty: it does not count
    Index found = no_index;

    bool is_worth(const GroupTree::Box& box) const {
        return box.group != no_index && (box.mixed || box.group != own);
    }

    // Rounded as the distance of a vertex is, so it is never above that of a vertex inside.
    double squared_to(const GroupTree::Box& box) const {
        double sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double below = static_cast<double>(box.lowest[axis]) - place[axis];
            const double above = place[axis] - static_cast<double>(box.highest[axis]);
            const double away = std::max({below, above, 0.0});
            sum += away * away;
        }
        return sum;
    }

    void look_at_run(std::size_t run) {
        const std::size_t first = run * tree.vertices;
        const std::size_t end = std::min(first + tree.vertices, tree.group.size());
        for (std::size_t v = first; v < end; ++v) {
            if (tree.group[v] == no_index || tree.group[v] == own) continue;
            double sum = 0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double away = place[axis] - static_cast<double>(tree.positions[3 * v + axis]);
                sum += away * away;
            }
            if (!reach.empty() && sum > square(reach[v])) continue;
            const auto vertex = static_cast<Index>(v);
            if (sum > nearest || (sum == nearest && vertex > found)) continue;
            nearest = sum;
            found = vertex;
        }
    }

    void look_into(std::size_t box) {
        if (box >= tree.runs - 1) return look_at_run(box - (tree.runs - 1));
        const std::size_t left = 2 * box + 1;
        std::array<std::pair<double, std::size_t>, 2> order{
            {{squared_to(tree.boxes[left]), left}, {squared_to(tree.boxes[left + 1]), left + 1}}};
        if (order[1].first < order[0].first) std::swap(order[0], order[1]);
        for (const auto& [squared, child] : order)
            if (squared <= nearest && is_worth(tree.boxes[child])) look_into(child);
    }
};

} // namespace

GroupTree group_tree(std::span<const float> positions, std::span<const Index> group, Workers& workers) {
    require(positions.size() == 3 * group.size(), "a position a vertex");
    GroupTree tree{positions, group, {}, 0, vertices_a_run};
    tree.runs = std::bit_ceil(std::max<std::size_t>(1, (group.size() + vertices_a_run - 1) / vertices_a_run));
    tree.boxes.assign(2 * tree.runs - 1, empty_box());
    workers.for_each(tree.runs, 256,
                     [&](std::size_t run) { tree.boxes[tree.runs - 1 + run] = box_of_run(tree, run); });
    for (std::size_t box = tree.runs - 1; box-- > 0;)
        tree.boxes[box] = box_around(tree.boxes[2 * box + 1], tree.boxes[2 * box + 2]);
    return tree;
}

namespace {

Neighbor nearest(const GroupTree& tree, std::size_t v, double farthest, std::span<const float> reach) {
    Search search{tree, {}, tree.group[v], square(farthest), reach};
    for (std::size_t axis = 0; axis < 3; ++axis)
        search.place[axis] = static_cast<double>(tree.positions[3 * v + axis]);
    if (search.is_worth(tree.boxes.front())) search.look_into(0);
    if (search.found == no_index) return {};
    return {search.found, std::sqrt(search.nearest)};
}

} // namespace

Neighbor nearest_of_others(const GroupTree& tree, std::size_t v, double reach) {
    return nearest(tree, v, reach, {});
}

Neighbor nearest_within_both(const GroupTree& tree, std::size_t v, std::span<const float> reach) {
    return nearest(tree, v, static_cast<double>(reach[v]), reach);
}

} // namespace knead
