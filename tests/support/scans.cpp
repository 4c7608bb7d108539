#include "support/scans.h"

#include <cstdlib>

namespace knead::test {

namespace {

std::optional<std::filesystem::path> find(const char* variable, const char* shared, std::string_view name) {
    if (const char* folder = std::getenv(variable)) {
        auto path = std::filesystem::path(folder) / name;
        if (std::filesystem::exists(path)) return path;
    }
    auto path = std::filesystem::path(KNEAD_SOURCE_DIR) / ".." / "shared" / shared / name;
    if (std::filesystem::exists(path)) return path;
    return std::nullopt;
}

} // namespace

std::optional<std::filesystem::path> find_scan(std::string_view name) {
    return find("KNEAD_SCANS", "scans", name);
}

std::optional<std::filesystem::path> find_survey(std::string_view name) {
    return find("KNEAD_SURVEY", "survey", name);
}

std::optional<std::filesystem::path> find_sample(std::string_view name) {
    return find("KNEAD_FILES", "files", name);
}

std::filesystem::path in_repository(std::string_view path) {
    return std::filesystem::path(KNEAD_SOURCE_DIR) / path;
}

} // namespace knead::test
