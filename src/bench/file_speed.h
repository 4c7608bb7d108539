#pragma once
// How fast clouds are loaded and saved, beside what the disk and the system's cache give in the same run.

#include "base/progress.h"
#include "bench/machine.h"
#include "bench/statistics.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace knead {

// One format; all times are in seconds, and of the whole call, files opened, synced and renamed.
struct FormatSpeed {
    std::string extension; // ".ply"
    std::size_t bytes = 0; // of the file
    Summary read;          // the plain bytes into memory
    Summary load;          // the cloud from the same file
    Summary copy;          // the plain bytes, written and synced as a whole file
    Summary save;          // the cloud, every point moved, as another file of its format
};

struct FileSpeed {
    Machine machine;
    std::size_t points = 0;
    std::size_t repeats = 0;
    std::vector<FormatSpeed> formats;
};

// Writes a creature of `points` points, with normals and colours, in every format into a folder of its own in
// `folder`, and reads and saves each `repeats` times (≥ 1), in turns with the plain bytes, after once that
// warms up: what is read is in the system's cache. Leaves nothing behind. Throws Error (output) where the
// folder cannot be written to, and Cancelled.
FileSpeed measure_files(const std::filesystem::path& folder, std::size_t points, std::size_t repeats,
                        Workers& workers, Progress& progress);

// The table for people, at most 130 columns wide, and one JSON object with every number.
std::string file_speed_text(const FileSpeed& speed);
std::string file_speed_json(const FileSpeed& speed);

} // namespace knead
