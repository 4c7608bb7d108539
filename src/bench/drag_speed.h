#pragma once
// How fast a drag of many samples follows the hand, by frames of all samples and by frames for which few
// answer, and how far the shape still goes when the hand rests; and what a region of interest saves.

#include "bench/deviation.h"
#include "bench/machine.h"
#include "bench/region_speed.h"
#include "bench/statistics.h"
#include "bench/table1.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace knead {

// A cloud bent by 60° in 30 frames, which then rests for some frames of all samples.
struct DraggedWay {
    Summary frame;           // seconds, upsampling included; without the first
    double first_frame = 0;  // seconds
    Deviation last_step;     // of the drag: between its last two frames
    Deviation first_at_rest; // from the drag's last frame to the next one
    Deviation to_rest;       // from the drag's last frame to the last one
};

struct DragSpeed {
    std::size_t samples = 0; // actual
    DraggedWay full, coarse;
    double upsample = 0; // seconds of a frame, the median
    Deviation apart;     // where the two ways come to rest
};

struct DragSpeeds {
    Machine machine;
    std::string cloud, device;
    std::size_t points = 0;
    std::vector<DragSpeed> rows;
    RegionSpeed region; // of 5 % of the points, with the fewest samples
    std::vector<std::string> warnings;
};

// One row for each number of samples that is below the number of points. `samples`: at least one number.
// Throws Error as make_upsampler() and Pipeline::prepare() do, and Cancelled.
DragSpeeds measure_drags(const std::string& name, PointCloud cloud, std::span<const std::uint64_t> samples,
                         const Table1Options& options, Progress& progress);

// The table for people, at most 130 columns wide, and one JSON object with every number.
std::string drag_speeds_text(const DragSpeeds& speeds);
std::string drag_speeds_json(const DragSpeeds& speeds);

} // namespace knead
