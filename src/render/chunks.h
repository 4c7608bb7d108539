#pragma once
// Private to this room: ranges of consecutive points and the boxes around them, so that what lies outside the
// view is skipped without looking at its points.

#include "base/point_range.h"
#include "base/types.h"
#include "base/workers.h"
#include "view/camera.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace knead {

inline constexpr std::size_t points_in_chunk = 1024;

// The boxes of points 0 … 1023, 1024 … 2047 and so on; of finite points only. A chunk without any has lowest
// > highest.
struct Chunk {
    glm::vec3 lowest{1.0f}, highest{-1.0f};
    bool empty() const { return !(lowest.x <= highest.x); }
};
// Bounds the chunks with these numbers; `chunks` has chunks_of() entries, and the others stay as they are.
void bound_chunks(std::span<const float> positions, std::span<const Index> numbers,
                  std::vector<Chunk>& chunks, Workers& workers);

// All chunks, from the boxes of every `points_in_box` points, of which a whole number make a chunk: lowest x,
// y, z and highest x, y, z, lowest > highest where there are no finite ones.
void join_boxes(std::span<const std::array<float, 6>> boxes, std::size_t points_in_box,
                std::vector<Chunk>& chunks);

constexpr std::size_t chunks_of(std::size_t points) {
    return (points + points_in_chunk - 1) / points_in_chunk;
}

// The numbers of the chunks that these points lie in, ascending, each once. The ranges ascend.
void chunks_with(std::span<const PointRange> points, std::vector<Index>& numbers);

// The box around all of them; the unit box where all are empty.
Box3 box_around(std::span<const Chunk> chunks);

struct InView {
    std::vector<PointRange> ranges; // a chunk each, the nearest first: what is hidden then costs less
    std::size_t points = 0;
    Box3 box;           // around their chunks
    double nearest = 0; // smallest w of clip space of their boxes' corners; at least a tiny positive number
    glm::dvec2 lowest{-1.0},
        highest{1.0}; // of clip space's -1 … 1: nothing of them reaches beyond, but splats
};
// The chunks that reach into clip space. `margin` (of clip space's half width) keeps points whose splat
// reaches in.
InView chunks_in_view(std::span<const Chunk> chunks, std::size_t points, const glm::dmat4& to_clip,
                      double margin);

} // namespace knead
