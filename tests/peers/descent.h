#pragma once
// A deformation on its way to where it converges: what both knead and its peer are measured by.

#include "base/workers.h"
#include "bench/survey.h"
#include "upsample/upsample.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace knead::peers {

// The pose after so many iterations.
struct Stop {
    std::size_t iterations = 0;
    double seconds = 0;           // of frame time so far: iterations, and one writing of every point
    std::vector<float> positions; // 3n
};

struct Descent {
    std::string name;
    std::string trouble;     // why there is nothing below; empty if there is
    std::size_t samples = 0; // or vertices: what is iterated
    double preparation = 0;  // seconds, the median of the repeats
    double iteration = 0;    // seconds, the median of all
    std::vector<Stop> stops; // the first one is before the first iteration, or after it; the last is the end
    bool at_rest = false;    // whether it stopped by itself
};

// Whether to keep the pose after so many iterations: each of the first hundred, then one every 2 %.
bool is_stop(std::size_t iterations);

// From which iteration on a descent stays within `bar` (over `diagonal`) of its own end; nothing where that
// is within the last tenth of its iterations and it did not come to rest, so that its end says too little.
struct Arrival {
    std::size_t iterations = 0;
    double seconds = 0;
};
struct Arrivals {
    std::optional<Arrival> rms, largest;
    double last_tenth =
        0; // how far the farthest point still went in the last tenth of the iterations, over D
};
Arrivals arrivals_of(const Descent& descent, double bar, double diagonal);

// knead on the task's points with so many samples (nothing: every point): settled from rest at the whole
// motion. `repeats` preparations.
Descent descend_with_knead(const DeformationTask& task, const std::optional<std::uint64_t>& samples,
                           std::size_t most_iterations, std::size_t repeats, Workers& workers,
                           Upsampler& upsampler);

} // namespace knead::peers
