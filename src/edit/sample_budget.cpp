#include "edit/sample_budget.h"

#include <algorithm>

namespace knead {

std::size_t base_samples(std::size_t asked, std::size_t handles) {
    const std::size_t beyond = handles - std::min(handles, asked / 5);
    return asked - std::min(beyond, asked / 2);
}

std::size_t handle_budget(std::size_t asked, std::size_t base_samples) {
    return asked + asked / 5 - base_samples;
}

} // namespace knead
