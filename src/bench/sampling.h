#pragma once
// Whether it shows how a surface was sampled: in rings or evenly, denser at one end, with noise and strays.
// (How many of the points are samples is bench/quality.h.)

#include "bench/deviation.h"
#include "bench/survey.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace knead {

class Upsampler;
class Workers;

// What is aimed at. Two shapes that are each within the 0.2 % of D that 1000 samples are allowed
// are within 0.4 % of each other; and no point may spike by a whole per cent.
inline constexpr double sampling_rms_bar = 0.004, sampling_largest_bar = 0.01;

// Two clouds of one surface, both posed alike and settled: how far the field of the first is from that of the
// second, by field_deviation(), from the first's points that are no strays.
struct SamplingResult {
    std::string shape, sampling; // "tube, bent 120°", "in rings"
    std::size_t points = 0, twin_points = 0;
    std::optional<std::uint64_t> asked; // samples, in both; nothing: every point
    Deviation deviation;
    bool at_rest = false; // both
};

// All pairs: even twins with another seed (what is left between them is the yardstick), rings (with the
// survey's cylinder, where its folder is at hand), densities of 1 : 20, by and by and all at once, noise,
// strays, and both; each with every point a sample and with 1000. And, with 1000, the dragon among strays,
// where it is at hand.
std::vector<SamplingResult> evaluate_sampling(const DataFolders& survey, const DataFolders& scans,
                                              Workers& workers, Upsampler& upsampler, Progress& progress);

// One pair. `counted`: how many of the first cloud's points are no strays; they come first. `strays`: what
// becomes of them. Both tasks have the same motion.
SamplingResult compare_samplings(const DeformationTask& task, std::size_t counted,
                                 const DeformationTask& twin, const std::optional<std::uint64_t>& samples,
                                 Strays strays, Workers& workers, Upsampler& upsampler, Progress& progress);

} // namespace knead
