#include "edit/falloffs.h"

#include "graph/distances.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_map>

namespace knead {

namespace {

constexpr double strength = 4;
constexpr double nearest = 0.0012; // of the cloud's size: nearer than this the pull does not grow any more

constexpr std::size_t stretch = 1 << 14; // of vertices

constexpr double small_handle = 0.03;  // of the cloud's size: the radius of one that needs no falloff
constexpr double small_falloff = 0.06; // of the cloud's size, of a handle of one point

// How many vertices a handle holds, where they are, and how far apart.
struct Held {
    std::size_t count = 0;
    Vec3d sum = Vec3d::Zero(); // of the positions, seen from the cloud's first vertex
    double squares = 0;

    void add(const Vec3d& position) {
        ++count;
        sum += position;
        squares += position.squaredNorm();
    }
    void add(const Held& other) {
        count += other.count;
        sum += other.sum;
        squares += other.squares;
    }
    double radius() const { // as of a disc
        const auto n = static_cast<double>(count);
        return std::sqrt(std::max(0.0, 2 * (squares / n - (sum / n).squaredNorm())));
    }
};

double least_falloff(const Held& held, double cloud_size) {
    return small_falloff * std::max(0.0, cloud_size - held.radius() / small_handle);
}

// What each handle holds of each stretch of vertices: the handles of the first stretch, of the second, ...
std::vector<Held> held_by_stretch(std::size_t handles, const VertexLabels& labels,
                                  std::span<const float> positions, Workers& workers) {
    const std::size_t vertices = labels.label.size();
    std::vector<Held> held((vertices + stretch - 1) / stretch * handles);
    workers.for_chunks(vertices, stretch, [&](std::size_t begin, std::size_t end) {
        const std::span here(held.data() + begin / stretch * handles, handles);
        Index handle = no_index;
        Held run; // neighbours are mostly of one handle
        const auto next_run = [&](Index of) {
            if (handle < handles) here[handle].add(run);
            handle = of;
            run = {};
        };
        for_each_held(labels, begin, end, [&](Index v) {
            if (labels.label[v] != handle) next_run(labels.label[v]);
            run.add(point_at(positions, v) - point_at(positions, 0));
        });
        next_run(no_index);
    });
    return held;
}

// The vertices, ascending, of the handles that are `wanted`.
std::vector<std::vector<Index>> held_vertices(const std::vector<bool>& wanted, std::span<const Held> held,
                                              const VertexLabels& labels, Workers& workers) {
    const std::size_t handles = wanted.size();
    std::vector<std::vector<Index>> vertices(handles);
    std::vector<std::size_t> place;
    for (const Held& here : held) { // where those of each stretch begin
        const std::size_t h = place.size() % handles;
        place.push_back(vertices[h].size());
        if (wanted[h]) vertices[h].resize(place.back() + here.count);
    }
    workers.for_chunks(labels.label.size(), stretch, [&](std::size_t begin, std::size_t end) {
        const std::span places(place.data() + begin / stretch * handles, handles);
        for_each_held(labels, begin, end, [&](Index v) {
            if (const Index h = labels.label[v]; h < handles && wanted[h]) vertices[h][places[h]++] = v;
        });
    });
    return vertices;
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

std::vector<Pulled> pulled_samples(const std::vector<Handle>& handles, const VertexLabels& labels,
                                   std::span<const Index> samples, const Graph& graph,
                                   std::span<const float> positions, double cloud_size, Workers& workers) {
    const std::vector<Held> parts = held_by_stretch(handles.size(), labels, positions, workers);
    std::vector<Held> whole(handles.size());
    for (std::size_t i = 0; i < parts.size(); ++i) whole[i % handles.size()].add(parts[i]);
    std::vector<double> falloff(handles.size(), 0);
    std::vector<bool> pulls(handles.size(), false);
    for (std::size_t h = 0; h < handles.size(); ++h) {
        if (whole[h].count > 0)
            falloff[h] = std::max(handles[h].falloff, least_falloff(whole[h], cloud_size));
        pulls[h] = falloff[h] > 0;
    }
    if (std::ranges::none_of(pulls, std::identity{})) return {};
    const std::vector<std::vector<Index>> held = held_vertices(pulls, parts, labels, workers);
    std::unordered_map<Index, Index> sample_of;
    for (Index s = 0; s < samples.size(); ++s)
        if (labels.label[samples[s]] == no_index) sample_of.emplace(samples[s], s);
    std::vector<Pulled> pulled;
    for (Index h = 0; h < held.size(); ++h) {
        if (!pulls[h]) continue;
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
