#pragma once
// Quality and properties, over everything that is at hand.

#include "bench/data_files.h"
#include "bench/demands.h"
#include "bench/elasticity.h"
#include "bench/machine.h"
#include "bench/properties.h"
#include "bench/quality.h"
#include "bench/sampling.h"
#include "bench/scan_samples.h"
#include "bench/small_handles.h"
#include "bench/stiffness.h"
#include "bench/turns.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace knead {

struct EvaluationOptions {
    DataFolders scans, survey;
    std::vector<std::string> shapes; // names; empty: all
    std::string device;              // as make_upsampler() takes it
    unsigned threads = 0;            // 0: one a core
};

struct Evaluation {
    Machine machine;
    std::string device;
    bool has_survey = false;                  // else the tasks are likenesses
    std::string remark;                       // where the survey is missing; else empty
    std::vector<TaskQuality> tasks;           // the survey's shapes, or their likenesses
    std::vector<CloudProperties> clouds;      // generated ones, then the scans
    std::optional<TwistResult> twist;         // with "made-bar"
    std::vector<StretchResult> stretches;     // with "elasticity"
    std::vector<ScanSamples> scans;           // with "samples-bunny" …
    std::vector<SamplingResult> samplings;    // with "sampling"
    std::vector<TurnResult> turns;            // with "turns"
    std::vector<StiffnessResult> stiffnesses; // with "stiffness"
    std::vector<DemandResult> demands;        // with "demands"
    std::vector<SmallResult> small_handles;   // with "small"
    std::vector<std::string> warnings;        // of the device
};

// The names that `shapes` may hold with these folders: the tasks, generated clouds ("made-knot"),
// "elasticity", "sampling", "turns", "stiffness", "demands", "small", "samples-bunny" and the others of
// scans_to_sample(), and the scans' file names without ".ply", for their properties.
std::vector<std::string> evaluation_names(const EvaluationOptions& options);

// Throws Error (usage) for a name or a device that is not there, Error (input) for a file that cannot be
// read, and Cancelled.
Evaluation evaluate(const EvaluationOptions& options, Progress& progress);

// The tables for people, at most 130 columns wide, and one JSON object with every number.
std::string evaluation_text(const Evaluation& evaluation);
std::string evaluation_json(const Evaluation& evaluation);

} // namespace knead
