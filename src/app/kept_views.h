#pragma once
// From where sessions were looked at when they were left, beside the files that were opened last: a text file
// in the user's state folder, newest first.

#include "view/camera.h"

#include <filesystem>
#include <optional>

namespace knead {

// Nothing where none was kept, or where it cannot be read.
std::optional<Camera> kept_view(const std::filesystem::path& session);

// What cannot be written is silently not kept.
void keep_view(const std::filesystem::path& session, const Camera& camera);

// Forgets all of them.
void forget_views();

} // namespace knead
