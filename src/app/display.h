#pragma once
// How the cloud is shown: what the Display panel sets and the View menu ticks.

#include "render/point_renderer.h"
#include "view/coloring.h"

#include <string>

namespace knead {

struct Editor;

// What colours the points.
enum class Coloring { file, plain, height, normal, attribute, displacement, stretch, parts };

struct Display {
    Coloring coloring = Coloring::file;
    std::string attribute;       // for Coloring::attribute
    bool automatic_range = true; // of a scalar; else this one
    ValueRange range;
    PointLook look;        // its pixel_scale is the main loop's
    UpAxis up = UpAxis::z; // that was chosen last, see WishUpAxis: of clouds that do not tell theirs
    bool grid = true;
    bool axes = true;
    bool samples = false; // of the solver, once it has chosen some
    bool sample_graph = false;
    bool handles = true; // the colours and patterns of their points
    bool names = true;
};

inline constexpr float smallest_scale = 0.2f, largest_scale = 6;
inline constexpr float smallest_point = 1, largest_point = 24; // pixels

// Makes the points larger or smaller by a factor, whichever way they are sized.
void resize_points_by(Display& display, float factor);

const char* name_of(Coloring coloring); // "File colours"
// Whether it tells a number by colour, with a range.
bool tells_number(Coloring coloring);
// Whether the colours change while the points move.
bool follows_pose(Coloring coloring);

// The colours of all points as they are now; the editor's stretch is computed on the way. Returns what a
// legend needs.
Legend color_points(const Display& display, Editor& editor, std::vector<std::uint32_t>& colors);

} // namespace knead
