#pragma once
// One look of the virtual scanner: where its rays go, and how far each of them went.

#include "base/workers.h"
#include "shapes/scanner.h"
#include "shapes/staged_loop.h"

#include <vector>

namespace knead {

// A pinhole camera that frames the body's box. A ray goes through eye + ahead + a·right + b·up.
struct View {
    Vec3d eye;
    Vec3d ahead; // unit, as the two others
    Vec3d right;
    Vec3d up;
    double left = 0;  // of the frame, in a
    double top = 0;   // of the frame, in b
    double pixel = 1; // side of a pixel, in a and b
    std::size_t rows = 0;
    std::size_t columns = 0;
    double size = 0; // of the frame in a and b, times the square of the sharpness
};

// Sees the whole box; a pixel is `pixel` / sharpness wide.
View view_of(const ScannedBody& body, const Viewpoint& viewpoint, double pixel);

struct ScanRay {
    Vec3d eye;
    Vec3d direction; // its part along `ahead` is 1, so depths are measured along `ahead`

    Vec3d at(double depth) const { return eye + depth * direction; }
};

// A ray goes anywhere through the inner half of its pixel's width and height.
ScanRay ray_of(const View& view, std::uint64_t seed, std::size_t row, std::size_t column);

struct DepthImage {
    View view;
    std::uint64_t seed = 1; // of everything random in this look
    // A ray's depth: 0 where it missed the body, negative where its return got lost (grazing, or thinned
    // out).
    std::vector<float> depths; // row after row from the top

    float at(std::size_t row, std::size_t column) const { return depths[row * view.columns + column]; }

    // The depth of the return beside (right, left, below, above), 0 where there is none.
    float neighbour_depth(std::size_t row, std::size_t column) const;
};

struct TraceOptions {
    std::uint64_t seed = 1;
    double gradient = 1; // as in ScanOptions
};

DepthImage trace_image(const ScannedBody& body, const View& view, const TraceOptions& options,
                       const StagePart& part, Workers& workers, Progress& progress);

} // namespace knead
