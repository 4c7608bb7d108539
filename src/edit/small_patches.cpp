#include "edit/small_patches.h"

#include "graph/distances.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numbers>
#include <unordered_map>

namespace knead {

namespace {

constexpr double small_handle = 0.03; // of the cloud's size: the radius of what needs no falloff

// What has been looked at and is so many times as large is not looked at any further.
constexpr double surely_large = 1.25;

// Nor is what is long, once it holds more than this part of the cloud.
constexpr double most_of_long = 0.03;

// Of the vertices of a surface about so many lie within the largest falloff of a point. So many of them are
// enough around each handle, and around all.
constexpr double part_around = 0.03;
constexpr double enough_around_one = 4096, enough_around_all = 1 << 18;

// Handles are searched round so many at a time, and in between it is asked whether to go on.
constexpr std::size_t handles_at_once = 16;

enum class Known : std::uint8_t { nothing, met, large };

// How large a patch is, from its vertices as they are met.
class PatchShape {
public:
    PatchShape(const Graph& graph, std::span<const float> positions) : graph_(graph), positions_(positions) {}

    // `way`: there from the first one; `holes`: how much of the free vertices beside it lies among the
    // patch's own; `leaving`: which part of its links goes to others.
    void add(const Vec3d& way, Index vertex, double holes, double leaving) {
        extent_.add(way);
        inside_ += 1 + holes;
        leaving_ += leaving;
        if (leaving == 0) return;
        double length = 0;
        for (const Index near : graph_.row(vertex))
            length += (point_at(positions_, near) - point_at(positions_, vertex)).norm();
        lengths_ += length / static_cast<double>(graph_.row(vertex).size());
        ++borders_;
    }

    std::size_t count() const { return extent_.count; }
    double radius() const { return extent_.radius(); }
    // 2 · area / length of the border: of a disc its radius, of what is long how wide it is. With ρ vertices
    // an area, all linked to those within r, these have k = π ρ r² links of 2/3 r in the mean, and 2/3 ρ² r³
    // cross a border's unit of length; for the ratio, 2/π · mean length · vertices / Σ parts that leave,
    // ρ and k need not be known. From the first vertex across to the last it is a link less: of a line
    // nothing.
    double width() const {
        if (leaving_ == 0) return std::numeric_limits<double>::infinity();
        return lengths_ / borders_ * std::max(0.0, 2 / std::numbers::pi * inside_ / leaving_ - 1);
    }

private:
    const Graph& graph_;
    std::span<const float> positions_;
    HeldExtent extent_;
    double inside_ = 0; // vertices
    double leaving_ = 0;
    double lengths_ = 0, borders_ = 0; // the mean ones of the links of vertices with some that leave
};

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
        PatchShape shape(graph_, positions_);
        bool is_small = true;
        meet(start, patch);
        for (std::size_t next = 0; is_small && next < patch.vertices.size(); ++next) {
            const Vec3d way = point_at(positions_, patch.vertices[next]) - point_at(positions_, start);
            patch.reach = std::max(patch.reach, way.norm());
            is_small = look_around(patch.vertices[next], way, patch, shape) && !is_large(shape);
        }
        patch.radius = std::min(shape.radius(), shape.width());
        patch.falloff = is_small ? least_falloff(patch.radius, cloud_size_) : 0;
        if (patch.falloff == 0)
            for (const Index v : patch.vertices) known_[v] = Known::large;
        return patch;
    }

private:
    void meet(Index vertex, SmallPatch& patch) {
        known_[vertex] = Known::met;
        patch.vertices.push_back(vertex);
    }

    bool is_large(const PatchShape& shape) const {
        const double enough = surely_large * small_handle * cloud_size_;
        return shape.radius() > enough &&
               (shape.width() > enough ||
                static_cast<double>(shape.count()) > most_of_long * static_cast<double>(label_.size()));
    }

    // Meets what hangs together with a vertex. False once one of them belongs to a large patch.
    bool look_around(Index vertex, const Vec3d& way, SmallPatch& patch, PatchShape& shape) {
        double holes = 0, leaving = 0;
        for (const Index near : graph_.row(vertex)) {
            if (!meet_one(near, patch)) return false;
            if (label_[near] != no_index) continue;
            std::size_t own = 0;
            for (const Index beyond : graph_.row(near)) {
                if (!meet_one(beyond, patch)) return false;
                own += label_[beyond] == patch.handle ? 1 : 0;
            }
            const bool is_hole = 2 * own > graph_.row(near).size();
            if (is_hole)
                holes += 1 / static_cast<double>(own); // so many vertices tell of it
            else
                ++leaving;
        }
        shape.add(way, vertex, holes, leaving / static_cast<double>(graph_.row(vertex).size()));
        return true;
    }

    bool meet_one(Index vertex, SmallPatch& patch) {
        if (label_[vertex] != patch.handle) return true;
        if (known_[vertex] == Known::nothing) meet(vertex, patch);
        return known_[vertex] != Known::large;
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

double least_falloff(double radius, double cloud_size) {
    return largest_small_falloff * std::max(0.0, cloud_size - radius / small_handle);
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
