#include "graph/shading_normals.h"

#include "graph/local_frames.h"

namespace knead {

namespace {

constexpr int rounds = 2; // of evening out: what noise of a tenth of the spacing needs

using Normals = std::vector<float>;

Vec3f normal_of(const Normals& normals, std::size_t v) {
    return Eigen::Map<const Vec3f>(normals.data() + 3 * v);
}

// The mean of a vertex's own normal and its neighbours', each turned to its side.
Vec3f evened_out(const Graph& graph, const Normals& normals, std::size_t v) {
    const Vec3f own = normal_of(normals, v);
    Vec3f sum = own;
    for (const Index u : graph.row(v)) {
        const Vec3f other = normal_of(normals, u);
        sum += other.dot(own) < 0 ? Vec3f(-other) : other;
    }
    return sum.normalized(); // own · sum ≥ 1, so it is not zero
}

} // namespace

std::vector<float> shading_normals(const Graph& graph, std::span<const float> positions, Workers& workers) {
    Normals normals = frame_normals(local_frames(graph, positions, workers));
    Normals next(normals.size());
    for (int round = 0; round < rounds; ++round) {
        workers.for_each(graph.size(), 4096, [&](std::size_t v) {
            Eigen::Map<Vec3f>(next.data() + 3 * v) = evened_out(graph, normals, v);
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
