#include "view/camera.h"

#include "view/projector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace knead {

namespace {

constexpr double pi = std::numbers::pi;

// No cloud is so small or so large that the eye would be nearer or farther from what it looks at; beyond, the
// matrices would lose their digits.
constexpr double nearest_distance = 1e-12;
constexpr double farthest_distance = 1e12;
constexpr double margin = 0.9; // of the viewport that a framed box fills

glm::dquat turn(double angle, const glm::dvec3& axis) {
    return glm::angleAxis(angle, axis);
}

// The world with z upwards, to the one with that axis upwards.
glm::dquat upright(UpAxis up) {
    return up == UpAxis::z ? glm::dquat(1, 0, 0, 0) : turn(-upward(up).sign * pi / 2, {1, 0, 0});
}

// In a world with z upwards: turned by `azimuth` about the z axis from the front, and tipped up from looking
// straight down by `tip`: 0 looks down, π/2 ahead, π up.
glm::dquat level_orientation(double azimuth, double tip) {
    return turn(azimuth, {0, 0, 1}) * turn(tip, {1, 0, 0});
}

struct Level {
    double azimuth, tip;
};

// The nearest level view of the same direction. Straight up and down the azimuth is told by the screen's
// horizontal axis, which is why the view does not jump there.
Level level_of(const glm::dquat& orientation) {
    const glm::dvec3 right = orientation * glm::dvec3(1, 0, 0);
    const glm::dvec3 up = orientation * glm::dvec3(0, 1, 0);
    const glm::dvec3 back = orientation * glm::dvec3(0, 0, 1);
    const double sideways = std::hypot(back.x, back.y);
    const bool is_level = std::abs(right.z) < 1e-6 && up.z > -1e-6;
    const double azimuth =
        is_level || sideways < 1e-6 ? std::atan2(right.y, right.x) : std::atan2(back.x, -back.y);
    return {azimuth, std::atan2(sideways, back.z)};
}

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::array<glm::dvec3, 8> corners_of(const Box3& box) {
    std::array<glm::dvec3, 8> corners;
    for (unsigned i = 0; i < 8; ++i)
        corners[i] = {i & 1U ? box.highest.x : box.lowest.x, i & 2U ? box.highest.y : box.lowest.y,
                      i & 4U ? box.highest.z : box.lowest.z};
    return corners;
}

double height_over(Viewport viewport) {
    return std::max(1, viewport.height);
}

struct DepthRange {
    double nearest, farthest;
};

DepthRange depths_of(const Camera& camera, const Box3& box) {
    const glm::dvec3 eye = eye_of(camera);
    const glm::dvec3 back = camera.orientation * glm::dvec3(0, 0, 1);
    DepthRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const glm::dvec3& corner : corners_of(box)) {
        const double depth = -glm::dot(back, corner - eye);
        range.nearest = std::min(range.nearest, depth);
        range.farthest = std::max(range.farthest, depth);
    }
    return range;
}

// The planes of a perspective view. The depth buffer shares its digits out by the ratio of the two, so the
// near one is not drawn nearer than what the eye looks at asks for.
DepthRange perspective_planes(const Camera& camera, const Box3& box) {
    const DepthRange box_range = depths_of(camera, box);
    if (!(box_range.farthest > 0) || !std::isfinite(box_range.farthest))
        return {0.01 * camera.distance, 100 * camera.distance}; // nothing to be seen
    const double farthest = 1.001 * box_range.farthest;
    const double inside = std::max(1e-7 * farthest, std::min(1e-3 * farthest, 0.05 * camera.distance));
    return {std::max(0.999 * box_range.nearest, inside), farthest};
}

DepthRange orthographic_planes(const Camera& camera, const Box3& box) {
    DepthRange range = depths_of(camera, box);
    if (!std::isfinite(range.nearest) || !std::isfinite(range.farthest)) range = {0, 2 * camera.distance};
    const double room = 0.001 * (range.farthest - range.nearest) + 0.001 * camera.distance;
    return {range.nearest - room, range.farthest + room};
}

} // namespace

Projector::Projector(const Camera& camera, Viewport viewport)
    : eye(eye_of(camera)), right(camera.orientation * glm::dvec3(1, 0, 0)),
      up(camera.orientation * glm::dvec3(0, 1, 0)), back(camera.orientation * glm::dvec3(0, 0, 1)),
      focal(0.5 * height_over(viewport) / std::tan(0.5 * camera.field_of_view)), reference(camera.distance),
      half_width(0.5 * std::max(1, viewport.width)), half_height(0.5 * height_over(viewport)),
      nearest(1e-9 * camera.distance), orthographic(camera.orthographic) {}

void set_up(Camera& camera, UpAxis up) {
    if (camera.up == up) return;
    const Level level = level_of(glm::conjugate(upright(camera.up)) * camera.orientation);
    camera.up = up;
    camera.orientation = glm::normalize(upright(up) * level_orientation(level.azimuth, level.tip));
}

void orbit(Camera& camera, Orbiting style, glm::dvec2 drag_pixels, Viewport viewport) {
    const glm::dvec2 angle = pi / height_over(viewport) * drag_pixels;
    if (style == Orbiting::turntable) {
        const glm::dquat upwards = upright(camera.up);
        const Level level = level_of(glm::conjugate(upwards) * camera.orientation);
        camera.orientation =
            upwards * level_orientation(level.azimuth - angle.x, std::clamp(level.tip - angle.y, 0.0, pi));
    } else {
        const double whole = glm::length(angle);
        if (whole == 0) return;
        camera.orientation = camera.orientation * turn(whole, {-angle.y / whole, -angle.x / whole, 0});
    }
    camera.orientation = glm::normalize(camera.orientation);
}

void pan(Camera& camera, glm::dvec2 drag_pixels, Viewport viewport) {
    const glm::dvec2 drag = pixel_size_at(camera, viewport, camera.pivot) * drag_pixels;
    camera.pivot += camera.orientation * glm::dvec3(-drag.x, drag.y, 0);
}

void zoom(Camera& camera, double steps, glm::dvec2 cursor, Viewport viewport) {
    const double distance =
        std::clamp(camera.distance * std::pow(0.9, steps), nearest_distance, farthest_distance);
    const double factor = distance / camera.distance;
    // Everything is scaled about the point under the cursor, eye and pivot alike.
    const Projector seen(camera, viewport);
    const double pixel = seen.pixel_size(camera.distance);
    const glm::dvec3 center = seen.eye - camera.distance * seen.back +
                              (cursor.x - seen.half_width) * pixel * seen.right -
                              (cursor.y - seen.half_height) * pixel * seen.up;
    camera.pivot = center + factor * (camera.pivot - center);
    camera.offset *= factor;
    camera.distance = distance;
}

void look_at_side(Camera& camera, Side side) {
    switch (side) {
    case Side::front:
        camera.orientation = level_orientation(0, pi / 2);
        break;
    case Side::back:
        camera.orientation = level_orientation(pi, pi / 2);
        break;
    case Side::right:
        camera.orientation = level_orientation(pi / 2, pi / 2);
        break;
    case Side::left:
        camera.orientation = level_orientation(-pi / 2, pi / 2);
        break;
    case Side::top:
        camera.orientation = level_orientation(0, 0);
        break;
    case Side::bottom:
        camera.orientation = level_orientation(0, pi);
        break;
    }
    camera.orientation = upright(camera.up) * camera.orientation;
}

void frame(Camera& camera, const Box3& box, Viewport viewport) {
    if (!is_finite(box.lowest) || !is_finite(box.highest)) return;
    camera.pivot = 0.5 * (box.lowest + box.highest);
    camera.offset = {0, 0};
    const double tall = margin * std::tan(0.5 * camera.field_of_view);
    const double wide = tall * std::max(1, viewport.width) / height_over(viewport);
    double distance = 0;
    const glm::dquat to_camera = glm::conjugate(camera.orientation);
    for (const glm::dvec3& corner : corners_of(box)) {
        const glm::dvec3 seen = to_camera * (corner - camera.pivot);
        const double nearer = camera.orthographic ? 0 : seen.z;
        distance = std::max({distance, std::abs(seen.x) / wide + nearer, std::abs(seen.y) / tall + nearer});
    }
    if (distance > 0) camera.distance = std::clamp(distance, nearest_distance, farthest_distance);
}

Camera first_view(const Box3& box, Viewport viewport, UpAxis up) {
    Camera camera;
    camera.up = up;
    camera.orientation = upright(up) * level_orientation(pi / 6, pi / 2 - pi / 9);
    frame(camera, box, viewport);
    return camera;
}

void set_pivot(Camera& camera, const glm::dvec3& point) {
    if (!is_finite(point)) return;
    const glm::dvec3 seen = glm::conjugate(camera.orientation) * (point - eye_of(camera));
    const bool in_front = camera.orthographic || -seen.z > nearest_distance;
    camera.pivot = point;
    camera.offset = in_front ? glm::dvec2(-seen.x, -seen.y) : glm::dvec2(0, 0);
    // An orthographic view takes its scale from the distance, and shows the same from any.
    if (in_front && !camera.orthographic) camera.distance = -seen.z;
}

glm::dvec3 eye_of(const Camera& camera) {
    return camera.pivot + camera.orientation * glm::dvec3(camera.offset, camera.distance);
}

glm::dmat4 view_matrix(const Camera& camera) {
    const glm::dmat3 turned = glm::mat3_cast(glm::conjugate(camera.orientation));
    glm::dmat4 matrix(turned);
    matrix[3] = glm::dvec4(-(turned * eye_of(camera)), 1.0);
    return matrix;
}

glm::dmat4 projection_matrix(const Camera& camera, Viewport viewport, const Box3& box) {
    const double tall = 1 / std::tan(0.5 * camera.field_of_view);
    const double wide = tall * height_over(viewport) / std::max(1, viewport.width);
    glm::dmat4 matrix(0.0);
    if (camera.orthographic) {
        const auto [nearest, farthest] = orthographic_planes(camera, box);
        matrix[0][0] = wide / camera.distance;
        matrix[1][1] = tall / camera.distance;
        matrix[2][2] = -2 / (farthest - nearest);
        matrix[3][2] = -(farthest + nearest) / (farthest - nearest);
        matrix[3][3] = 1;
    } else {
        const auto [nearest, farthest] = perspective_planes(camera, box);
        matrix[0][0] = wide;
        matrix[1][1] = tall;
        matrix[2][2] = -(farthest + nearest) / (farthest - nearest);
        matrix[2][3] = -1;
        matrix[3][2] = -2 * farthest * nearest / (farthest - nearest);
    }
    return matrix;
}

Ray ray_through(const Camera& camera, Viewport viewport, glm::dvec2 pixel) {
    const Projector seen(camera, viewport);
    const glm::dvec3 across =
        (pixel.x - seen.half_width) * seen.right - (pixel.y - seen.half_height) * seen.up;
    if (camera.orthographic) return {seen.eye + seen.pixel_size(0) * across, -seen.back};
    return {seen.eye, glm::normalize(across - seen.focal * seen.back)};
}

std::optional<Projected> project(const Camera& camera, Viewport viewport, const glm::dvec3& point) {
    const Projector projector(camera, viewport);
    const Projector::Seen seen = projector(point);
    if (!projector.in_front(seen.depth)) return {};
    return Projected{{seen.x, seen.y}, seen.depth};
}

double pixel_size_at(const Camera& camera, Viewport viewport, const glm::dvec3& point) {
    const Projector projector(camera, viewport);
    return projector.pixel_size(std::max(projector(point).depth, nearest_distance));
}

} // namespace knead
