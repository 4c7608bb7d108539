#pragma once
// Handles that ask for the impossible: whether the compromise is even, and whether knead says so; and whether
// it is silent where the shape can follow.

#include "bench/survey.h"
#include "edit/handle_demand.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace knead {

class Upsampler;
class Workers;

// How much more the free part may be stretched in one place than in another.
inline constexpr double evenness_bar = 0.1;

// A task, and whether it asks for too much.
struct DemandCase {
    std::string name; // "bar, 4 times as long"
    DeformationTask task;
    bool too_much = false;
    bool straight = false; // the handles part or meet along z, so that evenness can be told
};

struct DemandResult {
    std::string name;
    std::size_t points = 0;
    HandleDemand demand;
    bool too_much = false;
    std::string words;            // what is said about it; empty: nothing
    std::optional<double> uneven; // of slabs of the free part across z: the largest stretch over the
                                  // smallest, less 1
    double handle_error = 0;      // over D
};

// The task in one frame, settled, with 1000 samples.
DemandResult evaluate_demand(const DemandCase& demand_case, Workers& workers, Upsampler& upsampler,
                             Progress& progress);

// A bar bent, twisted, pulled, pressed and pushed through itself, and handles that touch.
std::vector<DemandResult> evaluate_demands(Workers& workers, Upsampler& upsampler, Progress& progress);

} // namespace knead
