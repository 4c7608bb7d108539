#include "base/memory.h"

#include <fstream>
#include <string>

#include <malloc.h>
#include <sys/resource.h>

namespace knead {

namespace {

// A line of proc(5)'s /proc/self/status: "VmHWM:     1234 kB".
std::uint64_t status_bytes(const std::string& name) {
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word)
        if (std::uint64_t kilobytes = 0; word == name && status >> kilobytes) return kilobytes * 1024;
    return 0;
}

} // namespace

std::uint64_t resident_memory() {
    return status_bytes("VmRSS:");
}

std::uint64_t peak_memory() {
    if (const std::uint64_t peak = status_bytes("VmHWM:")) return peak;
    struct rusage usage {};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

void give_back_freed_memory() {
    (void)::malloc_trim(0);
}

bool forget_peak_memory() {
    give_back_freed_memory();
    if (status_bytes("VmHWM:") == 0) return false;
    std::ofstream refs("/proc/self/clear_refs");
    refs << '5' << std::flush; // proc(5): resets the peak resident set size
    return refs.good();
}

} // namespace knead
