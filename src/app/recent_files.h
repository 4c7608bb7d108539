#pragma once
// The files that were opened last, and sessions whose number of samples is chosen by itself, which the
// sessions themselves have no word for: text files in the user's state folder, a path a line, newest first.

#include <filesystem>
#include <vector>

namespace knead {

// Nothing where it cannot be read. Files that are gone are left out.
std::vector<std::filesystem::path> read_recent_files();

// Puts a file in front and writes the list; a list that cannot be written is silently not kept.
void remember_file(std::vector<std::filesystem::path>& recent, const std::filesystem::path& file);
// All that is kept of files, views (kept_views.h) included.
void forget_files(std::vector<std::filesystem::path>& recent);

// Whether a session was saved last while its number of samples was chosen by itself. What cannot be read is
// no, and what cannot be written is silently not kept.
bool chose_samples(const std::filesystem::path& session);
void remember_choosing(const std::filesystem::path& session, bool chooses);

} // namespace knead
