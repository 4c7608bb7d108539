#pragma once
// Whether a shape keeps the whole turns that a handle made.

#include "deform/sample_system.h"

#include <cstdint>
#include <optional>
#include <span>

namespace knead {

enum class WayEnd : std::uint8_t { neither, from, to };

// How far samples turn against each other on the way from some to others: the sum of the angles between
// neighbours, in radians, along the way on which it is least. A twist by two turns is 4π along every way, or
// else the shape has slipped back by whole turns, which rotations alone do not tell: after two they are what
// they were. `ends`: of each sample, whether ways begin or end there. Nothing where no way leads there.
std::optional<double> least_turn(const SampleSystem& system, const SampleState& state,
                                 std::span<const WayEnd> ends);

} // namespace knead
