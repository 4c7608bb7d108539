#include "render/chunks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace knead {

namespace {

constexpr float huge = std::numeric_limits<float>::max();

// The box of the finite ones among some points.
Chunk box_of(std::span<const float> positions) {
    glm::vec3 lowest(huge), highest(-huge);
    for (std::size_t i = 0; i < positions.size(); i += 3) {
        const glm::vec3 p(positions[i], positions[i + 1], positions[i + 2]);
        // A difference with itself is 0 for finite numbers only.
        if (!(p.x - p.x + (p.y - p.y) + (p.z - p.z) == 0.0f)) continue;
        lowest = glm::min(lowest, p);
        highest = glm::max(highest, p);
    }
    return {lowest, highest};
}

// Loops that a compiler makes vectors of: while something is dragged this is done for every frame.
constexpr std::size_t at_once = 24; // numbers: eight points

bool all_finite(std::span<const float> numbers) {
    std::array<float, at_once> sums{};
    std::size_t i = 0;
    for (; i + at_once <= numbers.size(); i += at_once)
        for (std::size_t k = 0; k < at_once; ++k) sums[k] += numbers[i + k] - numbers[i + k];
    for (; i < numbers.size(); ++i) sums[0] += numbers[i] - numbers[i];
    return std::ranges::all_of(sums, [](float sum) { return sum == 0.0f; });
}

Chunk box_of_finite(std::span<const float> positions) {
    std::array<float, at_once> low, high;
    low.fill(huge);
    high.fill(-huge);
    const std::size_t whole = positions.size() / at_once * at_once;
    for (std::size_t i = 0; i < whole; i += at_once) {
        for (std::size_t k = 0; k < at_once; ++k) {
            low[k] = positions[i + k] < low[k] ? positions[i + k] : low[k];
            high[k] = positions[i + k] > high[k] ? positions[i + k] : high[k];
        }
    }
    Chunk box = box_of(positions.subspan(whole));
    for (std::size_t k = 0; k < at_once; k += 3) {
        box.lowest = glm::min(box.lowest, glm::vec3(low[k], low[k + 1], low[k + 2]));
        box.highest = glm::max(box.highest, glm::vec3(high[k], high[k + 1], high[k + 2]));
    }
    return box;
}

} // namespace

void bound_chunks(std::span<const float> positions, std::span<const Index> numbers,
                  std::vector<Chunk>& chunks, Workers& workers) {
    const std::size_t points = positions.size() / 3;
    workers.for_each(numbers.size(), 16, [&](std::size_t at) {
        const std::size_t c = numbers[at];
        const std::size_t first = c * points_in_chunk, end = std::min(points, first + points_in_chunk);
        const std::span<const float> own = positions.subspan(3 * first, 3 * (end - first));
        chunks[c] = all_finite(own) ? box_of_finite(own) : box_of(own);
    });
}

void join_boxes(std::span<const std::array<float, 6>> boxes, std::size_t points_in_box,
                std::vector<Chunk>& chunks) {
    const std::size_t in_chunk = points_in_chunk / points_in_box;
    for (Chunk& chunk : chunks) chunk = {glm::vec3(huge), glm::vec3(-huge)};
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        Chunk& chunk = chunks[i / in_chunk];
        chunk.lowest = glm::min(chunk.lowest, glm::vec3(boxes[i][0], boxes[i][1], boxes[i][2]));
        chunk.highest = glm::max(chunk.highest, glm::vec3(boxes[i][3], boxes[i][4], boxes[i][5]));
    }
}

void chunks_with(std::span<const PointRange> points, std::vector<Index>& numbers) {
    numbers.clear();
    for (const PointRange& range : points) {
        if (range.first == range.end) continue;
        auto chunk = static_cast<Index>(range.first / points_in_chunk);
        if (!numbers.empty() && chunk <= numbers.back()) chunk = numbers.back() + 1;
        for (; chunk < chunks_of(range.end); ++chunk) numbers.push_back(chunk);
    }
}

Box3 box_around(std::span<const Chunk> chunks) {
    Box3 box{glm::dvec3(std::numeric_limits<double>::max()),
             glm::dvec3(std::numeric_limits<double>::lowest())};
    for (const Chunk& chunk : chunks) {
        if (chunk.empty()) continue;
        box.lowest = glm::min(box.lowest, glm::dvec3(chunk.lowest));
        box.highest = glm::max(box.highest, glm::dvec3(chunk.highest));
    }
    return box.lowest.x <= box.highest.x ? box : Box3{glm::dvec3(-0.5), glm::dvec3(0.5)};
}

namespace {

// What a chunk's box takes of the screen.
struct Extent {
    glm::dvec2 lowest{std::numeric_limits<double>::max()}, highest{std::numeric_limits<double>::lowest()};
    double nearest = std::numeric_limits<double>::max(); // smallest w
    double nearest_depth = std::numeric_limits<double>::max();
    bool visible = false;
};

Extent extent_of(const Chunk& chunk, const glm::dmat4& to_clip, double margin) {
    Extent extent;
    int outside[5] = {}; // corners beyond the left, right, lower and upper plane, and behind the eye
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 p = to_clip * glm::dvec4(corner & 1 ? chunk.highest.x : chunk.lowest.x,
                                                  corner & 2 ? chunk.highest.y : chunk.lowest.y,
                                                  corner & 4 ? chunk.highest.z : chunk.lowest.z, 1.0);
        const double reach = (1.0 + margin) * p.w;
        outside[0] += p.x < -reach;
        outside[1] += p.x > reach;
        outside[2] += p.y < -reach;
        outside[3] += p.y > reach;
        outside[4] += p.z < -p.w;
        extent.nearest = std::min(extent.nearest, p.w);
        extent.nearest_depth = std::min(extent.nearest_depth, p.z);
        const glm::dvec2 seen = p.w > 0 ? glm::dvec2(p) / p.w : glm::dvec2(0);
        extent.lowest = glm::min(extent.lowest, seen);
        extent.highest = glm::max(extent.highest, seen);
    }
    if (extent.nearest <= 0) { // a corner lies behind the eye: it may be anywhere
        extent.lowest = glm::dvec2(-1);
        extent.highest = glm::dvec2(1);
    }
    extent.visible = std::ranges::find(outside, 8) == std::end(outside);
    return extent;
}

} // namespace

InView chunks_in_view(std::span<const Chunk> chunks, std::size_t points, const glm::dmat4& to_clip,
                      double margin) {
    InView result;
    Extent all;
    std::vector<std::pair<double, PointRange>> found;
    std::vector<Chunk> seen;
    for (std::size_t c = 0; c < chunks.size(); ++c) {
        if (chunks[c].empty()) continue;
        const Extent extent = extent_of(chunks[c], to_clip, margin);
        if (!extent.visible) continue;
        all.lowest = glm::min(all.lowest, extent.lowest);
        all.highest = glm::max(all.highest, extent.highest);
        all.nearest = std::min(all.nearest, extent.nearest);
        const std::size_t first = c * points_in_chunk, end = std::min(points, first + points_in_chunk);
        found.push_back({extent.nearest_depth, {first, end}});
        seen.push_back(chunks[c]);
        result.points += end - first;
    }
    std::ranges::stable_sort(found, {}, [](const auto& chunk) { return chunk.first; });
    for (const auto& [depth, range] : found) result.ranges.push_back(range);
    result.box = box_around(seen);
    result.nearest = std::max(all.nearest, 1e-30);
    result.lowest = glm::clamp(all.lowest, -1.0, 1.0);
    result.highest = glm::clamp(all.highest, -1.0, 1.0);
    return result;
}

} // namespace knead
