#include "graph/shading_normals.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>

namespace knead {

namespace {

constexpr int rounds = 2; // of evening out: what noise of a tenth of the spacing needs

// A surface that is at least so flat, of its neighbours alone, is taken as it lies. Where scans overlap and
// do not quite fit each other, neighbours are a lump, and one looks farther: two links, and then at runs of
// vertices before and behind it in their order, in which near ones follow each other. Of long runs only some.
constexpr float flat_enough = 0.1F;
struct Run {
    std::size_t length, stride;
};
constexpr std::array runs{Run{64, 2}, Run{256, 8}, Run{1024, 32}};

// Farther is only better where it is so much flatter: edges and hollows stay.
constexpr float flatter = 0.7F;

// A vertex without a surface around counts so much for its neighbours; a flat one 1.
constexpr float least_say = 0.02F;

// A plane through some points.
struct Plane {
    Vec3f normal = Vec3f::UnitZ();
    float roughness = 1; // the spread across it over the smaller one along it, 0 … 1
};

// The plane through the points that each(take) calls take(vertex) for, seen from one of them.
template<typename Each>
Plane plane_through(std::span<const float> positions, Index seen_from, Each&& each) {
    const Vec3d own = point_at(positions, seen_from);
    Vec3d sum = Vec3d::Zero();
    Mat3d squares = Mat3d::Zero();
    double count = 0;
    each([&](Index u) {
        const Vec3d way = point_at(positions, u) - own;
        sum += way;
        squares += way * way.transpose();
        ++count;
    });
    const Mat3d spread = squares / count - (sum / count) * (sum / count).transpose();
    Eigen::SelfAdjointEigenSolver<Mat3d> axes;
    axes.computeDirect(spread);
    const Vec3d& along = axes.eigenvalues();
    if (!(along[1] > 0)) return {}; // a line, or a single place
    return {axes.eigenvectors().col(0).cast<float>(),
            static_cast<float>(std::clamp(along[0] / along[1], 0.0, 1.0))};
}

Plane plane_of_neighbors(const Graph& graph, std::span<const float> positions, Index v) {
    return plane_through(positions, v, [&](auto&& take) {
        take(v);
        for (const Index u : graph.row(v)) take(u);
    });
}

// Those that are met in more ways count more.
Plane plane_of_their_neighbors(const Graph& graph, std::span<const float> positions, Index v) {
    return plane_through(positions, v, [&](auto&& take) {
        const auto take_around = [&](Index u) {
            take(u);
            for (const Index w : graph.row(u)) take(w);
        };
        take_around(v);
        for (const Index u : graph.row(v)) take_around(u);
    });
}

Plane plane_of_run(std::span<const float> positions, Index v, const Run& run) {
    const std::size_t vertices = positions.size() / 3;
    const std::size_t half = run.length / 2 / run.stride * run.stride;
    const std::size_t first = v - std::min<std::size_t>(v / run.stride * run.stride, half);
    return plane_through(positions, v, [&](auto&& take) {
        for (std::size_t u = first; u < std::min(vertices, v + half); u += run.stride)
            take(static_cast<Index>(u));
    });
}

Plane plane_at(const Graph& graph, std::span<const float> positions, Index v) {
    Plane best = plane_of_neighbors(graph, positions, v);
    const auto compare = [&](const Plane& wider) {
        if (wider.roughness < flatter * best.roughness) best = wider;
    };
    if (best.roughness > flat_enough) compare(plane_of_their_neighbors(graph, positions, v));
    for (const Run& run : runs)
        if (best.roughness > flat_enough) compare(plane_of_run(positions, v, run));
    return best;
}

using Normals = std::vector<float>;

Vec3f normal_of(const Normals& normals, std::size_t v) {
    return Eigen::Map<const Vec3f>(normals.data() + 3 * v);
}

// The mean of a vertex's own normal and its neighbours', each turned to its side, by what they have to say.
Vec3f evened_out(const Graph& graph, const Normals& normals, std::span<const float> say, std::size_t v) {
    const Vec3f own = normal_of(normals, v);
    Vec3f sum = say[v] * own;
    for (const Index u : graph.row(v)) {
        const Vec3f other = normal_of(normals, u);
        sum += other.dot(own) < 0 ? Vec3f(-say[u] * other) : Vec3f(say[u] * other);
    }
    return sum.normalized(); // own · sum ≥ say, so it is not zero
}

} // namespace

std::vector<float> shading_normals(const Graph& graph, std::span<const float> positions, Workers& workers) {
    Normals normals(3 * graph.size());
    std::vector<float> say(graph.size());
    workers.for_each(graph.size(), 1024, [&](std::size_t v) {
        const Plane plane = plane_at(graph, positions, static_cast<Index>(v));
        Eigen::Map<Vec3f>(normals.data() + 3 * v) = plane.normal;
        say[v] = std::max(least_say, 1 - plane.roughness);
    });
    Normals next(normals.size());
    for (int round = 0; round < rounds; ++round) {
        workers.for_each(graph.size(), 4096, [&](std::size_t v) {
            Eigen::Map<Vec3f>(next.data() + 3 * v) = evened_out(graph, normals, say, v);
        });
        std::swap(normals, next);
    }
    return normals;
}

std::vector<float> spread_to_points(std::span<const float> vertex_normals, const Numbering& vertex) {
    std::vector<float> normals;
    normals.reserve(3 * vertex.size());
    for (std::size_t i = 0; i < vertex.size(); ++i) {
        const auto normal = vertex_normals.subspan(3 * std::size_t{vertex[i]}, 3);
        normals.insert(normals.end(), normal.begin(), normal.end());
    }
    return normals;
}

} // namespace knead
