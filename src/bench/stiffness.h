#pragma once
// What one number of stiffness means: the same look at every sampling and at every size.
//
// β = α s² (deform/sample_system.h) makes √α s the length over which a turn spreads: with α = 1e-4 a
// hundredth of the cloud's size, a sheet that creases where it is bent; with 0.01 a tenth, rubber; with 1 all
// of it, a body whose turns are spread evenly from handle to handle, whatever it costs its links.
//
// A turn that spreads over less than the samples' distance is one that samples cannot show, and from 0.001
// downwards γ of deform/sample_system.h lets links resist as well: with α = 1e-4 few samples look stiffer.

#include "bench/deviation.h"
#include "bench/survey.h"

#include <cstdint>
#include <span>
#include <vector>

namespace knead {

class Upsampler;
class Workers;

// How far the same stiffness may look different with 200, 1000 and 5000 samples (rms over D; what was aimed
// at names the first two, for the survey's shapes at the usual stiffness), and at another size (largest over
// D: rounding).
double stiffness_rms_bar(std::uint64_t samples);
inline constexpr double scale_bar = 1e-4;

struct StiffnessResult {
    double stiffness = 0;
    std::size_t points = 0;
    Deviation from_usual; // every point a sample: from the usual stiffness's shape
    double noise = 0;     // link_noise(), every point a sample: what the links pay
    struct Count {
        std::uint64_t asked = 0; // samples
        Deviation deviation;     // from every point a sample
        Deviation at_scale;      // the cloud 1000 times as large, from this
        bool at_rest = false;    // before the iterations ran out, at either size
    };
    std::vector<Count> counts;
    bool at_rest = false; // every point a sample
};

// The task with each stiffness, and with so many samples each.
std::vector<StiffnessResult> evaluate_stiffness(const DeformationTask& task,
                                                std::span<const double> stiffnesses,
                                                std::span<const std::uint64_t> samples, Workers& workers,
                                                Upsampler& upsampler, Progress& progress);

// A bar of 10,000 points, bent by 60° between its ends, with stiffnesses from 1e-4 to 1 and 200, 1000 and
// 5000 samples.
std::vector<StiffnessResult> evaluate_stiffness(Workers& workers, Upsampler& upsampler, Progress& progress);

} // namespace knead
