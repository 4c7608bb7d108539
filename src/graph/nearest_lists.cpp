#include "graph/nearest_lists.h"

#include "base/large_pages.h"
#include "base/require.h"
#include "graph/point_order.h"
#include "graph/scrambled.h"

#include <flann/flann.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace knead {

namespace {

// Squared distances in double: between different floats never zero and never infinite, and equal for equal
// distances on a lattice, whichever way they are taken.
struct SquaredDistance {
    using is_kdtree_distance = bool; // how FLANN asks whether accum_dist() is there
    using ElementType = float;
    using ResultType = double;

    template<typename A, typename B>
    double operator()(A a, B b, std::size_t, double = -1) const {
        return accum_dist(a[0], b[0], 0) + accum_dist(a[1], b[1], 1) + accum_dist(a[2], b[2], 2);
    }
    template<typename A, typename B>
    double accum_dist(const A& a, const B& b, int) const {
        const double difference = static_cast<double>(a) - static_cast<double>(b);
        return difference * difference;
    }
};

using KdTree = flann::KDTreeSingleIndex<SquaredDistance>;

// At most so many vertices in a run, which one worker searches for at a time.
constexpr std::size_t most_a_run = 1 << 10;
constexpr int most_a_leaf = 12;

// begin … end of the vertices.
struct Range {
    std::size_t begin, end;
};

// Where a range of at least two vertices is halved: on the border of two cells of the Morton curve, so that
// the halves lie side by side. In any other order, which has no such place, in its middle.
std::size_t middle_of(const Range& range, std::span<const float> positions, const MortonCube& cube) {
    const auto code = [&](std::size_t v) { return morton_code(point_at(positions, v), cube); };
    const std::size_t even = (range.begin + range.end) / 2;
    const std::uint64_t differing = code(range.begin) ^ code(range.end - 1);
    if (differing == 0) return even;
    std::size_t middle = range.begin, end = range.end; // the first whose code has the bit is among these
    while (middle < end) {
        const std::size_t v = (middle + end) / 2;
        if (code(v) & std::bit_floor(differing))
            end = v;
        else
            middle = v + 1;
    }
    return middle > range.begin && middle < range.end ? middle : even;
}

// The vertices of each tree.
std::vector<Range> ranges_of_trees(std::span<const float> positions, std::size_t most_a_tree) {
    const MortonCube cube = morton_cube(positions);
    std::vector<Range> ranges, waiting{{0, positions.size() / 3}};
    while (!waiting.empty()) {
        const Range range = waiting.back();
        waiting.pop_back();
        if (range.end - range.begin <= most_a_tree) {
            ranges.push_back(range);
            continue;
        }
        const std::size_t middle = middle_of(range, positions, cube);
        waiting.push_back({middle, range.end});
        waiting.push_back({range.begin, middle});
    }
    return ranges;
}

struct Box {
    std::array<double, 3> lowest, highest;
};

void extend(Box& box, const Box& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.lowest[axis] = std::min(box.lowest[axis], other.lowest[axis]);
        box.highest[axis] = std::max(box.highest[axis], other.highest[axis]);
    }
}

Box box_of(std::span<const float> positions, std::size_t vertex) {
    const auto at = [&](std::size_t axis) { return static_cast<double>(positions[3 * vertex + axis]); };
    return {{at(0), at(1), at(2)}, {at(0), at(1), at(2)}};
}

// Rounded as the distance of two vertices is, and so never above that of any inside.
double squared_distance(const Box& a, const Box& b) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double away =
            std::max({a.lowest[axis] - b.highest[axis], b.lowest[axis] - a.highest[axis], 0.0});
        sum += away * away;
    }
    return sum;
}

double squared_diagonal(const Box& box) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double edge = box.highest[axis] - box.lowest[axis];
        sum += edge * edge;
    }
    return sum;
}

// Another vertex, by how near it is.
struct Other {
    double squared;
    Index vertex;

    bool operator<(const Other& other) const {
        if (squared != other.squared) return squared < other.squared;
        return scrambled(vertex) < scrambled(other.vertex);
    }
};

// What the search of one tree after another has found for a vertex: the nearest others.
class NearestOthers final : public flann::ResultSet<double> {
public:
    explicit NearestOthers(std::size_t most) : found_(most) {}

    void start(std::size_t vertex) {
        vertex_ = vertex;
        count_ = 0;
        bound_ = std::numeric_limits<double>::max();
    }
    // What comes next is numbered from there.
    void number_from(std::size_t first) { first_ = first; }

    std::span<const Other> found() const { return std::span(found_).first(count_); }

    // Nothing from there on is looked at. Wide enough for what is as far as the last one, and for how FLANN
    // rounds the distance of a box.
    double worstDist() const override { return bound_; }
    bool full() const override { return count_ == found_.size(); }
    void addPoint(double squared, std::size_t in_tree) override {
        if (first_ + in_tree == vertex_) return;
        const Other next{squared, static_cast<Index>(first_ + in_tree)};
        std::size_t place = count_;
        if (full()) {
            if (found_.back() < next) return;
            --place;
        } else {
            ++count_;
        }
        for (; place > 0 && next < found_[place - 1]; --place) found_[place] = found_[place - 1];
        found_[place] = next;
        if (full()) bound_ = found_.back().squared * (1 + 1e-9);
    }

private:
    std::vector<Other> found_; // nearest first
    std::size_t vertex_ = 0, first_ = 0, count_ = 0;
    double bound_ = 0;
};

// Several small trees instead of a large one: they are built side by side, and a search in a small one stays
// in the cache. What is found does not depend on how the vertices are shared out.
struct Tree {
    Range vertices;
    Box box;
    std::optional<KdTree> search;
};

Box box_of(std::span<const float> positions, const Range& range) {
    Box box = box_of(positions, range.begin);
    for (std::size_t v = range.begin + 1; v < range.end; ++v) extend(box, box_of(positions, v));
    return box;
}

std::vector<Tree> make_trees(std::span<const float> positions, std::size_t most_a_tree, Workers& workers) {
    const std::vector<Range> ranges = ranges_of_trees(positions, most_a_tree);
    std::vector<Tree> trees(ranges.size());
    workers.for_each(trees.size(), 1, [&](std::size_t t) {
        const auto [begin, end] = ranges[t];
        const flann::Matrix<float> points(const_cast<float*>(positions.data()) + 3 * begin, end - begin, 3);
        trees[t].vertices = ranges[t];
        trees[t].box = box_of(positions, ranges[t]);
        trees[t].search.emplace(points, flann::KDTreeSingleIndexParams(most_a_leaf, true));
        trees[t].search->buildIndex();
    });
    return trees;
}

void search_tree(const Tree& tree, const float* place, NearestOthers& nearest) {
    const flann::SearchParams exact(flann::FLANN_CHECKS_UNLIMITED, 0.0F, true);
    nearest.number_from(tree.vertices.begin);
    tree.search->findNeighbors(nearest, place, exact);
}

// Some vertices of one tree, next to each other.
struct Run {
    const Tree* tree;
    Range vertices;
};

std::vector<Run> runs_of(std::span<const Tree> trees) {
    std::vector<Run> runs;
    for (const Tree& tree : trees)
        for (std::size_t begin = tree.vertices.begin; begin < tree.vertices.end; begin += most_a_run)
            runs.push_back({&tree, {begin, std::min(begin + most_a_run, tree.vertices.end)}});
    return runs;
}

// The other trees that may hold what a vertex of the run searches for. With enough others in the run, nothing
// that is sought lies farther away than the run is wide.
std::vector<const Tree*> trees_around(const Run& run, std::span<const float> positions, std::size_t k,
                                      std::span<const Tree> trees) {
    const Box box = box_of(positions, run.vertices);
    const bool has_enough = run.vertices.end - run.vertices.begin > k;
    const double reach = has_enough ? squared_diagonal(box) : std::numeric_limits<double>::infinity();
    std::vector<const Tree*> around;
    for (const Tree& tree : trees)
        if (&tree != run.tree && squared_distance(box, tree.box) <= reach) around.push_back(&tree);
    return around;
}

// Writes the k nearest others of each vertex of a run.
void search_run(const Run& run, std::span<const float> positions, std::size_t k, std::span<const Tree> trees,
                std::span<Index> lists) {
    const std::vector<const Tree*> around = trees_around(run, positions, k, trees);
    NearestOthers nearest(k);
    for (std::size_t v = run.vertices.begin; v < run.vertices.end; ++v) {
        nearest.start(v);
        search_tree(*run.tree, positions.data() + 3 * v, nearest);
        for (const Tree* tree : around)
            if (squared_distance(box_of(positions, v), tree->box) <= nearest.worstDist())
                search_tree(*tree, positions.data() + 3 * v, nearest);
        std::ranges::transform(nearest.found(), lists.begin() + static_cast<std::ptrdiff_t>(v * k),
                               &Other::vertex);
    }
}

// FLANN takes the middle between two coordinates as half of their sum, in float. A quarter of them cannot
// overflow there, and lies in the same order.
std::vector<float> quartered(std::span<const float> positions) {
    std::vector<float> quarters(positions.size());
    std::ranges::transform(positions, quarters.begin(), [](float value) { return 0.25F * value; });
    return quarters;
}

bool is_huge(std::span<const float> positions) {
    constexpr float limit = 0.25F * std::numeric_limits<float>::max();
    return std::ranges::any_of(positions, [](float value) { return std::abs(value) > limit; });
}

} // namespace

std::vector<Index> nearest_lists(std::span<const float> positions, std::size_t k, Workers& workers,
                                 Progress& progress, std::size_t most_a_tree) {
    const std::size_t vertices = positions.size() / 3;
    require(k >= 1 && k < vertices && most_a_tree >= 1, "k others, and a tree of at least one");
    if (is_huge(positions)) return nearest_lists(quartered(positions), k, workers, progress, most_a_tree);

    progress.step("finding neighbours", 0);
    const std::vector<Tree> trees = make_trees(positions, most_a_tree, workers);
    const std::vector<Run> runs = runs_of(trees);
    auto lists = zeros_in_large_pages<Index>(vertices * k, workers);
    constexpr std::size_t runs_a_step = 256; // so that a long search can be stopped
    for (std::size_t first = 0; first < runs.size(); first += runs_a_step) {
        progress.step("finding neighbours",
                      0.1 + 0.8 * static_cast<double>(first) / static_cast<double>(runs.size()));
        workers.for_each(std::min(runs_a_step, runs.size() - first), 1,
                         [&](std::size_t run) { search_run(runs[first + run], positions, k, trees, lists); });
    }
    return lists;
}

} // namespace knead
