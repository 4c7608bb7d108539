#pragma once
// Whether the number of samples shows on scans, which are bent, with few samples and with as many as can be.

#include "bench/data_files.h"
#include "bench/survey.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace knead {

class Upsampler;
class Workers;

// What stands for "every point a sample" on clouds that have more of them.
inline constexpr std::uint64_t full_samples = 100'000;

// One number of samples, settled after one frame, beside the full solution, settled alike.
struct ScanSampleCount {
    std::optional<std::uint64_t> asked; // nothing: every point
    std::size_t samples = 0;            // actual
    double rms = 0, largest = 0;        // distance from the full solution, over D
    double noise = 0;                   // link_noise()
    std::size_t iterations = 0;
    bool at_rest = false; // before the iterations ran out
};

struct ScanSamples {
    std::string name;
    std::string missing; // why nothing was measured; else empty
    std::size_t points = 0;
    std::vector<ScanSampleCount> counts; // the full solution first, then the most samples to the fewest
};

// A scan by a short name ("bunny"), and the file it is in.
struct NamedScan {
    const char* name;
    const char* file; // "bunny.ply"
};
std::span<const NamedScan> scans_of_the_paper();

// These and the horse, and two that are all rims and holes: one from the air, and a room from inside.
std::span<const NamedScan> scans_to_sample();

// The task with so many samples each, as far as those are fewer than the full solution's.
ScanSamples evaluate_scan_samples(const DeformationTask& task, std::span<const std::uint64_t> counts,
                                  Workers& workers, Upsampler& upsampler, Progress& progress);

// The scan, bent by 60° between automatic handles; where its file is not at
// hand the result says so.
ScanSamples evaluate_scan_samples(const NamedScan& scan, const DataFolders& folders, Workers& workers,
                                  Upsampler& upsampler, Progress& progress);

} // namespace knead
