#pragma once
// How far handles pull and press a shape out of its proportions.

#include "deform/sample_system.h"

namespace knead {

// How many times as long as at rest the links of the samples are that have a free end: the factor that one of
// a hundred of them exceeds, and the one that one of a hundred falls short of. 1 where there is none.
struct Strain {
    double longest = 1, shortest = 1;
};
Strain strain_of(const SampleSystem& system, const SampleState& state);

} // namespace knead
