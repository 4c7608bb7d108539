#pragma once
// The surfaces with a formula, as patches to be sampled, and the solid. shapes/shapes.h says where they lie.

#include "shapes/surface_patch.h"

#include <vector>

namespace knead {

// Of the bar, the solid one too, and of the cylinder: along z and across, to each side.
inline constexpr double half_length = 2.5, half_width = 0.5;

// `gradient`: densest over sparsest, as in ShapeOptions.
std::vector<SurfacePatch> plane_patches(double gradient);
std::vector<SurfacePatch> bar_patches(double gradient);
std::vector<SurfacePatch> cylinder_patches(double gradient);
std::vector<SurfacePatch> sphere_patches(double gradient);
std::vector<SurfacePatch> torus_patches(double gradient);
std::vector<SurfacePatch> knot_patches(double gradient);

// Puts the points 0 … options.points - 1 of the solid bar into `columns`: layers in z, rows in y, cells of
// equal mass. Noise is the standard deviation in each coordinate.
void sample_solid_bar(double gradient, const SamplingOptions& options, PointColumns& columns,
                      Workers& workers, Progress& progress);

} // namespace knead
