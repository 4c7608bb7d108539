#include "bench/data_files.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

namespace knead {

namespace {

namespace fs = std::filesystem;

// Binaries lie in CHECKOUT/build/ or a folder below.
constexpr int levels_to_checkout = 3;

DataFolders folders_for(const std::string& asked, const char* variable, const std::string& shared) {
    if (!asked.empty()) return {{asked}, asked};
    DataFolders result;
    if (const char* folder = std::getenv(variable)) result.folders.emplace_back(folder);
    const fs::path below_checkout = fs::path("..") / "shared" / shared;
    result.folders.push_back(below_checkout);
    std::error_code failed;
    fs::path folder = fs::read_symlink("/proc/self/exe", failed).parent_path();
    for (int level = 0; level < levels_to_checkout && folder.has_relative_path(); ++level) {
        result.folders.push_back(folder / below_checkout);
        folder = folder.parent_path();
    }
    result.words = std::string(variable) + " or " + below_checkout.string();
    return result;
}

} // namespace

DataFolders scan_folders(const std::string& asked) {
    return folders_for(asked, "KNEAD_SCANS", "scans");
}

DataFolders survey_folders(const std::string& asked) {
    return folders_for(asked, "KNEAD_SURVEY", "survey");
}

std::optional<fs::path> find_data_file(const DataFolders& folders, std::string_view name) {
    std::error_code ignored;
    for (const fs::path& folder : folders.folders)
        if (fs::exists(folder / name, ignored)) return (folder / name).lexically_normal();
    return std::nullopt;
}

std::string missing_words(const DataFolders& folders, std::string_view name) {
    return "no " + std::string(name) + " in " + folders.words;
}

std::vector<fs::path> data_files(const DataFolders& folders, std::string_view extension) {
    std::vector<fs::path> files;
    for (const fs::path& folder : folders.folders) {
        std::error_code ignored;
        for (const auto& entry : fs::directory_iterator(folder, ignored))
            if (entry.path().extension() == extension) files.push_back(entry.path().lexically_normal());
        if (!files.empty()) break;
    }
    std::ranges::sort(files);
    return files;
}

} // namespace knead
