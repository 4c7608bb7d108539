#pragma once
// How the samples that are asked for are shared out: base samples, which stay while handles come and go, and
// those that handles add on their borders. Both together are up to 1.2 times as many.

#include <cstddef>

namespace knead {

// Handles may add 0.2 times as many as are asked for, which is more than one each unless there are very many
// of them: those beyond that take the place of base samples, down to half of what is asked for.
std::size_t base_samples(std::size_t asked, std::size_t handles);

// What handles may add to so many base samples.
std::size_t handle_budget(std::size_t asked, std::size_t base_samples);

} // namespace knead
