#pragma once
// Pictures as PNG files.

#include "render/headless.h"

#include <filesystem>

namespace knead {

// Writes an RGB picture, under a temporary name first and renamed when it is complete. Throws Error (output).
void write_png(const std::filesystem::path& path, const Picture& picture);

} // namespace knead
