#include "edit/falloffs.h"

#include "base/require.h"
#include "graph/distances.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <unordered_map>

namespace knead {

namespace {

// Handles are searched round so many at a time, and in between it is asked whether to go on.
constexpr std::size_t handles_at_once = 16;

constexpr double strength = 4;
constexpr double nearest = 0.0012; // of the cloud's size: nearer than this the pull does not grow any more

// The vertices, ascending, of the handles that are `wanted`.
std::vector<std::vector<Index>> held_vertices(const std::vector<bool>& wanted,
                                              std::span<const HeldBlock> blocks,
                                              std::span<const Index> label) {
    std::vector<std::vector<Index>> vertices(wanted.size());
    const auto is_wanted = [&](Index handle) { return is_set(wanted, handle); };
    for (std::size_t block = 0; block < blocks.size(); ++block) {
        if (std::ranges::none_of(blocks[block].extents, is_wanted, &HeldExtent::label)) continue;
        const auto [begin, end] = rows_of_block(block, label.size());
        for (std::size_t v = begin; v < end; ++v)
            if (is_wanted(label[v])) vertices[label[v]].push_back(static_cast<Index>(v));
    }
    return vertices;
}

// Of the vertices of small patches, where a handle has a falloff of its own.
std::unordered_map<Index, double> least_falloffs(std::span<const SmallPatch> patches,
                                                 const std::vector<bool>& has_falloff) {
    std::unordered_map<Index, double> least;
    for (const SmallPatch& patch : patches)
        if (has_falloff[patch.handle])
            for (const Index v : patch.vertices) least.emplace(v, patch.falloff);
    return least;
}

// Vertices of one handle each that hang together.
struct Patches {
    std::vector<Index> of; // of each vertex; no_index where it was not asked for
    std::vector<HeldExtent> extents;
};

// Those of the handles that leave rotation free.
Patches free_patches(const std::vector<Handle>& handles, const std::vector<std::vector<Index>>& held,
                     std::span<const Index> label, const Graph& graph, std::span<const float> positions) {
    Patches patches;
    std::vector<Index> next;
    for (std::size_t h = 0; h < handles.size(); ++h) {
        if (!handles[h].free_rotation || held[h].empty()) continue;
        patches.of.resize(label.size(), no_index);
        for (const Index start : held[h]) {
            if (patches.of[start] != no_index) continue;
            const auto patch = static_cast<Index>(patches.extents.size());
            HeldExtent& extent = patches.extents.emplace_back();
            patches.of[start] = patch;
            next.push_back(start);
            while (!next.empty()) {
                const Index vertex = next.back();
                next.pop_back();
                extent.add(point_at(positions, vertex) - point_at(positions, start));
                for (const Index other : graph.row(vertex)) {
                    if (label[other] != h || patches.of[other] != no_index) continue;
                    patches.of[other] = patch;
                    next.push_back(other);
                }
            }
        }
    }
    return patches;
}

// How much of what a patch pulls turns as a sample of it does: all, where the patch is larger than its
// falloff.
double share_of_turner(double radius, double falloff) {
    const double part = std::min(radius / falloff, 1.0);
    return part * part;
}

// The handle's sample that is nearest to a vertex that it holds, of those in the same part, told once for
// each vertex. A sample of another part says nothing of how this one turns.
class NearestOfHandle {
public:
    NearestOfHandle(std::span<const Index> label, const ComponentNumbers& part,
                    std::span<const Index> samples, std::span<const float> positions)
        : label_(label), part_(part), samples_(samples), positions_(positions) {
        for (Index s = 0; s < samples.size(); ++s)
            if (label[samples[s]] != no_index) of_handle_[place_of(samples[s])].push_back(s);
    }

    Index to(Index vertex) {
        const auto [known, is_new] = nearest_.try_emplace(vertex, no_index);
        if (!is_new) return known->second;
        double smallest = std::numeric_limits<double>::infinity();
        for (const Index s : of_handle_[place_of(vertex)]) {
            const double distance =
                (point_at(positions_, samples_[s]) - point_at(positions_, vertex)).squaredNorm();
            if (distance < smallest) smallest = distance, known->second = s;
            if (distance == 0) break;
        }
        return known->second;
    }

private:
    std::pair<Index, Index> place_of(Index vertex) const { return {label_[vertex], part_[vertex]}; }

    std::span<const Index> label_;
    const ComponentNumbers& part_;
    std::span<const Index> samples_;
    std::span<const float> positions_;
    std::map<std::pair<Index, Index>, std::vector<Index>> of_handle_; // by handle and part
    std::unordered_map<Index, Index> nearest_;
};

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
                                   const ComponentNumbers& part, std::span<const HeldBlock> blocks,
                                   std::span<const SmallPatch> patches, const Vicinities& near,
                                   std::span<const Index> samples, const Graph& graph,
                                   std::span<const float> positions, Workers& workers, Progress& progress) {
    std::vector<bool> has_falloff(handles.size()), pulls(handles.size());
    for (std::size_t h = 0; h < handles.size(); ++h) {
        has_falloff[h] = handles[h].falloff > 0;
        pulls[h] = has_falloff[h] || !near[h].empty();
    }
    if (std::ranges::none_of(pulls, std::identity{})) return {};
    const std::vector<std::vector<Index>> held = held_vertices(pulls, blocks, label);
    std::unordered_map<Index, Index> sample_of;
    for (Index s = 0; s < samples.size(); ++s)
        if (label[samples[s]] == no_index) sample_of.emplace(samples[s], s);
    const std::unordered_map<Index, double> least = least_falloffs(patches, has_falloff);
    const auto pulled_by = [&](Index h) {
        std::vector<Pulled> pulled;
        const auto add = [&](Index vertex, double distance, double falloff, Index source) {
            const auto sample = sample_of.find(vertex);
            if (sample != sample_of.end() && distance < falloff)
                pulled.push_back({sample->second, h, distance / falloff, falloff, source});
        };
        const double own = handles[h].falloff;
        for (const NearPatch& each : near[h])
            if (patches[each.patch].falloff > own)
                add(each.vertex, each.distance, patches[each.patch].falloff, each.source);
        if (!(own > 0)) return pulled;
        for (const Reached& each : reached_within(graph, positions, held[h], own)) {
            const auto of_patch = least.find(each.source);
            if (of_patch == least.end() || of_patch->second <= own)
                add(each.vertex, each.distance, own, each.source);
        }
        return pulled;
    };
    std::vector<Pulled> pulled;
    std::vector<std::vector<Pulled>> some(handles_at_once);
    for (std::size_t first = 0; first < held.size(); first += handles_at_once) {
        progress.step("finding what handles pull",
                      static_cast<double>(first) / static_cast<double>(held.size()));
        const std::size_t count = std::min(handles_at_once, held.size() - first);
        workers.for_each(count, 1, [&](std::size_t k) {
            const auto h = static_cast<Index>(first + k);
            some[k] = pulls[h] ? pulled_by(h) : std::vector<Pulled>();
        });
        for (std::size_t k = 0; k < count; ++k) pulled.insert(pulled.end(), some[k].begin(), some[k].end());
    }
    const Patches beds = free_patches(handles, held, label, graph, positions);
    NearestOfHandle nearest_sample(label, part, samples, positions);
    for (Pulled& one : pulled) {
        if (!handles[one.handle].free_rotation) continue;
        one.turner = nearest_sample.to(one.held);
        if (one.turner == no_index) continue; // nothing tells how it turns
        one.bed = beds.of[one.held];
        one.as_turner = share_of_turner(beds.extents[one.bed].radius(), one.falloff);
    }
    return pulled;
}

std::vector<SoftHold> soft_holds(const std::vector<Handle>& handles, std::span<const Pulled> pulled,
                                 std::span<const Vec3d> held, const SampleRest& rest) {
    require(held.size() == pulled.size(), "a place for each that is pulled");
    std::vector<SoftHold> holds;
    for (std::size_t k = 0; k < pulled.size(); ++k) {
        const Pulled& each = pulled[k];
        if (is_leaf(rest, each.sample)) continue; // it goes where the other end of its link is pulled
        const double distance = std::max(each.way * each.falloff, nearest * rest.cloud_size);
        const double share = (1 - each.way) / distance;
        const double weight = strength * share * share * spread_at(rest, each.sample);
        if (!(weight > 0)) continue;
        if (handles[each.handle].free_rotation)
            holds.push_back(
                {each.sample, each.handle, weight, held[k], each.bed, each.turner, each.as_turner});
        else
            holds.push_back({each.sample, each.handle, weight, rest.position[each.sample]});
    }
    return holds;
}

} // namespace knead
