#pragma once
// Small gestures on a large surface: a point, a line or a disc of it lifted, drawn aside, turned or scaled,
// on the whole of it or in a region; and a part of a tube that is scaled and pushes the rest. What bends
// large parts (bench/quality.h) hides what happens here: few samples are near, and turns take up little of
// the cloud.

#include "bench/deviation.h"
#include "bench/survey.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace knead {

class Upsampler;
class Workers;

// What is aimed at: of 1000 samples as much as on the survey's shapes, and no point off by more than one per
// cent, as for the sampling; and normals that the eye takes for the surface's.
inline constexpr double small_rms_bar = 0.002, small_largest_bar = 0.01;
inline constexpr double askew_bar = 3, most_askew_bar = 10; // degrees

// Degrees between the normals that points carry and the surface that they are posed on.
struct Askew {
    double half = 0, tenth = 0; // that half of the points exceed, and one in ten
};

struct SmallResult {
    std::string name; // "a disc of 3 %, lifted"
    std::size_t points = 0;
    std::optional<std::uint64_t> asked; // nothing: every point a sample, the yardstick
    std::size_t samples = 0;            // actual
    Deviation deviation;                // from every point a sample
    Askew askew;                        // of free points that moved by more than 1 % of D
    std::size_t iterations = 0;
    bool at_rest = false;
};

// The task in one frame and settled, with every point a sample and then with as many as are asked. The cloud
// has normals.
std::vector<SmallResult> pose_small(const DeformationTask& task, std::span<const std::uint64_t> samples,
                                    Workers& workers, Upsampler& upsampler, Progress& progress);

// A plane of 40,000 points with every gesture, and as many on a tube.
std::vector<SmallResult> evaluate_small_handles(Workers& workers, Upsampler& upsampler, Progress& progress);

} // namespace knead
