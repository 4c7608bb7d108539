#pragma once
// An always-on check of what the code itself promises. A failure is a bug in knead, never the user's doing.

#include <stdexcept>
#include <string>

namespace knead {

class BrokenInvariant : public std::logic_error {
public:
    using std::logic_error::logic_error;
};

// The place is the caller's: clang-tidy 14 has no std::source_location.
inline void require(bool holds, const char* words, const char* file = __builtin_FILE(),
                    int line = __builtin_LINE()) {
    if (!holds) [[unlikely]]
        throw BrokenInvariant(std::string(file) + ":" + std::to_string(line) + ": " + words);
}

} // namespace knead
