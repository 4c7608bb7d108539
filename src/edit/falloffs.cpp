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

constexpr double small_handle = 0.03;  // of the cloud's size: the radius of one that needs no falloff
constexpr double small_falloff = 0.06; // of the cloud's size, of a handle of one point

double least_falloff(const HeldExtent& held, double cloud_size) {
    return small_falloff * std::max(0.0, cloud_size - held.radius() / small_handle);
}

// What each handle holds in all.
std::vector<HeldExtent> extents_of(std::size_t handles, std::span<const HeldBlock> blocks) {
    std::vector<HeldExtent> extents(handles);
    for (const HeldBlock& block : blocks)
        for (const HeldExtent& here : block.extents)
            if (here.label < handles) extents[here.label].add(here);
    return extents;
}

// The vertices, ascending, of the handles that are `wanted`.
std::vector<std::vector<Index>> held_vertices(const std::vector<bool>& wanted,
                                              std::span<const HeldBlock> blocks,
                                              std::span<const Index> label) {
    std::vector<std::vector<Index>> vertices(wanted.size());
    const auto is_wanted = [&](Index handle) { return handle < wanted.size() && wanted[handle]; };
    for (std::size_t block = 0; block < blocks.size(); ++block) {
        if (std::ranges::none_of(blocks[block].extents, is_wanted, &HeldExtent::label)) continue;
        const std::size_t end = std::min(label.size(), (block + 1) * rows_in_block);
        for (std::size_t v = block * rows_in_block; v < end; ++v)
            if (is_wanted(label[v])) vertices[label[v]].push_back(static_cast<Index>(v));
    }
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

std::vector<Pulled> pulled_samples(const std::vector<Handle>& handles, std::span<const Index> label,
                                   std::span<const HeldBlock> blocks, std::span<const Index> samples,
                                   const Graph& graph, std::span<const float> positions, double cloud_size) {
    const std::vector<HeldExtent> extents = extents_of(handles.size(), blocks);
    std::vector<double> falloff(handles.size(), 0);
    std::vector<bool> pulls(handles.size(), false);
    for (std::size_t h = 0; h < handles.size(); ++h) {
        if (extents[h].count > 0)
            falloff[h] = std::max(handles[h].falloff, least_falloff(extents[h], cloud_size));
        pulls[h] = falloff[h] > 0;
    }
    if (std::ranges::none_of(pulls, std::identity{})) return {};
    const std::vector<std::vector<Index>> held = held_vertices(pulls, blocks, label);
    std::unordered_map<Index, Index> sample_of;
    for (Index s = 0; s < samples.size(); ++s)
        if (label[samples[s]] == no_index) sample_of.emplace(samples[s], s);
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
