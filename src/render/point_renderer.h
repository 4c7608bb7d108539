#pragma once
// Draws a cloud of points, and lines over it, with OpenGL 4.1 core: the same passes for the window and for
// pictures without one.
//
// Points are round splats that close the surface. They are drawn into a colour and a depth texture; one pass
// over the screen then adds eye-dome lighting (Boucheny 2009: how much a pixel lies below its neighbours
// darkens it), the patterns of the handles and the background; overlay lines come last, and the finished
// picture is copied into the caller's framebuffer.
//
// Points must come in an order that keeps neighbours together (the pipeline's Morton order). Then one in k of
// them, evenly spread along it, is a subset of the surface, with larger splats, which is what is drawn where
// the whole cloud would take too long; and ranges of points that lie outside the view are skipped.

#include "base/point_range.h"
#include "view/camera.h"
#include "view/marks.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace knead {

// How points look.
struct PointLook {
    bool size_by_distance = true; // splats as large as the points are far apart; else all of `pixels`
    float scale = 1;              // by distance: times the size that just closes the surface
    float pixels = 3;             // fixed: the diameter
    bool eye_dome = true;
    bool shading = true; // with the normals, where there are any
    glm::vec3 background_top{0.235f, 0.251f, 0.280f};
    glm::vec3 background_bottom{0.110f, 0.116f, 0.130f};
    float pixel_scale = 1; // of the display: all that is told in pixels is that much larger

    bool operator==(const PointLook&) const = default;
};

// How the points of a handle look: tinted, and told apart by more than colour.
struct HandleLook {
    enum class Pattern { solid, stripes, dots, stripes_and_dots };
    glm::vec3 color{1.0f};
    Pattern pattern = Pattern::solid;
    // Of the colour in the points' own. As it is, enough to tell handles apart, and little enough to see the
    // file's colours through it; 0 leaves colours that tell a value what they are.
    float share = 0.42f;
    bool operator==(const HandleLook&) const = default;
};

// Lines and points over the cloud, hidden where the cloud is nearer. `rgba`: bytes r, g, b, a in memory.
struct OverlayLine {
    glm::vec3 from{0.0f}, to{0.0f}; // equal: a round point
    std::uint32_t rgba = 0xffffffff;
    float width = 1; // pixels
};

// Where a picture goes: a framebuffer (0: the window's), and a rectangle of it in pixels from its lower left.
struct PictureTarget {
    PictureTarget(unsigned framebuffer_) : framebuffer(framebuffer_) {}
    unsigned framebuffer;
    int left = 0, bottom = 0;
    Viewport size{0, 0}; // 0: as large as the picture
};

struct DrawResult {
    bool complete = false;   // all points are there; else draw again, and more of them will be
    std::size_t in_view = 0; // points that are not skipped for lying outside the view
    std::size_t drawn = 0;   // points drawn by this call
    std::size_t one_in = 1;  // the picture shows one point in so many
    double seconds = 0;      // what this call's points took; where OpenGL draws them, only to list them
};

// Owns its OpenGL objects. Make, use and destroy it with one context current. Positions are relative to the
// cloud's origin, as everything in view/camera.h.
class PointRenderer {
public:
    // Who draws the picture. Chosen: the processor where OpenGL runs in software, which would take ten times
    // as long; OpenGL then only shows it.
    enum class Drawing { chosen, by_opengl, by_processor };

    // Throws Error (usage) where OpenGL is older than 4.1, with its name and version.
    explicit PointRenderer(Drawing drawing = Drawing::chosen);
    ~PointRenderer();
    PointRenderer(const PointRenderer&) = delete;
    PointRenderer& operator=(const PointRenderer&) = delete;

    bool is_software() const; // the processor draws the splats

    // Begins anew with n points, all grey, unmarked and at the origin. `spacing`: the usual distance of
    // neighbouring points (usual_spacing() in view/framing.h).
    void set_points(std::size_t n, double spacing);
    std::size_t points() const;

    // While something is dragged, positions and normals come every frame, and few of them may be drawn. So
    // they are the caller's, and must stay as they are until others are set, or points, or nothing is drawn
    // any more. Points that are not finite are not drawn.
    void set_positions(std::span<const float> positions); // 3n
    void set_normals(std::span<const float> normals);     // 3n, unit; or empty: none
    // The same of positions and normals that differ from those before in these ranges only, which ascend: no
    // more is looked at.
    void set_positions(std::span<const float> positions, std::span<const PointRange> changed);
    void set_normals(std::span<const float> normals, std::span<const PointRange> changed);
    // For whoever writes positions, and normals, where they are drawn from: OpenGL's names of the buffers, of
    // 3n floats each, which OpenGL is done with. 0 where there are none: before set_positions() or
    // set_normals(), and where the processor draws. What was written is told by boxes around it, lowest x, y,
    // z and highest x, y, z, of every `points_in_box` (a power of two up to 1024) points.
    struct DrawnBuffers {
        unsigned positions = 0, normals = 0;
    };
    DrawnBuffers buffers_to_write();
    void note_written(std::span<const std::array<float, 6>> boxes, std::size_t points_in_box);
    // These are copied, n entries each.
    void set_colors(std::span<const std::uint32_t> rgba); // bytes r, g, b, ignored
    // How far apart the points lie around each, in the same unit as `spacing`, which is the least that
    // counts: splats are so much wider. Or empty: all alike.
    void set_spacings(std::span<const float> spacings);
    void set_marks(std::span<const std::uint8_t> marks); // view/marks.h; or empty: none
    void set_handle_looks(std::span<const HandleLook> looks);
    void set_overlay(std::span<const OverlayLine> lines);

    // Draws at most about `budget` points of a picture of the viewport's size, and copies it to the target.
    // If nothing changed since the last call it goes on with the points that are still missing, behind the
    // picture as it is, and shows them when all are there; once complete a call copies the finished picture
    // and costs next to nothing.
    //
    // The near and far planes enclose the points and the overlay. Leaves the target bound, and depth test,
    // blending and scissor off.
    DrawResult draw(const Camera& camera, Viewport viewport, const PointLook& look, std::size_t budget,
                    const PictureTarget& target);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace knead
