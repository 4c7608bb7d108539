#include "graph/shading_normals.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>

namespace knead {

namespace {

constexpr int rounds = 2; // of evening out: what noise of a tenth of the spacing needs

// Surroundings that are at least so flat are a surface, and taken as they lie. Where scans overlap and do not
// quite fit each other they are a lump: single vertices in it may lie flat with their neighbours by chance.
constexpr float flat_enough = 0.1F;

// There points are drawn together, each to the mean of its neighbours, so often before their planes are
// looked at again: scans that lie less than a link apart become one surface.
constexpr std::array drawings{2, 4, 8};

// That is only better where it is so much flatter: edges and hollows stay.
constexpr float flatter = 0.7F;

// A vertex without a surface around counts so much for its neighbours; a flat one 1.
constexpr float least_say = 0.02F;

// A plane through some points.
struct Plane {
    Vec3f normal = Vec3f::UnitZ();
    float roughness = 1; // the spread across it over the smaller one along it, 0 … 1
};

// The plane through a vertex and its neighbours.
Plane plane_at(const Graph& graph, std::span<const float> positions, Index v) {
    const Vec3d own = point_at(positions, v);
    Vec3d sum = Vec3d::Zero();
    Mat3d squares = Mat3d::Zero();
    for (const Index u : graph.row(v)) {
        const Vec3d way = point_at(positions, u) - own;
        sum += way;
        squares += way * way.transpose();
    }
    const double count = 1 + static_cast<double>(graph.row(v).size());
    const Mat3d spread = squares / count - (sum / count) * (sum / count).transpose();
    Eigen::SelfAdjointEigenSolver<Mat3d> axes;
    axes.computeDirect(spread);
    const Vec3d& along = axes.eigenvalues();
    if (!(along[1] > 0)) return {}; // a line, or a single place
    return {axes.eigenvectors().col(0).cast<float>(),
            static_cast<float>(std::clamp(along[0] / along[1], 0.0, 1.0))};
}

float mean_around(const Graph& graph, std::span<const float> values, Index v) {
    float sum = values[v];
    for (const Index u : graph.row(v)) sum += values[u];
    return sum / static_cast<float>(1 + graph.row(v).size());
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

// What is known of the surface at each vertex.
struct Surface {
    Normals normals;
    std::vector<float> around; // how rough its surroundings are, 0 … 1
};

Surface surface_as_it_lies(const Graph& graph, std::span<const float> positions,
                           std::vector<float>& roughness, Workers& workers) {
    Surface surface{Normals(3 * graph.size()), std::vector<float>(graph.size())};
    workers.for_each(graph.size(), 1024, [&](std::size_t v) {
        const Plane plane = plane_at(graph, positions, static_cast<Index>(v));
        Eigen::Map<Vec3f>(surface.normals.data() + 3 * v) = plane.normal;
        roughness[v] = plane.roughness;
    });
    workers.for_each(graph.size(), 4096, [&](std::size_t v) {
        surface.around[v] = mean_around(graph, roughness, static_cast<Index>(v));
    });
    return surface;
}

// Draws these vertices, one time, to the means of their neighbours.
void draw_together(const Graph& graph, std::span<const Index> lumps, std::span<float> positions,
                   Workers& workers) {
    std::vector<Vec3f> drawn(lumps.size());
    workers.for_each(lumps.size(), 4096, [&](std::size_t k) {
        Vec3d sum = point_at(positions, lumps[k]);
        for (const Index u : graph.row(lumps[k])) sum += point_at(positions, u);
        drawn[k] = (sum / static_cast<double>(1 + graph.row(lumps[k]).size())).cast<float>();
    });
    for (std::size_t k = 0; k < lumps.size(); ++k)
        Eigen::Map<Vec3f>(positions.data() + 3 * std::size_t{lumps[k]}) = drawn[k];
}

// Takes the planes of points that are drawn together where the surroundings are no surface as they lie.
void look_through_lumps(const Graph& graph, std::span<const float> positions, std::vector<float>& roughness,
                        Surface& surface, Workers& workers) {
    std::vector<Index> lumps;
    for (Index v = 0; v < graph.size(); ++v)
        if (surface.around[v] > flat_enough) lumps.push_back(v);
    if (lumps.empty()) return;
    std::vector<float> drawn(positions.begin(), positions.end());
    std::vector<Plane> planes(lumps.size());
    for (const int times : drawings) {
        for (int time = 0; time < times; ++time) draw_together(graph, lumps, drawn, workers);
        workers.for_each(lumps.size(), 1024,
                         [&](std::size_t k) { planes[k] = plane_at(graph, drawn, lumps[k]); });
        for (std::size_t k = 0; k < lumps.size(); ++k) roughness[lumps[k]] = planes[k].roughness;
        workers.for_each(lumps.size(), 4096, [&](std::size_t k) {
            const Index v = lumps[k];
            const float around = mean_around(graph, roughness, v);
            if (surface.around[v] <= flat_enough || around >= flatter * surface.around[v]) return;
            surface.around[v] = around;
            Eigen::Map<Vec3f>(surface.normals.data() + 3 * std::size_t{v}) = planes[k].normal;
        });
    }
}

} // namespace

std::vector<float> shading_normals(const Graph& graph, std::span<const float> positions, Workers& workers) {
    std::vector<float> roughness(graph.size());
    Surface surface = surface_as_it_lies(graph, positions, roughness, workers);
    look_through_lumps(graph, positions, roughness, surface, workers);
    std::vector<float>& say = roughness; // of no other use from here on
    for (std::size_t v = 0; v < say.size(); ++v) say[v] = std::max(least_say, 1 - surface.around[v]);
    Normals& normals = surface.normals;
    Normals next(normals.size());
    for (int round = 0; round < rounds; ++round) {
        workers.for_each(graph.size(), 4096, [&](std::size_t v) {
            Eigen::Map<Vec3f>(next.data() + 3 * v) = evened_out(graph, normals, say, v);
        });
        std::swap(normals, next);
    }
    return std::move(surface.normals);
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
