#pragma once
// Where the scans and the survey shapes lie that measurements run on. They are no part of knead.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace knead {

// Folders to look in, and how to speak of them ("KNEAD_SCANS or ../shared/scans").
struct DataFolders {
    std::vector<std::filesystem::path> folders;
    std::string words;
};

// Where `asked` is not empty (--scans DIR), that folder alone. Else the folder in KNEAD_SCANS, if it is set,
// then ../shared/scans seen from the working folder and from the checkout that the running binary lies in.
DataFolders scan_folders(const std::string& asked);

// The same for the survey shapes: --survey, KNEAD_SURVEY, ../shared/survey.
DataFolders survey_folders(const std::string& asked);

// The first of the folders that has the file, or nothing.
std::optional<std::filesystem::path> find_data_file(const DataFolders& folders, std::string_view name);

// "no dragon.ply in KNEAD_SCANS or ../shared/scans".
std::string missing_words(const DataFolders& folders, std::string_view name);

// The files with this extension (".ply") in the first folder that has any, by name.
std::vector<std::filesystem::path> data_files(const DataFolders& folders, std::string_view extension);

} // namespace knead
