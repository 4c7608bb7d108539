#include "edit/falloffs.h"

#include "graph/distances.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace knead {

namespace {

constexpr double strength = 4;
constexpr double nearest = 0.0012; // of the cloud's size: nearer than this the pull does not grow any more

constexpr std::size_t stretch = 1 << 14; // of vertices

constexpr double small_handle = 0.03;  // of the cloud's size: the radius of one that needs no falloff
constexpr double small_falloff = 0.06; // of the cloud's size, of a handle of one point

double least_falloff(std::span<const Index> vertices, std::span<const float> positions, double cloud_size) {
    Vec3d middle = Vec3d::Zero();
    for (const Index v : vertices) middle += point_at(positions, v) / static_cast<double>(vertices.size());
    double squares = 0;
    for (const Index v : vertices) squares += (point_at(positions, v) - middle).squaredNorm();
    const double radius = std::sqrt(2 * squares / static_cast<double>(vertices.size())); // as of a disc
    return small_falloff * std::max(0.0, cloud_size - radius / small_handle);
}

// The vertices of each handle, ascending: those of each stretch of vertices are counted, then have their
// place.
std::vector<std::vector<Index>> held_vertices(std::size_t handles, std::span<const Index> vertex_handle,
                                              Workers& workers) {
    const std::size_t stretches = (vertex_handle.size() + stretch - 1) / stretch;
    std::vector<std::size_t> place(stretches * handles, 0);
    const auto each_held = [&](auto&& visit) {
        workers.for_chunks(vertex_handle.size(), stretch, [&](std::size_t begin, std::size_t end) {
            const std::span places(place.data() + begin / stretch * handles, handles);
            for (std::size_t v = begin; v < end; ++v)
                if (vertex_handle[v] < handles) visit(static_cast<Index>(v), places[vertex_handle[v]]++);
        });
    };
    each_held([](Index, std::size_t) {});
    std::vector<std::vector<Index>> held(handles);
    for (std::size_t h = 0; h < handles; ++h) {
        std::size_t total = 0;
        for (std::size_t at = h; at < place.size(); at += handles) {
            total += place[at];
            place[at] = total - place[at];
        }
        held[h].resize(total);
    }
    each_held([&](Index v, std::size_t at) { held[vertex_handle[v]][at] = v; });
    return held;
}

// Where the samples of each handle lie at rest, in the middle.
std::vector<Vec3d> middles_of_handles(const SampleRest& rest, std::size_t handles) {
    std::vector<Vec3d> middle(handles, Vec3d::Zero());
    std::vector<double> count(handles, 0);
    for (std::size_t s = 0; s < rest.handle.size(); ++s) {
        if (!(rest.handle[s] < handles)) continue;
        middle[rest.handle[s]] += rest.position[s];
        ++count[rest.handle[s]];
    }
    for (std::size_t h = 0; h < handles; ++h) middle[h] /= std::max(count[h], 1.0);
    return middle;
}

// Σ w |e|² of a sample.
double spread_at(const SampleRest& rest, Index sample) {
    double spread = 0;
    for (Index link = rest.graph.first[sample]; link < rest.graph.first[sample + 1]; ++link)
        spread += rest.weight[link] *
                  (rest.position[rest.graph.neighbor[link]] - rest.position[sample]).squaredNorm();
    return spread;
}

} // namespace

std::vector<Pulled> pulled_samples(const std::vector<Handle>& handles, std::span<const Index> vertex_handle,
                                   std::span<const Index> samples, const Graph& graph,
                                   std::span<const float> positions, double cloud_size, Workers& workers) {
    const std::vector<std::vector<Index>> held = held_vertices(handles.size(), vertex_handle, workers);
    std::vector<double> falloff(handles.size(), 0);
    workers.for_each(held.size(), 1, [&](std::size_t h) {
        if (!held[h].empty())
            falloff[h] = std::max(handles[h].falloff, least_falloff(held[h], positions, cloud_size));
    });
    std::unordered_map<Index, Index> sample_of;
    for (Index s = 0; s < samples.size(); ++s)
        if (vertex_handle[samples[s]] == no_index) sample_of.emplace(samples[s], s);
    std::vector<Pulled> pulled;
    for (Index h = 0; h < held.size(); ++h) {
        if (!(falloff[h] > 0)) continue;
        for (const Reached& near : reached_within(graph, positions, held[h], falloff[h])) {
            const auto sample = sample_of.find(near.vertex);
            if (sample != sample_of.end() && near.distance < falloff[h])
                pulled.push_back({sample->second, h, near.distance / falloff[h], falloff[h]});
        }
    }
    return pulled;
}

std::vector<SoftHold> soft_holds(const std::vector<Handle>& handles, std::span<const Pulled> pulled,
                                 const SampleRest& rest) {
    const std::vector<Vec3d> middle = middles_of_handles(rest, handles.size());
    std::vector<SoftHold> holds;
    for (const Pulled& each : pulled) {
        if (is_leaf(rest, each.sample)) continue; // it goes where the other end of its link is pulled
        const double distance = std::max(each.way * each.falloff, nearest * rest.cloud_size);
        const double share = (1 - each.way) / distance;
        const double weight = strength * share * share * spread_at(rest, each.sample);
        const Vec3d anchor =
            handles[each.handle].free_rotation ? middle[each.handle] : rest.position[each.sample];
        if (weight > 0) holds.push_back({each.sample, each.handle, weight, anchor});
    }
    return holds;
}

} // namespace knead
