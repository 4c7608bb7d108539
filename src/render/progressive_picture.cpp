#include "render/progressive_picture.h"

#include "base/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace knead {

namespace {

// Of a splat's diameter over the spacing of the points: what closes most scans' surfaces.
constexpr double closing_factor = 2.0;
// A splat of one in k is drawn √k larger: so many times at most, or so many pixels wide. (Where the points
// lie far closer together than pixels, a surface of a few of them would be full of holes.)
constexpr double largest_enlargement = 4, widest_enlarged = 5;
constexpr float largest_splat = 96; // pixels

// Where the light comes from, in the camera's axes: from above the left shoulder.
constexpr glm::vec3 key_light(-0.35f, 0.55f, 0.9f);

} // namespace

DrawResult ProgressivePicture::draw(const Scene& next, std::size_t budget, const DrawnCloud& cloud,
                                    const DrawnOverlay& overlay, Splats& splats) {
    DrawResult result;
    bool is_new = true, changed = true;
    const Stopwatch clock;
    if (!is_of(next)) {
        begin(next, budget, cloud, overlay);
        result.drawn = draw_subset(0, first_enlargement(cloud), cloud, splats, shown_, true);
        next_subset_ = one_in_ == 1 ? 1 : 0;
        is_drawn_ = true;
    } else if (next_subset_ < one_in_) {
        result.drawn = draw_subset(next_subset_, 1, cloud, splats, growing_, next_subset_ == 0);
        ++next_subset_;
        is_new = next_subset_ == one_in_;
        if (is_new) std::swap(shown_, growing_);
        changed = is_new || finished_overlay_ != overlay.version;
    } else {
        is_new = false;
        changed = finished_overlay_ != overlay.version;
    }
    result.seconds = clock.seconds();
    if (changed) {
        splats.finish(screen_pass(cloud), lines_over(overlay, cloud.spacing), shown_, is_new, finished_);
        finished_overlay_ = overlay.version;
    }
    result.complete = next_subset_ == one_in_;
    result.in_view = in_view_.points;
    result.one_in = result.complete ? 1 : one_in_;
    return result;
}

bool ProgressivePicture::is_of(const Scene& other) const {
    return is_drawn_ && scene_.camera == other.camera && scene_.viewport.width == other.viewport.width &&
           scene_.viewport.height == other.viewport.height && scene_.look == other.look &&
           scene_.cloud_version == other.cloud_version;
}

// Chooses what is drawn of a new scene.
void ProgressivePicture::begin(const Scene& next, std::size_t budget, const DrawnCloud& cloud,
                               const DrawnOverlay& overlay) {
    scene_ = next;
    widest_splat_ = 0;
    // First what is in view; then near and far planes that enclose no more than that, so that depths are
    // fine.
    const double radius = radius_at_pivot(cloud);
    project_onto(box_around(cloud.chunks), radius, overlay);
    const float margin = largest_splat * scene_.look.pixel_scale /
                         static_cast<float>(std::min(scene_.viewport.width, scene_.viewport.height));
    in_view_ = chunks_in_view(cloud.chunks, cloud.n, to_clip_, margin);
    if (in_view_.points > 0) project_onto(in_view_.box, radius, overlay);
    const std::size_t most = std::max<std::size_t>(budget, 1);
    one_in_ = std::max<std::size_t>(1, (in_view_.points + most - 1) / most);
}

// Of the widest splats, in the units of the cloud.
double ProgressivePicture::radius_at_pivot(const DrawnCloud& cloud) const {
    const PointLook& look = scene_.look;
    if (!look.size_by_distance)
        return 0.5 * look.pixels * look.pixel_scale *
               pixel_size_at(scene_.camera, scene_.viewport, scene_.camera.pivot);
    return 0.5 * closing_factor * look.scale * std::exp2(cloud.widest_width / widths_in_double) *
           cloud.spacing;
}

// Takes the projection whose near and far planes enclose the box, with splats of that radius on it, and the
// overlay.
void ProgressivePicture::project_onto(Box3 box, double radius, const DrawnOverlay& overlay) {
    if (overlay.box) {
        box.lowest = glm::min(box.lowest, overlay.box->lowest);
        box.highest = glm::max(box.highest, overlay.box->highest);
    }
    // Room for splats that stand on end, and for boxes that are flat.
    const glm::dvec3 room(rim_depth * radius + 1e-3 * glm::length(box.highest - box.lowest));
    projection_ = projection_matrix(scene_.camera, scene_.viewport, {box.lowest - room, box.highest + room});
    to_clip_ = projection_ * view_matrix(scene_.camera);
}

SplatView ProgressivePicture::view_of(const DrawnCloud& cloud, double enlargement) const {
    const PointLook& look = scene_.look;
    const double pixels_a_unit = 0.5 * projection_[1][1] * scene_.viewport.height; // at w = 1
    const double fixed = look.size_by_distance ? 0 : look.pixels * look.pixel_scale * enlargement;
    const double by_distance =
        look.size_by_distance ? cloud.spacing * closing_factor * look.scale * enlargement * pixels_a_unit : 0;
    SplatView view;
    view.viewport = scene_.viewport;
    view.to_clip = glm::mat4(to_clip_);
    view.fixed = static_cast<float>(fixed);
    view.by_distance = static_cast<float>(by_distance);
    view.grown_to = static_cast<float>(widest_enlarged) * look.pixel_scale;
    view.grown = static_cast<float>(std::min(1.0, largest_enlargement / enlargement));
    view.smallest = look.pixel_scale;
    view.largest = largest_splat * look.pixel_scale;
    const double widest =
        fixed + by_distance * std::exp2(cloud.widest_width / widths_in_double) / in_view_.nearest;
    view.widest = diameter_of(view, static_cast<float>(widest));
    view.pixel_size = static_cast<float>(1 / pixels_a_unit);
    const glm::mat3 axes = glm::mat3_cast(glm::quat(scene_.camera.orientation));
    view.right = axes[0];
    view.up = axes[1];
    view.forward = -axes[2];
    if (!scene_.camera.orthographic) view.half_field = {1 / projection_[0][0], 1 / projection_[1][1]};
    view.key = glm::normalize(axes * key_light);
    view.shaded = look.shading && cloud.has_normals;
    return view;
}

double ProgressivePicture::usual_width(const SplatView& view) const {
    const double w = scene_.camera.orthographic ? 1 : scene_.camera.distance;
    return view.fixed + view.by_distance / w;
}

double ProgressivePicture::first_enlargement(const DrawnCloud& cloud) const {
    const double plain = usual_width(view_of(cloud, 1));
    const double most = std::max(largest_enlargement, widest_enlarged * scene_.look.pixel_scale / plain);
    return std::min(std::sqrt(static_cast<double>(one_in_)), most);
}

// Draws subset number `subset` of those in view; returns how many points it has.
std::size_t ProgressivePicture::draw_subset(std::size_t subset, double enlargement, const DrawnCloud& cloud,
                                            Splats& splats, Layer& layer, bool clear) {
    const SplatView view = view_of(cloud, enlargement);
    widest_splat_ = std::max<double>(widest_splat_, view.widest);
    usual_splat_ = std::clamp<double>(usual_width(view), view.smallest, view.largest);
    return splats.draw(in_view_.ranges, subset, one_in_, view, layer, clear);
}

ScreenPass ProgressivePicture::screen_pass(const DrawnCloud& cloud) const {
    const PointLook& look = scene_.look;
    ScreenPass pass;
    pass.viewport = scene_.viewport;
    pass.top = look.background_top;
    pass.bottom = look.background_bottom;
    if (in_view_.points > 0) {
        const glm::dvec2 screen(scene_.viewport.width, scene_.viewport.height), reach(widest_splat_);
        pass.from = glm::floor((0.5 + 0.5 * in_view_.lowest) * screen - reach);
        pass.to = glm::ceil((0.5 + 0.5 * in_view_.highest) * screen + reach);
    }
    const double pixel = 2 / (projection_[1][1] * scene_.viewport.height); // its length, at w = 1
    const double a = projection_[2][2], b = projection_[3][2];
    pass.depth_scale = scene_.camera.orthographic ? glm::dvec3(2 / (std::abs(a) * pixel), 1, 0)
                                                  : glm::dvec3(2 / (std::abs(b) * pixel), (a - 1) / b,
                                                               2 / b); // 1 / z = (2 depth - 1 + a) / b
    pass.near = std::max(1, static_cast<int>(std::lround(look.pixel_scale)));
    pass.far = 3 * pass.near;
    pass.strength = look.eye_dome ? 1.0f : 0.0f;
    pass.grain = static_cast<float>(0.5 * usual_splat_);
    pass.key = glm::normalize(key_light);
    pass.pattern = look.pixel_scale;
    pass.relief = look.shading && !cloud.has_normals;
    pass.patterns = cloud.has_marks;
    return pass;
}

Overlay ProgressivePicture::lines_over(const DrawnOverlay& overlay, double spacing) const {
    // Three spacings at the pivot's distance, as a difference of depths.
    const double z = scene_.camera.distance;
    const double slope =
        scene_.camera.orthographic ? std::abs(projection_[2][2]) : std::abs(projection_[3][2]) / (z * z);
    return {overlay.lines,
            {glm::mat4(to_clip_), scene_.look.pixel_scale, static_cast<float>(3 * spacing * slope)}};
}

} // namespace knead
