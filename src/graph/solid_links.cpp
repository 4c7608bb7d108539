#include "graph/solid_links.h"

#include "graph/symmetric_graph.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace knead {

namespace {

// What the thinnest spread of a vertex's links has of the widest, at least, for them to go into all
// directions: of the outermost layer of a solid, too.
constexpr double all_directions = 0.12;

// The same of the places round about, for them not to be flat: at the face of a solid it is 0.3, on a surface
// with noise of half a spacing 0.2.
constexpr double not_flat = 0.22;

// How many are most.
constexpr double most = 0.75;

constexpr std::size_t grain = 1024;

double thinnest_to_widest(const Mat3d& spread) {
    Eigen::SelfAdjointEigenSolver<Mat3d> solver;
    solver.computeDirect(spread, Eigen::EigenvaluesOnly);
    const Vec3d& values = solver.eigenvalues();
    return values[2] > 0 ? values[0] / values[2] : 0;
}

bool goes_all_ways(const Graph& points, std::span<const float> positions, std::size_t v) {
    Mat3d spread = Mat3d::Zero();
    for (const Index u : points.row(v)) {
        const Vec3d direction = (point_at(positions, u) - point_at(positions, v)).normalized();
        spread += direction * direction.transpose();
    }
    return thinnest_to_widest(spread) > all_directions;
}

// v, its neighbours and theirs, ascending.
void find_surroundings(const Graph& points, Index v, std::vector<Index>& around) {
    around.assign(1, v);
    for (const Index u : points.row(v)) {
        const auto row = points.row(u);
        around.insert(around.end(), row.begin(), row.end());
    }
    const auto own = points.row(v);
    around.insert(around.end(), own.begin(), own.end());
    std::ranges::sort(around);
    around.erase(std::unique(around.begin(), around.end()), around.end());
}

bool are_most(std::span<const Index> around, std::span<const std::uint8_t> chosen) {
    std::size_t count = 0;
    for (const Index u : around) count += chosen[u];
    return static_cast<double>(count) >= most * static_cast<double>(around.size());
}

bool are_flat(std::span<const Index> around, std::span<const float> positions) {
    Vec3d mean = Vec3d::Zero();
    for (const Index u : around) mean += point_at(positions, u) / static_cast<double>(around.size());
    Mat3d spread = Mat3d::Zero();
    for (const Index u : around) {
        const Vec3d from_mean = point_at(positions, u) - mean;
        spread += from_mean * from_mean.transpose();
    }
    return thinnest_to_widest(spread) <= not_flat;
}

// The chosen vertices most of whose surroundings are chosen as well, and for which keep(around) is true.
template<typename Keep>
std::vector<std::uint8_t> amid(const Graph& points, std::span<const std::uint8_t> chosen, Workers& workers,
                               Keep&& keep) {
    std::vector<std::uint8_t> result(points.size(), 0);
    workers.for_chunks(points.size(), grain, [&](std::size_t begin, std::size_t end) {
        std::vector<Index> around;
        for (auto v = static_cast<Index>(begin); v < end; ++v) {
            if (!chosen[v]) continue;
            find_surroundings(points, v, around);
            result[v] = are_most(around, chosen) && keep(around) ? 1 : 0;
        }
    });
    return result;
}

// Adds links from v to the nearest of those around it.
void link_nearest(const Graph& points, std::span<const float> positions, Index v,
                  std::span<const Index> around, std::vector<std::pair<Index, Index>>& added) {
    std::vector<std::pair<double, Index>> by_distance;
    for (const Index u : around)
        if (u != v && points.row(u).size() > 1)
            by_distance.emplace_back((point_at(positions, u) - point_at(positions, v)).squaredNorm(), u);
    std::ranges::sort(by_distance);
    const std::size_t last = std::min(links_in_solid, by_distance.size());
    for (const auto& [squared, u] : by_distance)
        if (squared <= by_distance[last - 1].first * (1 + 1e-6)) added.emplace_back(v, u);
}

} // namespace

Graph with_solid_links(const Graph& points, std::span<const float> positions, Workers& workers) {
    std::vector<std::uint8_t> chosen(points.size());
    workers.for_each(points.size(), grain,
                     [&](std::size_t v) { chosen[v] = goes_all_ways(points, positions, v) ? 1 : 0; });
    chosen = amid(points, chosen, workers,
                  [&](std::span<const Index> around) { return !are_flat(around, positions); });
    chosen = amid(points, chosen, workers, [](std::span<const Index>) { return true; });
    std::vector<std::pair<Index, Index>> added;
    std::vector<Index> around;
    for (Index v = 0; v < points.size(); ++v) {
        if (!chosen[v]) continue;
        find_surroundings(points, v, around);
        link_nearest(points, positions, v, around, added);
    }
    return added.empty() ? points : with_edges(points, added, workers);
}

} // namespace knead
