#pragma once
// Real scans, which are not part of the repository: a test that needs one is skipped where it is missing.

#include <filesystem>
#include <optional>
#include <string_view>

namespace knead::test {

// The file in the folder KNEAD_SCANS, else in ../shared/scans beside the checkout; nothing where neither has
// it.
std::optional<std::filesystem::path> find_scan(std::string_view name);

// The same for the benchmark shapes: KNEAD_SURVEY, else ../shared/survey.
std::optional<std::filesystem::path> find_survey(std::string_view name);

// The same for files of all formats, odd, plain and bad: KNEAD_FILES, else ../shared/files; "odd/cube.ply".
std::optional<std::filesystem::path> find_sample(std::string_view name);

// A file of the repository.
std::filesystem::path in_repository(std::string_view path);

} // namespace knead::test

// At the start of a test: `const auto path = ...` of find_scan, or the test ends as skipped with the reason.
#define KNEAD_SCAN_OR_SKIP(path, name)                                                                       \
    const auto path##_found = ::knead::test::find_scan(name);                                                \
    if (!path##_found) GTEST_SKIP() << "no " << (name) << " in KNEAD_SCANS or ../shared/scans";              \
    const std::filesystem::path& path = *path##_found

// The same of find_sample.
#define KNEAD_SAMPLE_OR_SKIP(path, name)                                                                     \
    const auto path##_found = ::knead::test::find_sample(name);                                              \
    if (!path##_found) GTEST_SKIP() << "no " << (name) << " in KNEAD_FILES or ../shared/files";              \
    const std::filesystem::path& path = *path##_found
