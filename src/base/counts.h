#pragma once
// Counts as people read them.

#include <cstddef>
#include <string>

namespace knead {

// "437,645".
std::string grouped(std::size_t count);

// "437,645 points", "1 point", for `thing` "point": of what takes an s.
std::string counted(std::size_t count, const std::string& thing);

} // namespace knead
