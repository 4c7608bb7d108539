#pragma once
// The program as its users run it.

#include <filesystem>
#include <string>
#include <vector>

namespace knead::test {

struct Outcome {
    int code = -1; // the exit code; 128 + n after signal n
    std::string out;
    std::string err;
};

// Runs build/knead with these arguments, in `folder` (default: the current one).
Outcome run_knead(const std::vector<std::string>& arguments, const std::filesystem::path& folder = {});

// The binary itself, for tests that start it another way.
std::filesystem::path knead_binary();

} // namespace knead::test
