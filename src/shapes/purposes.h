#pragma once
// What random numbers are drawn for (shapes/random.h): each purpose has sequences of its own.

#include <cstdint>

namespace knead {

enum RandomPurpose : std::uint64_t {
    purpose_surface,
    purpose_row,
    purpose_solid,
    purpose_stray,
    purpose_ray,
    purpose_return,
    purpose_echo,
    purpose_choice, // and the two after it: one a kind
};

} // namespace knead
