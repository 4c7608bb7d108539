#pragma once
// What helps against an error, for whoever sits before the window.

#include "base/error.h"

#include <string>

namespace knead {

// The words of an error, and where these leave out what helps, that. A session without its cloud needs none:
// the window asks for the cloud (Editor::without_cloud).
inline std::string words_in_window(const std::exception& error) {
    const auto* told = dynamic_cast<const Error*>(&error);
    const bool is_session = told && told->cure() == Cure::open_session;
    return std::string(error.what()) + (is_session ? "; Ctrl+O opens it" : "");
}

} // namespace knead
