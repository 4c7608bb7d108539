#pragma once
// Small clouds and their graphs, for the tests of graph and deform.

#include "graph/flood.h"
#include "graph/link_lengths.h"
#include "graph/neighbors.h"
#include "graph/octree.h"
#include "graph/point_order.h"
#include "graph/sampling.h"
#include "graph/scrambled.h"
#include "shapes/shapes.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace knead::test {

// What most calls want.
struct Machine {
    explicit Machine(unsigned threads = 2) : workers(threads) {}
    Workers workers;
    SilentProgress progress;
};

// The vertices of a cloud and all that the graph room knows of them.
struct Cloud {
    std::vector<float> positions;
    MortonCube cube;
    Graph graph;
    Components components;
    std::vector<std::uint8_t> lengths; // link_lengths()

    std::size_t size() const { return positions.size() / 3; }
    Vec3d at(std::size_t v) const { return Eigen::Map<const Vec3f>(positions.data() + 3 * v).cast<double>(); }
    VertexShape shape() const { return {cube, positions, graph, components}; }
    std::vector<std::uint8_t> hops() const { return std::vector<std::uint8_t>(graph.neighbor.size(), 1); }
};

inline Cloud cloud_of(const std::vector<float>& file_positions, std::size_t k = 6, unsigned threads = 2) {
    Machine machine(threads);
    const PointOrder order = order_points(file_positions, machine.workers, machine.progress);
    std::vector<float> ordered(3 * order.points());
    gather(order, file_positions, 3, ordered, machine.workers);
    Cloud cloud;
    cloud.positions = vertex_positions(order, ordered, machine.workers);
    cloud.cube = order.cube;
    cloud.graph = neighbor_graph(cloud.positions, k, machine.workers, machine.progress);
    cloud.components = find_components(cloud.graph, machine.workers);
    cloud.lengths = link_lengths(cloud.graph, cloud.positions, machine.workers);
    return cloud;
}

inline Components components_of(const Graph& graph) {
    Machine machine;
    return find_components(graph, machine.workers);
}

inline std::vector<float> shape_positions(Shape shape, std::size_t points, double gradient = 1) {
    Machine machine;
    ShapeOptions options;
    options.points = points;
    options.gradient = gradient;
    return make_shape(shape, options, machine.workers, machine.progress).positions;
}

inline void append(std::vector<float>& positions, const Vec3d& p) {
    for (int axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>(p[axis]));
}

// One of so many, picked at random: however evenly these lie, those do not.
inline std::vector<float> picked(const std::vector<float>& positions, std::size_t one_of) {
    std::mt19937 random(5);
    std::vector<float> result;
    for (std::size_t i = 0; i < positions.size() / 3; ++i)
        if (random() % one_of == 0) append(result, point_at(positions, i));
    return result;
}

// Unit spacing: every vertex has neighbours at exactly equal distances.
inline std::vector<float> grid_positions(int columns, int rows) {
    std::vector<float> positions;
    for (int x = 0; x < columns; ++x)
        for (int y = 0; y < rows; ++y) append(positions, Vec3d(x, y, 0));
    return positions;
}

inline Vec3d random_vector(std::mt19937& random) {
    std::uniform_real_distribution<double> coordinate(-1, 1);
    const double x = coordinate(random);
    const double y = coordinate(random);
    return {x, y, coordinate(random)};
}

// Evenly random in a cube of edge 2 around `middle`.
inline std::vector<float> random_positions(std::size_t points, unsigned seed,
                                           const Vec3d& middle = Vec3d::Zero()) {
    std::mt19937 random(seed);
    std::vector<float> positions;
    for (std::size_t i = 0; i < points; ++i) append(positions, middle + random_vector(random));
    return positions;
}

// Two patches of a plane, 12 apart, and if `neck` says so a single row of points from one to the other.
inline std::vector<float> two_patches(bool neck) {
    std::vector<float> positions;
    for (int side = 0; side < 2; ++side)
        for (int x = 0; x < 12; ++x)
            for (int y = 0; y < 12; ++y)
                append(positions, Vec3d(24 * side + x + 0.1 * (y % 3), y + 0.07 * x, 0.2 * std::sin(x * y)));
    if (neck)
        for (int step = 1; step <= 12; ++step) append(positions, Vec3d(11.5 + step, 5.5, 0));
    return positions;
}

// A tube around z from 0 to `length` without caps, of `rings` rings, each turned against the one before.
inline std::vector<float> tube_positions(int rings, int around, double radius, double length) {
    std::vector<float> positions;
    for (int ring = 0; ring < rings; ++ring) {
        for (int step = 0; step < around; ++step) {
            const double angle = 2 * std::numbers::pi * (step + 0.5 * (ring % 2)) / around;
            append(positions,
                   Vec3d(radius * std::cos(angle), radius * std::sin(angle), length * ring / (rings - 1)));
        }
    }
    return positions;
}

struct NamedCloud {
    std::string name;
    Cloud cloud;
};

// Surfaces and a solid, open and closed, with many equal distances and with none, whole and in parts.
inline std::vector<NamedCloud> several_clouds() {
    std::vector<NamedCloud> clouds;
    clouds.push_back({"grid", cloud_of(grid_positions(24, 20), 4)});
    clouds.push_back({"sphere", cloud_of(shape_positions(Shape::sphere, 700))});
    clouds.push_back({"knot", cloud_of(shape_positions(Shape::knot, 1500))});
    clouds.push_back({"creature", cloud_of(shape_positions(Shape::creature, 1500))});
    clouds.push_back({"random", cloud_of(random_positions(500, 3))});
    clouds.push_back({"two patches", cloud_of(two_patches(false))});
    return clouds;
}

// `count` different vertices, in no particular order.
inline std::vector<Index> random_vertices(std::size_t vertices, std::size_t count, unsigned seed) {
    std::vector<Index> all(vertices);
    for (std::size_t v = 0; v < vertices; ++v) all[v] = static_cast<Index>(v);
    std::mt19937 random(seed);
    std::ranges::shuffle(all, random);
    all.resize(std::min(count, vertices));
    return all;
}

// Base samples, as the editor takes them before they are relaxed.
inline std::vector<Index> octree_of(const Cloud& cloud, std::size_t count) {
    std::vector<Index> all(cloud.size());
    std::iota(all.begin(), all.end(), Index{0});
    return octree_samples(cloud.cube, cloud.positions, all, count);
}

// Numbered as the editor numbers them.
inline std::vector<Index> shuffled_in_runs(std::vector<Index> vertices) {
    shuffle_in_runs(vertices);
    return vertices;
}

inline bool all_different(const std::vector<Index>& vertices) {
    return std::set<Index>(vertices.begin(), vertices.end()).size() == vertices.size();
}

// What csr.h promises of every graph.
inline void expect_well_formed(const Graph& graph) {
    for (Index v = 0; v < graph.size(); ++v) {
        const auto row = graph.row(v);
        ASSERT_TRUE(std::ranges::adjacent_find(row, std::ranges::greater_equal()) == row.end())
            << "row " << v << " does not ascend";
        for (const Index u : row) {
            ASSERT_NE(u, v) << "a vertex is linked to itself";
            ASSERT_LT(u, graph.size());
            ASSERT_TRUE(find_link(graph, u, v).has_value()) << v << " → " << u << " has no way back";
        }
    }
}

inline bool same_graph(const Graph& a, const Graph& b) {
    return a.first == b.first && a.neighbor == b.neighbor;
}

} // namespace knead::test
