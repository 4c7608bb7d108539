#pragma once
// Words about what went wrong, and what helps against it, for whoever sits before the window.

#include <exception>
#include <string>

namespace knead {

inline constexpr const char* mistake_in_knead = "This is a mistake in knead";
inline constexpr const char* no_memory = "There is not enough memory for this.";

// The words of an error, and where these leave out what helps, that. A session without its cloud needs none:
// the window asks for the cloud (Editor::without_cloud).
std::string words_in_window(const std::exception& error);

// The same of the exception that is being handled, whatever it is.
std::string words_about_exception();

} // namespace knead
