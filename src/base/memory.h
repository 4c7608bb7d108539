#pragma once
// How much memory this process holds, in bytes, as Linux counts it; 0 where it does not say.

#include <cstdint>

namespace knead {

// Now, and at most since the program began or since forget_peak_memory().
std::uint64_t resident_memory();
std::uint64_t peak_memory();

// The peak begins again with what is held now. Where Linux does not let it, it stays what it was.
void forget_peak_memory();

} // namespace knead
