#pragma once
// How fast a device with memory of its own moves points there, where they are drawn from: without what it
// takes to fetch them.

#include "bench/statistics.h"
#include "bench/text_table.h"
#include "bench/upsampler_probe.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>

namespace knead {

// By the device's own clock, in seconds.
struct OwnMemoryFigures {
    Summary moving;                   // all points, as the probe's last frame
    Summary copy;                     // as many bytes, from one place to another
    std::size_t bytes = 0;            // that a frame reads and writes at least
    double copy_bytes_per_second = 0; // of so much that no cache holds it
};

// Nothing where the device works in the processor's memory, or its own is too small for all that. `frames`
// are measured, after some that warm up. `large_copy`: bytes that are read or written by a large one; the
// caches of GPUs have a tenth.
std::optional<OwnMemoryFigures> measure_in_own_memory(UpsamplerProbe& probe, std::size_t frames,
                                                      std::size_t large_copy = std::size_t{1} << 30);

// How fast the bytes were moved, of the two copies: 1 for as fast.
double share_of_same_copy(const OwnMemoryFigures& figures);
double share_of_large_copy(const OwnMemoryFigures& figures);

// What a table of them is about; its heading, and the cells of a row behind what names it.
inline constexpr const char* own_memory_words =
    "Moving all points in the device's own memory, by its clock; beside a copy there of as many bytes, and a "
    "large one";
std::vector<std::string> own_memory_heading();
std::vector<std::string> own_memory_cells(const OwnMemoryFigures& figures);
// An object; null for nothing.
nlohmann::ordered_json own_memory_json(const std::optional<OwnMemoryFigures>& figures);

} // namespace knead
