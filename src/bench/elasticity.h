#pragma once
// Whether Poisson's ratio is what is measured: bars of a shell and of a solid, pulled by 30 %.

#include "base/progress.h"
#include "bench/survey.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace knead {

class Upsampler;
class Workers;

// How far the measured ratio may be from the one asked for.
inline constexpr double poisson_bar = 0.03;

// A bar of 1 : 1 : 10, held over a twentieth of its length at both ends and pulled until what is between them
// is longer by 30 %.
struct StretchResult {
    bool solid = false;
    std::size_t points = 0;
    std::optional<std::uint64_t> asked_samples; // nothing: every point
    double asked = 0;                           // Poisson's ratio
    double measured = 0;                        // at mid-length: -log of the stretch across over that along
    double along = 1;                           // the stretch along, there
    std::size_t iterations = 0;
    bool at_rest = false; // before the iterations ran out
};

// That bar, as a task: a shell of 19,000 points, or a solid of 20,000.
DeformationTask stretched_bar(bool solid, Workers& workers, Progress& progress);

// Every ratio from -0.9 to 0.49 that is worth a line, with so many samples each; nothing: every point.
std::vector<StretchResult> evaluate_elasticity(std::span<const std::optional<std::uint64_t>> samples,
                                               Workers& workers, Upsampler& upsampler, Progress& progress);

// The stretch of a slab between the heights ±half_height about z = 0: along z, and across it (the mean of
// both sides), by least squares between `rest` and `posed`, both 3n.
struct SlabStretch {
    double along = 1, across = 1;
};
SlabStretch slab_stretch(std::span<const float> rest, std::span<const float> posed, double half_height);

} // namespace knead
