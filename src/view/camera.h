#pragma once
// The camera: where the artist looks from, how a drag of the mouse turns it, and the way between points and
// pixels.
//
// Everything is in the cloud's units relative to its origin; the world's z axis points up, or for clouds that
// were made so, its y axis, or that axis points down. Pixels are those of the framebuffer, x to the right and
// y downwards from the upper left corner, pixel centres at halves.

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <optional>

namespace knead {

struct Viewport {
    int width = 1, height = 1; // pixels, ≥ 1

    bool operator==(const Viewport&) const = default;
};

enum class Orbiting {
    turntable, // about the world's upward axis and the screen's horizontal one: the horizon stays level
    trackball  // about the screen's two axes
};

// Which of the world's axes points upwards. With z up, x points to the right and y to the back; with y up z
// to the front; with y down, as depth cameras and photogrammetry have it, z to the back.
enum class UpAxis { z, y, minus_y };

// How high a place is: along which coordinate, and in which sense.
struct Upward {
    glm::length_t axis;
    int sign; // 1 or -1
};
constexpr Upward upward(UpAxis up) {
    return {up == UpAxis::z ? 2 : 1, up == UpAxis::minus_y ? -1 : 1};
}

// The eye stands at pivot + orientation · (offset, distance) and looks along -z of `orientation`, whose y is
// up on the screen. Take eye_of() rather than this formula.
struct Camera {
    glm::dvec3 pivot{0.0};              // what it turns about
    double distance = 1.0;              // from eye to pivot, > 0
    glm::dquat orientation{1, 0, 0, 0}; // camera's axes to the world's
    double field_of_view = 0.6;         // vertical, radians
    bool orthographic = false;          // then the height seen is that at the pivot
    glm::dvec2 offset{0.0};             // of the eye in the screen's plane: a pivot need not be its middle
    UpAxis up = UpAxis::z;              // of the turntable and of the sides

    bool operator==(const Camera&) const = default;
};

struct Box3 {
    glm::dvec3 lowest{0.0}, highest{0.0};
};

enum class Side { front, back, right, left, top, bottom };

// --- Moving the camera ---

// Turns about the pivot: a drag across the height of the viewport is a half turn. What faces the hand follows
// it. The turntable levels the horizon and stops when it looks straight up or down.
void orbit(Camera& camera, Orbiting style, glm::dvec2 drag_pixels, Viewport viewport);
// Shifts the pivot in the plane of the screen, so that what lies at the pivot's depth stays under the cursor.
void pan(Camera& camera, glm::dvec2 drag_pixels, Viewport viewport);
// Goes nearer (steps > 0) or away, a tenth a step, keeping what is under the cursor at the pivot's depth
// there.
void zoom(Camera& camera, double steps, glm::dvec2 cursor, Viewport viewport);
// Looks straight at that side about the same pivot: from the front, world x points to the right and the
// camera's up axis up; from above, the back is up.
void look_at_side(Camera& camera, Side side);
// Keeps the direction, and takes pivot and distance so that the box fills the viewport with a small margin. A
// box without size keeps the distance; one that is not finite changes nothing.
void frame(Camera& camera, const Box3& box, Viewport viewport);
// A pleasant first view of a cloud of unknown front: from above the front right.
Camera first_view(const Box3& box, Viewport viewport, UpAxis up = UpAxis::z);
// Takes another axis for the upward one, and looks from the same side as before with respect to it, level,
// about the same pivot.
void set_up(Camera& camera, UpAxis up);
// Makes a point the pivot without moving what is seen (the point lies in front of the eye; one that does not
// comes to the middle of the screen).
void set_pivot(Camera& camera, const glm::dvec3& point);

// --- Between points and pixels ---

glm::dvec3 eye_of(const Camera& camera);
glm::dmat4 view_matrix(const Camera& camera); // world to camera
// OpenGL's clip space; near and far planes enclose what of the box is in front of the eye. With the eye in
// the box, what is nearer than a thousandth of its depth may be cut off, less when the pivot is near.
glm::dmat4 projection_matrix(const Camera& camera, Viewport viewport, const Box3& box);

struct Ray {
    glm::dvec3 origin{0.0}, direction{0.0, 0.0, -1.0}; // unit
};
Ray ray_through(const Camera& camera, Viewport viewport, glm::dvec2 pixel);

struct Projected {
    glm::dvec2 pixel{0.0};
    double depth = 0; // along the viewing direction from the eye, > 0 unless orthographic
};
// Nothing for a point at or behind the eye (never in an orthographic view).
std::optional<Projected> project(const Camera& camera, Viewport viewport, const glm::dvec3& point);

// The length that one pixel spans at the point's depth.
double pixel_size_at(const Camera& camera, Viewport viewport, const glm::dvec3& point);

} // namespace knead
