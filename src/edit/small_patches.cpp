#include "edit/small_patches.h"

#include "graph/distances.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

namespace knead {

namespace {

constexpr double small_handle = 0.03; // of the cloud's size: the radius of what needs no falloff

// What has been looked at and is so many times as large is not looked at any further.
constexpr double surely_large = 2;

// Of the vertices of a surface about so many lie within the largest falloff of a point. So many of them are
// enough around each handle, and around all.
constexpr double part_around = 0.03;
constexpr double enough_around_one = 4096, enough_around_all = 1 << 18;

// Handles are searched round so many at a time, and in between it is asked whether to go on.
constexpr std::size_t handles_at_once = 16;

enum class Known : std::uint8_t { nothing, met, large };

// Searches through what hangs together, from any vertex of it.
class PatchSearch {
public:
    PatchSearch(std::span<const Index> label, const Graph& graph, std::span<const float> positions,
                double cloud_size)
        : label_(label), graph_(graph), positions_(positions), cloud_size_(cloud_size),
          known_(label.size(), Known::nothing) {}

    bool knows(Index vertex) const { return known_[vertex] != Known::nothing; }

    // Its patch, with a falloff of 0 if it is large. The vertex is not known yet.
    SmallPatch from(Index start) {
        SmallPatch patch;
        patch.handle = label_[start];
        HeldExtent extent;
        bool is_small = true;
        meet(start, patch);
        for (std::size_t next = 0; is_small && next < patch.vertices.size(); ++next) {
            const Vec3d way = point_at(positions_, patch.vertices[next]) - point_at(positions_, start);
            extent.add(way);
            patch.reach = std::max(patch.reach, way.norm());
            is_small = extent.radius() <= surely_large * small_handle * cloud_size_ &&
                       meet_neighbors(patch.vertices[next], patch);
        }
        patch.radius = extent.radius();
        patch.falloff = is_small ? least_falloff(extent, cloud_size_) : 0;
        if (patch.falloff == 0)
            for (const Index v : patch.vertices) known_[v] = Known::large;
        return patch;
    }

private:
    void meet(Index vertex, SmallPatch& patch) {
        known_[vertex] = Known::met;
        patch.vertices.push_back(vertex);
    }

    // False once one of them belongs to a large patch.
    bool meet_neighbors(Index vertex, SmallPatch& patch) {
        const auto meet_one = [&](Index other) {
            if (label_[other] != patch.handle) return true;
            if (known_[other] == Known::nothing) meet(other, patch);
            return known_[other] != Known::large;
        };
        for (const Index near : graph_.row(vertex)) {
            if (!meet_one(near)) return false;
            if (label_[near] == no_index && !std::ranges::all_of(graph_.row(near), meet_one)) return false;
        }
        return true;
    }

    std::span<const Index> label_;
    const Graph& graph_;
    std::span<const float> positions_;
    double cloud_size_;
    std::vector<Known> known_;
};

// What the search of a handle's vicinity starts from: its small patches, and what is near enough of the
// borders of others.
struct Sources {
    std::vector<Index> vertices;
    std::unordered_map<Index, Index> patch; // of those of small ones
    std::vector<Index> patches;             // all of these
    double limit = 0;
};

std::vector<Sources> sources_of(std::size_t handles, std::span<const SmallPatch> patches,
                                std::span<const HeldBlock> blocks, std::span<const float> positions) {
    std::vector<Sources> sources(handles);
    for (Index p = 0; p < patches.size(); ++p) {
        Sources& of_handle = sources[patches[p].handle];
        for (const Index v : patches[p].vertices) {
            of_handle.vertices.push_back(v);
            of_handle.patch.emplace(v, p);
        }
        of_handle.patches.push_back(p);
        of_handle.limit = std::max(of_handle.limit, patches[p].falloff);
    }
    const auto is_near = [&](Index vertex, const SmallPatch& patch) {
        const Vec3d way = point_at(positions, vertex) - point_at(positions, patch.vertices.front());
        return way.norm() < patch.reach + 2 * patch.falloff;
    };
    for (const HeldBlock& block : blocks)
        for (const BorderVertex& border : block.borders) {
            if (border.label >= handles || sources[border.label].limit == 0) continue;
            Sources& of_handle = sources[border.label];
            if (!of_handle.patch.contains(border.vertex) &&
                std::ranges::any_of(of_handle.patches,
                                    [&](Index p) { return is_near(border.vertex, patches[p]); }))
                of_handle.vertices.push_back(border.vertex);
        }
    return sources;
}

// Vertices, which come along a curve, may be taken one of so many.
std::size_t stride_of(std::size_t vertices, std::size_t handles) {
    const double around = part_around * static_cast<double>(vertices);
    return 1 + static_cast<std::size_t>(std::max(around / enough_around_one,
                                                 around * static_cast<double>(handles) / enough_around_all));
}

} // namespace

double least_falloff(const HeldExtent& held, double cloud_size) {
    return largest_small_falloff * std::max(0.0, cloud_size - held.radius() / small_handle);
}

std::vector<SmallPatch> small_patches(std::size_t handles, std::span<const Index> label,
                                      std::span<const HeldBlock> blocks, const Graph& graph,
                                      std::span<const float> positions, double cloud_size) {
    PatchSearch search(label, graph, positions, cloud_size);
    std::vector<SmallPatch> patches;
    for (const HeldBlock& block : blocks)
        for (const BorderVertex& border : block.borders) {
            if (border.label >= handles || search.knows(border.vertex)) continue;
            SmallPatch patch = search.from(border.vertex);
            if (patch.falloff > 0) patches.push_back(std::move(patch));
        }
    return patches;
}

Vicinities vicinities(std::size_t handles, std::span<const SmallPatch> patches,
                      std::span<const Index> samples, std::span<const Index> label,
                      std::span<const HeldBlock> blocks, const Graph& graph, std::span<const float> positions,
                      Workers& workers, Progress& progress) {
    Vicinities result(handles);
    if (patches.empty()) return result;
    const std::vector<Sources> sources = sources_of(handles, patches, blocks, positions);
    std::vector<Index> ascending(samples.begin(), samples.end());
    std::ranges::sort(ascending);
    const auto searched = std::ranges::count_if(sources, [](const Sources& from) { return from.limit > 0; });
    const std::size_t stride = stride_of(label.size(), static_cast<std::size_t>(searched));
    const auto search = [&](std::size_t handle) {
        const Sources& from = sources[handle];
        if (from.limit == 0) return;
        for (const Reached& near : reached_within(graph, positions, from.vertices, from.limit)) {
            const auto patch = from.patch.find(near.source);
            if (label[near.vertex] != no_index || patch == from.patch.end() ||
                near.distance >= patches[patch->second].falloff)
                continue;
            const bool is_sample = std::ranges::binary_search(ascending, near.vertex);
            if (is_sample || near.vertex % stride == 0)
                result[handle].push_back({near.vertex, near.source, patch->second, near.distance, is_sample});
        }
    };
    for (std::size_t first = 0; first < handles; first += handles_at_once) {
        progress.step("finding what is around small handles",
                      static_cast<double>(first) / static_cast<double>(handles));
        workers.for_each(std::min(handles_at_once, handles - first), 1,
                         [&](std::size_t k) { search(first + k); });
    }
    return result;
}

} // namespace knead
