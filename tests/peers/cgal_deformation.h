#pragma once
// CGAL's deformation of a surface mesh (package Surface_mesh_deformation), to its own convergence.

#include "peers/cgal_mesh.h"
#include "peers/descent.h"

#include <span>

namespace knead::peers {

// Which energy: "spokes and rims", its default, or as rigid as possible with smooth rotations (α = 0.02, its
// default; cotangent weights).
enum class CgalEnergy { spokes_and_rims, smooth_rotations };

// The task on the mesh of these triangles over its points; the region of interest is all of it. Solver and
// closest rotation are CGAL's defaults (Eigen's SparseLU with COLAMD, the polar decomposition); one thread.
// Stops after `most_iterations`, or before where no point goes farther in an iteration than 1e-7 of D. What
// CGAL refuses is a descent with `trouble`.
Descent descend_with_cgal(const DeformationTask& task, std::span<const Triangle> triangles, CgalEnergy energy,
                          std::size_t most_iterations, std::size_t repeats);

} // namespace knead::peers
