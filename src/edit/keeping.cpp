#include "edit/keeping.h"

#include <limits>

namespace knead {

std::size_t least_missed(std::span<const std::size_t> places, std::size_t needed, std::size_t now) {
    std::size_t least = 0;
    double least_loss = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i] == needed) continue;
        const std::size_t before = i > 0 ? places[i - 1] : 0;
        const std::size_t distance = places[i] < now ? now - places[i] : places[i] - now;
        const double loss = static_cast<double>(places[i] - before) / static_cast<double>(distance + 1);
        if (loss < least_loss) {
            least_loss = loss;
            least = i;
        }
    }
    return least;
}

} // namespace knead
