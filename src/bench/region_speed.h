#pragma once
// What a region of interest saves: frames of the same drag with a region and without one, in turns.

#include "bench/statistics.h"
#include "bench/survey.h"
#include "bench/table1.h"

namespace knead {

struct RegionSpeed {
    std::size_t points = 0; // in the region, the handle's included
    struct Frames {
        std::size_t samples = 0; // actual
        Summary frame;           // seconds of solving and upsampling
        Summary upsample;        // seconds of moving the points
    };
    Frames whole, region; // without it, and with it
};

// Drags a handle of one hundredth of the cloud's points, in the middle of the task's handle. The region is
// the points nearest to it, `share` of all. The task's fixed handle stays. Frames are counted from the second
// one on, as the first one writes every point. Throws Error as make_upsampler() and Pipeline::prepare() do,
// and Cancelled.
RegionSpeed measure_region(const DeformationTask& task, double share, std::uint64_t samples,
                           const Table1Options& options, Workers& workers, Progress& progress);

} // namespace knead
