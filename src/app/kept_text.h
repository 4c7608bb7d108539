#pragma once
// Small texts that the window keeps from one run to the next, in the user's state folder.

#include <filesystem>
#include <string_view>

namespace knead {

// Where the text of this name is kept; empty where no state folder is known.
std::filesystem::path kept_file(const char* name);

// Writes it. What cannot be written is silently not kept: it is a convenience, and nothing of the user's
// work.
void keep_text(const char* name, std::string_view text);

} // namespace knead
