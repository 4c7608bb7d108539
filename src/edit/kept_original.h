#pragma once
// A copy of the file that a cloud was read from, for when something else is to take its place: sessions that
// were recorded on it need it as it was.

#include "base/progress.h"

#include <filesystem>

namespace knead {

// The name of such a copy beside the file, under which nothing lies yet: "bunny-original.ply", or
// "bunny-original-2.ply".
std::filesystem::path name_of_original(const std::filesystem::path& cloud);

// Copies the file to there, wholly or not at all. Throws Error (input) where it cannot be read, Error
// (output) where the copy cannot be written, and Cancelled.
void keep_original(const std::filesystem::path& cloud, const std::filesystem::path& copy, Progress& progress);

} // namespace knead
