#pragma once
// From where sessions were looked at when they were left, which handle was chosen, and whether moves were
// mirrored, beside the files that were opened last: a text file in the user's state folder, newest first.

#include "view/camera.h"

#include <filesystem>
#include <optional>
#include <string>

namespace knead {

struct KeptView {
    Camera camera;
    std::optional<int> mirror_axis = {}; // across which moves are mirrored: 0 x, 1 y, 2 z
    std::string chosen = {};             // the handle; empty: none

    bool operator==(const KeptView&) const = default;
};

// Nothing where none was kept, or where it cannot be read.
std::optional<KeptView> kept_view(const std::filesystem::path& session);

// What cannot be written is silently not kept.
void keep_view(const std::filesystem::path& session, const KeptView& view);

// Forgets all of them.
void forget_views();

} // namespace knead
