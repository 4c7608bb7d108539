#pragma once
// How good the deformed shapes are: how far few samples are from every point a sample, and how fast the
// iterations get there.

#include "bench/deviation.h"
#include "bench/survey.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace knead {

class Upsampler;
class Workers;

// The task with so many samples, settled, beside every point a sample, settled alike.
struct SampleQuality {
    std::optional<std::uint64_t> asked; // nothing: every point
    std::size_t samples = 0;            // actual
    Deviation deviation;
    std::optional<double> bar; // what `deviation.rms` must not exceed, as a fraction
    double noise = 0;          // link_noise(); noise_bar times that of every point is aimed at, if `bar` is
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
        std::optional<double> bar; // what `deviation.largest` must not exceed, as a fraction
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

// Evaluates a task. The aims of the four survey shapes are found by name.
TaskQuality evaluate_task(const DeformationTask& task, Workers& workers, Upsampler& upsampler,
                          Progress& progress);

} // namespace knead
