#pragma once
// Private to this room: who keeps the points and draws them as splats, on a graphics card or by the
// processor.

#include "render/chunks.h"
#include "render/point_renderer.h"
#include "render/screen_pass.h"
#include "render/software_lines.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>

namespace knead {

// How splats are sized and lit.
struct SplatView {
    Viewport viewport;
    glm::mat4 to_clip{1.0f};
    float fixed = 0, by_distance = 0; // diameter in pixels: fixed + by_distance / w
    // That is of a subset's splats, which grew: to so many pixels, and beyond keep only a part of it.
    float grown_to = 0, grown = 1;
    float smallest = 1, largest = 64; // pixels
    float widest = 64;                // no splat in view is wider
    float pixel_size = 0;             // the length of a pixel at w = 1
    glm::vec2 half_field{0};          // half the view's width and height at w = 1; 0: orthographic
    glm::vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1}; // the camera's axes
    glm::vec3 key{0, 0, 1};                                   // towards the light
    bool shaded = false;                                      // by the normals, along which splats lie
};

// The diameter of a splat, from what it would be with all its growth.
inline float diameter_of(const SplatView& view, float full) {
    return std::clamp(std::min(full, std::max(view.grown_to, view.grown * full)), view.smallest,
                      view.largest);
}

// A splat of up to three pixels is a square, which covers the pixels of a disc for less. A wider one is a
// disc in the surface, seen as an ellipse, and bulges a little. With t the place on the screen from its
// middle, in radii to the right and upwards, and s how steeply the surface falls away there, the rim is where
// r² = t² + ½(s·t)² is 1, and a place of the disc lies bulge · (r² + tilt s·t) behind the middle. (Without
// the half it would be a circle in the surface, which leaves holes where points are few.) The bulge parts
// overlapping splats between their middles; a ball's would look like scales.
inline constexpr float widest_square = 3; // pixels
inline constexpr float bulge_over_diameter = 0.16F, tilt_over_bulge = 0.5F / bulge_over_diameter;
// Steeper ones are drawn as if they were not: normals are not that exact.
inline constexpr float steepest = 3;
// Their rim lies so many radii behind the middle: s·t = 3/√5.5, and the bulge.
inline constexpr double rim_depth = 1.6;

// s of a splat at this place of clip space, -1 … 1.
inline glm::vec2 slope_of(const SplatView& view, const glm::vec3& normal, float x, float y) {
    const glm::vec2 across(glm::dot(normal, view.right), glm::dot(normal, view.up));
    const float along = glm::dot(normal, view.forward) + view.half_field.x * x * across.x +
                        view.half_field.y * y * across.y; // the ray to the splat
    const float least = std::max(glm::length(across) / steepest, 1e-6F);
    return across / (along > 0 ? -std::max(along, least) : std::max(-along, least));
}

// Lines over the points.
struct Overlay {
    std::span<const OverlayLine> lines;
    LineView view;
};

inline constexpr double widths_in_double = 64;

class Splats {
public:
    virtual ~Splats() = default;

    virtual void set_points(std::size_t n) = 0; // the rest comes before draw()
    // All of them, of which these chunks differ from those before; the first time all chunks. The caller's,
    // and good until the next ones come.
    virtual void set_positions(std::span<const float> positions, std::span<const Index> chunks) = 0;
    virtual void set_normals(std::span<const float> normals, std::span<const Index> chunks) = 0; // not empty
    // That these are drawn from, whose contents others may write; 0 where the processor draws, and for
    // normals where there are none.
    virtual PointRenderer::DrawnBuffers buffers() { return {}; }
    // Splats by distance are 2^(w / widths_in_double) as wide as the view says; empty: all 0.
    virtual void set_widths(std::span<const std::uint8_t> widths) = 0;
    virtual void set_tinted(std::span<const std::uint32_t> tinted) = 0;

    // Draws one of `stride` subsets of these ranges, a chunk each, into the layer, over what is there, or
    // first clears it. Every subset is spread evenly, and together they are all points. Returns how many.
    virtual std::size_t draw(std::span<const PointRange> ranges, std::size_t subset, std::size_t stride,
                             const SplatView& view, Layer& layer, bool clear) = 0;

    // Makes the picture of what was drawn into `shown`, with the overlay. `is_new`: anything changed since
    // the last call.
    virtual void finish(const ScreenPass& pass, const Overlay& overlay, Layer& shown, bool is_new,
                        Layer& finished) = 0;

    // Whether the processor draws. Its finished pictures have their first row at the top, and of another
    // overlay it has to draw the points again.
    virtual bool by_processor() const { return false; }
};

std::unique_ptr<Splats> make_gl_splats();

// Mesa's software renderer takes half a microsecond and more for every point, of which a small splat needs a
// few nanoseconds. Where OpenGL runs in software the processor draws the whole picture itself, and OpenGL
// only gets the finished one. One layer is drawn into at a time.
std::unique_ptr<Splats> make_software_splats(Workers& workers);

// The elements of a range in a strided array: element e is point subset + e · stride.
struct Elements {
    std::size_t first = 0, end = 0;
};
inline Elements elements_of(const PointRange& range, std::size_t subset, std::size_t stride) {
    const auto element = [&](std::size_t point) {
        return point <= subset ? 0 : (point - subset + stride - 1) / stride;
    };
    return {element(range.first), element(range.end)};
}

} // namespace knead
