#pragma once
// How good the deformed shapes are: how far few samples are from every point a sample, and how fast the
// iterations get there.

#include "bench/survey.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace knead {

class Upsampler;
class Workers;

// Between two poses of one cloud, in units of D, the diagonal of its bounding box at rest.
struct Deviation {
    double rms = 0;
    double largest = 0;
};

// Both 3n; points that are not finite at rest must not be counted, so they have to be equal in both.
// `diagonal` of 0 leaves the cloud's units.
Deviation deviation_between(std::span<const float> a, std::span<const float> b, double diagonal);

// The task with so many samples, settled, beside every point a sample, settled alike.
struct SampleQuality {
    std::optional<std::uint64_t> asked; // nothing: every point
    std::size_t samples = 0;            // actual
    Deviation deviation;
    std::optional<double> bar; // what `deviation.rms` must not exceed, as a fraction
    double handle_error = 0;   // over D
    std::size_t iterations = 0;
    bool at_rest = false; // before the iterations ran out
};

// How far the shape still is from the settled one of as many samples, after so many iterations from rest.
struct Convergence {
    std::optional<std::uint64_t> asked;
    struct Step {
        unsigned iterations = 0;
        Deviation deviation;
    };
    std::vector<Step> steps;
};

struct TaskQuality {
    std::string name;
    std::size_t points = 0;
    double diagonal = 0;               // D
    std::vector<SampleQuality> counts; // every point first, then 1000, 200, 50
    std::vector<Convergence> convergence;
};

// The whole motion in one frame, then up to `settle_limit` iterations more.
inline constexpr unsigned settle_limit = 300;

// Evaluates a task. What DESIGN and the issue demand of the four survey shapes is found by name.
TaskQuality evaluate_task(const DeformationTask& task, Workers& workers, Upsampler& upsampler,
                          Progress& progress);

} // namespace knead
