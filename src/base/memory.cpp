#include "base/memory.h"

#include <fstream>
#include <string>

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
    return status_bytes("VmHWM:");
}

void forget_peak_memory() {
    std::ofstream("/proc/self/clear_refs") << '5'; // proc(5): resets the peak resident set size
}

} // namespace knead
