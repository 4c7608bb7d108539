#pragma once
// From points to pixels, many at a time. project() in view/camera.h takes the same steps, so that all of this
// room agrees to the last bit on where a point is seen.

#include "view/camera.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace knead {

struct Projector {
    Projector(const Camera& camera, Viewport viewport);

    struct Seen {
        double x, y;  // pixel; anything where the depth is no good
        double depth; // along the viewing direction
    };
    Seen operator()(double x, double y, double z) const {
        const double dx = x - eye.x;
        const double dy = y - eye.y;
        const double dz = z - eye.z;
        const double depth = -(back.x * dx + back.y * dy + back.z * dz);
        const double scale = focal / (orthographic ? reference : depth);
        return {half_width + (right.x * dx + right.y * dy + right.z * dz) * scale,
                half_height - (up.x * dx + up.y * dy + up.z * dz) * scale, depth};
    }
    Seen operator()(const glm::dvec3& point) const { return (*this)(point.x, point.y, point.z); }
    Seen operator()(const float* point) const {
        return (*this)(double{point[0]}, double{point[1]}, double{point[2]});
    }
    // Whether a depth is in front of the eye, and not in it; never for a point that is not finite.
    bool in_front(double depth) const { return orthographic ? depth - depth == 0 : depth > nearest; }
    // The length that one pixel spans at that depth.
    double pixel_size(double depth) const { return (orthographic ? reference : depth) / focal; }

    glm::dvec3 eye, right, up, back; // the camera's axes in the world
    double focal;                    // pixels
    double reference;                // the distance whose scale an orthographic view has everywhere
    double half_width, half_height;
    double nearest; // what is nearer to the eye has no pixel
    bool orthographic;
};

// Calls visit(i, seen) for the points begin … end of 3n floats. A block is projected before any of it is
// visited: loops that write bytes, which might be anybody's, would otherwise not be vectorised.
template<typename Visit>
void project_each(Projector projector, const float* positions, std::size_t begin, std::size_t end,
                  Visit&& visit) {
    constexpr std::size_t block = 256;
    std::array<double, block> x;
    std::array<double, block> y;
    std::array<double, block> depth;
    for (; begin < end; begin += block) {
        const std::size_t count = std::min(block, end - begin);
        for (std::size_t k = 0; k < count; ++k) {
            const Projector::Seen seen = projector(positions + 3 * (begin + k));
            x[k] = seen.x;
            y[k] = seen.y;
            depth[k] = seen.depth;
        }
        for (std::size_t k = 0; k < count; ++k) visit(begin + k, Projector::Seen{x[k], y[k], depth[k]});
    }
}

} // namespace knead
