#pragma once
// Private to this room: a picture that comes about in steps. What is in view is drawn in subsets, each spread
// evenly over the surface, so that the first one is a picture already, and the whole cloud grows behind it.

#include "render/chunks.h"
#include "render/layer.h"
#include "render/point_renderer.h"
#include "render/splats.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace knead {

// What is known of the points besides what Splats keeps of them.
struct DrawnCloud {
    std::size_t n = 0;
    double spacing = 0; // the usual distance of neighbours
    std::vector<Chunk> chunks;
    bool has_normals = false, has_marks = false;
    std::uint8_t widest_width = 0; // see Splats::set_widths()
    std::uint64_t version = 0;     // another one for every change that shows
};

struct DrawnOverlay {
    std::vector<OverlayLine> lines;
    std::optional<Box3> box; // around the lines; nothing: there are none
    std::uint64_t version = 0;
};

class ProgressivePicture {
public:
    // What a picture shows; a picture of the same scene is not drawn again.
    struct Scene {
        Camera camera;
        Viewport viewport;
        PointLook look;
        std::uint64_t cloud_version = 0;
    };

    // The next step of a picture of this scene, or the first of another one: at most about `budget` points.
    DrawResult draw(const Scene& next, std::size_t budget, const DrawnCloud& cloud,
                    const DrawnOverlay& overlay, Splats& splats);
    // As far as it has come, after the pass over the screen, with the overlay.
    const Layer& finished() const { return finished_; }

private:
    bool is_of(const Scene& other) const;
    void begin(const Scene& next, std::size_t budget, const DrawnCloud& cloud, const DrawnOverlay& overlay);
    double radius_at_pivot(const DrawnCloud& cloud) const;
    void project_onto(Box3 box, double radius, const DrawnOverlay& overlay);
    SplatView view_of(const DrawnCloud& cloud, double enlargement) const;
    double usual_width(const SplatView& view) const;         // of a splat at the pivot, pixels
    double first_enlargement(const DrawnCloud& cloud) const; // of the splats of the first subset
    std::size_t draw_subset(std::size_t subset, double enlargement, const DrawnCloud& cloud, Splats& splats,
                            Layer& layer, bool clear);
    ScreenPass screen_pass(const DrawnCloud& cloud) const;
    Overlay lines_over(const DrawnOverlay& overlay, double spacing) const;

    Layer shown_, growing_; // what is on the screen, and the whole cloud as far as it has come
    Layer finished_;        // `shown_` after the pass over the screen, with the overlay
    Scene scene_;
    bool is_drawn_ = false; // whether `shown_` is of `scene_`
    glm::dmat4 projection_{1.0}, to_clip_{1.0};
    InView in_view_;
    double widest_splat_ = 0, usual_splat_ = 0; // pixels; the widest in view, and one at the pivot
    std::size_t one_in_ = 1;                    // the first subset is one in so many
    std::size_t next_subset_ = 0;               // of one_in_; all are drawn: complete
    std::uint64_t finished_overlay_ = 0;        // the version of the overlay in `finished_`
};

} // namespace knead
