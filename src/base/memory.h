#pragma once
// How much memory this process holds, in bytes, as Linux counts it; 0 where it does not say.

#include <cstdint>

namespace knead {

// Now, and at most since the program began or since forget_peak_memory().
std::uint64_t resident_memory();
std::uint64_t peak_memory();

// Gives the system back what was freed and is kept for later by malloc: after much work that is not done soon
// again. Takes some milliseconds.
void give_back_freed_memory();

// Does so, and begins the peak again with what is held now. Returns whether
// Linux lets it; else the peak stays what it was.
bool forget_peak_memory();

} // namespace knead
