#include "bench/machine.h"

#include "base/large_pages.h"
#include "base/stopwatch.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <vector>

#include <sched.h>
#include <unistd.h>

namespace knead {

namespace {

std::string processor_model() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown";
}

unsigned usable_cores() {
    cpu_set_t set;
    if (::sched_getaffinity(0, sizeof set, &set) == 0) return static_cast<unsigned>(CPU_COUNT(&set));
    return static_cast<unsigned>(std::max(1L, ::sysconf(_SC_NPROCESSORS_ONLN)));
}

double load_average() {
    double load = 0;
    return ::getloadavg(&load, 1) == 1 ? load : 0;
}

// Of the system; 0 where it does not say.
std::size_t system_bytes(int what, std::size_t times = 1) {
    const long told = ::sysconf(what);
    return told > 0 ? static_cast<std::size_t>(told) * times : 0;
}

// In and out.
std::size_t bytes_beyond_caches() {
    constexpr std::size_t least = std::size_t{1} << 28, times_the_cache = 4, part_of_memory = 8;
    const std::size_t wanted = std::max(least, times_the_cache * system_bytes(_SC_LEVEL3_CACHE_SIZE));
    const std::size_t memory = system_bytes(_SC_PHYS_PAGES, system_bytes(_SC_PAGESIZE));
    return memory > 0 ? std::min(wanted, memory / part_of_memory) : wanted;
}

} // namespace

Machine this_machine() {
    return {processor_model(), usable_cores(), load_average(), KNEAD_COMPILER,
            KNEAD_BUILD,       KNEAD_VERSION,  build_commit};
}

Summary copy_seconds(std::size_t bytes, std::size_t repeats, Workers& workers) {
    const std::size_t half = std::max<std::size_t>(bytes / 2, 1);
    std::vector<char> from, to;
    resize_in_large_pages(from, half, workers);
    resize_in_large_pages(to, half, workers);
    std::vector<double> seconds;
    for (std::size_t r = 0; r <= repeats; ++r) {
        const Stopwatch clock;
        workers.for_chunks(half, half / workers.threads() + 1, [&](std::size_t begin, std::size_t end) {
            std::memcpy(to.data() + begin, from.data() + begin, end - begin);
        });
        if (r > 0) seconds.push_back(clock.seconds());
    }
    return summarize(std::move(seconds));
}

double memory_copy_rate(Workers& workers) {
    const std::size_t bytes = bytes_beyond_caches();
    return static_cast<double>(bytes) / copy_seconds(bytes, 5, workers).median;
}

} // namespace knead
