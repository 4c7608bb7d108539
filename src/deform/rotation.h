#pragma once
// The local step: which rotation a neighbourhood made.

#include "base/types.h"

#include <span>

namespace knead {

// The rotation R that maximises tr(Rᵀ A): for A = Σ w x eᵀ, the least-squares rotation from the edges e to
// the edges x. Where A leaves it open (edges on a line leave a turn about it, no edges leave everything) it
// is the one nearest to `near`. `near` is a unit quaternion; the result is one, of the hemisphere of `near`,
// and is `near` itself to the last bit where that is already the maximum.
Quatd nearest_rotation(const Mat3d& a, const Quatd& near);

// The same of as many at once, side by side: `near` holds what they are to be near to, and receives them.
// What one of them is does not depend on the others.
void nearest_rotations(std::span<const Mat3d> a, std::span<Quatd> near);

// R - I of a unit quaternion, exactly zero for the identity (either sign of it).
Mat3d turn_of(const Quatd& rotation);

} // namespace knead
