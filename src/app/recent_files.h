#pragma once
// The files that were opened last: a text file in the user's state folder, a path a line, newest first.

#include <filesystem>
#include <vector>

namespace knead {

// Nothing where it cannot be read. Files that are gone are left out.
std::vector<std::filesystem::path> read_recent_files();

// Puts a file in front and writes the list; a list that cannot be written is silently not kept.
void remember_file(std::vector<std::filesystem::path>& recent, const std::filesystem::path& file);
void forget_files(std::vector<std::filesystem::path>& recent);

} // namespace knead
