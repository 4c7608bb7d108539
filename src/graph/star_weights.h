#pragma once
// The weights of one vertex's links, as far as it knows by itself: what edge_weights.h is made of.

#include "base/types.h"

#include <span>

namespace knead {

// xx yy zz xy xz yz of a symmetric matrix.
using Symmetric = Eigen::Matrix<double, 6, 1>;

// One link of a vertex; all of them are a star.
struct Spoke {
    Vec3d edge;
    double length;
    Symmetric square; // e eᵀ
    double contact;
    double along = 0; // work space: dᵀ C d
};
Spoke spoke_along(const Vec3d& edge, double contact);

// How unevenly a vertex pulls: Σ w e, and Σ w |e|.
struct Pull {
    Vec3d sum = Vec3d::Zero();
    double effort = 0;
};
Pull pull_of(std::span<const Spoke> star, std::span<const double> weight);

// c = 1 - π/4 · |Σ w e| / Σ w |e|: of all directions, those that the surface goes on in (edge_weights.h).
double share_of_directions(const Pull& pull);

// C = Σ w e eᵀ.
Symmetric spread_of(std::span<const Spoke> star, std::span<const double> weight);

// Its trace, Σ w |e|²: how much of the surface the vertex stands for.
double area_of(std::span<const Spoke> star, std::span<const double> weight);

// The weights in the beginning, contact / |e| times what makes their sum 6 c. Returns that sum.
double start_weights(std::span<const Spoke> star, std::span<double> weight);

// One update towards pulling as much along each direction.
void even_out(std::span<Spoke> star, double sum, std::span<double> weight);

// What ends every update: the sum is what it was, and then no weight vanishes, for which the least are
// raised.
void finish_update(std::span<double> weight, double sum);

} // namespace knead
