#pragma once
// What a measurement ran on; without it a number says nothing.

#include "base/workers.h"
#include "bench/statistics.h"

#include <string>

namespace knead {

struct Machine {
    std::string processor; // the model as the system names it, or "unknown"
    unsigned cores = 0;    // that this process may use
    double load = 0;       // runnable threads of the whole machine over the last minute; above 0 it is noisy
    std::string compiler;  // its name and version
    std::string build;     // "Release", and the sanitizers where there are any
    std::string version;   // of knead
    std::string commit;    // that it was built from, "-dirty" with changes; "unknown" outside a checkout
};

Machine this_machine();

// The commit of the checkout at the time of building. (Its file is written by commit.cmake.)
extern const char* const build_commit;

// Seconds for reading bytes / 2 and writing as many elsewhere, on all workers: what moving so many bytes
// costs at least. One warm-up, then `repeats`.
Summary copy_seconds(std::size_t bytes, std::size_t repeats, Workers& workers);

// The memory's own copy bandwidth: bytes a second, in and out, of a copy that is too large for any cache
// (four times the largest, 256 MB at least, but no more than an eighth of the memory).
double memory_copy_rate(Workers& workers);

} // namespace knead
