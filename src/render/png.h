#pragma once
// Pictures as PNG files.

#include "base/whole_file.h"
#include "render/headless.h"

#include <filesystem>

namespace knead {

// Writes an RGB picture, under a temporary name first and renamed when it is complete. Throws Error (output).
void write_png(const std::filesystem::path& path, const Picture& picture);

// The same into a file that the caller commits.
void write_png(FileInTheMaking& file, const Picture& picture);

} // namespace knead
