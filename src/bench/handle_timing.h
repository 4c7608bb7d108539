#pragma once
// How soon a changed set of handles is live again: on the plane with its two automatic handles, or all of it
// held but for a disc, a third one comes and goes.

#include "bench/table1.h"

#include <cstddef>
#include <string>
#include <vector>

namespace knead {

// What one plane took; seconds.
struct HandleTimingRow {
    std::size_t points = 0;
    std::size_t samples = 0;                       // actual, with three handles
    std::size_t in_handle = 0;                     // points that the third handle holds
    bool is_in_disc = false;                       // all held but for a disc, or two automatic handles
    bool is_first = false;                         // in the list of the three, or the last of them
    Summary sampling, geodesic, factorize, device; // the stages that ran again (StageSeconds)
    Summary frame; // the first with the new handles: start, iterations, all points
    Summary live;  // all of it, from the change to the first frame
};

struct HandleTiming {
    Machine machine;
    unsigned threads = 0;
    std::string device;
    std::vector<HandleTimingRow> rows;
    std::vector<std::string> warnings;
};

// Measures planes of 100,000, 1,000,000 … points up to `most_points` with 1000 and with 5000 samples: the
// third handle, a disc in the middle with a radius of 3 % of the cloud's size, comes and goes
// `options.repeats` times each, after once that warms up; at the end of the list, as in the editor, and at
// its beginning, where the numbers of all other handles change; and at the end where a fixed handle holds all
// that is further than 15 % from the middle, and samples lie in the disc that it leaves.
HandleTiming measure_handle_timing(std::size_t most_points, const Table1Options& options, Progress& progress);

// A table for people, at most 130 columns wide; one JSON object with every number.
std::string handle_timing_text(const HandleTiming& timing);
std::string handle_timing_json(const HandleTiming& timing);

} // namespace knead
