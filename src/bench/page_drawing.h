#pragma once
// The pictures of the evaluation's page: posed clouds on a light ground, with no display.

#include "base/types.h"
#include "base/workers.h"
#include "graph/csr.h"
#include "graph/point_order.h"
#include "view/camera.h"

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace knead {

inline constexpr Viewport usual_size{440, 380}; // pixels

// Where from. Azimuth and elevation in degrees as in `knead render --view`, 0,0 being the front, which for y
// up is what +z sees. The camera is framed on `framed` (3n, about the cloud's origin), so that pictures of a
// row are seen alike.
struct PageView {
    double azimuth = 0, elevation = 0;
    UpAxis up = UpAxis::z;
    Viewport size = usual_size;
    std::vector<float> framed;
};

// A line over the cloud, hidden where the cloud is nearer; from one place to the same: a round dot. Relative
// to the cloud's origin.
struct PageLine {
    Vec3f from = Vec3f::Zero(), to = Vec3f::Zero();
    bool strong = false; // of the colour of what moves, or a quiet dark one
    float width = 1;     // pixels
};

// What is seen. Views, all in the order of computation but the graph, which is that of the vertices as
// opened: shading comes from it.
struct PageShape {
    const PointOrder* order = nullptr;
    const Graph* graph = nullptr;
    std::span<const float> opened, positions; // 3n
    std::vector<Index> handle;                // n: which handle holds each point, or no_index; or empty
    std::span<const float> values;            // n: told by colour instead of the handles; or empty
    double largest_value = 1;                 // the end of the scale
    bool solid = false;                       // a filled volume has no normals to shade it by
    std::span<const PageLine> lines{};        // over the cloud
};

class PageDrawer {
public:
    // Throws Error (usage) where nothing can be drawn: no EGL, or a knead that was built without it.
    explicit PageDrawer(Workers& workers);
    ~PageDrawer();

    // Writes one picture, PNG. Throws Error (output).
    void draw(const std::filesystem::path& file, const PageShape& shape, const PageView& view);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace knead
