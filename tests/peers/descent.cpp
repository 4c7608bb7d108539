#include "peers/descent.h"

#include "base/require.h"
#include "bench/deviation.h"

#include <algorithm>

namespace knead::peers {

bool is_stop(std::size_t iterations) {
    return iterations <= 100 || iterations % (iterations / 50) == 0;
}

Arrivals arrivals_of(const Descent& descent, double bar, double diagonal) {
    require(!descent.stops.empty(), "a descent that took place");
    const Stop& end = descent.stops.back();
    const std::size_t tenth_begins = end.iterations - end.iterations / 10;
    Arrivals result;
    std::optional<Arrival>* const sought[] = {&result.rms, &result.largest};
    bool within[] = {true, true};
    for (auto stop = descent.stops.rbegin(); stop != descent.stops.rend(); ++stop) {
        const Deviation away = deviation_between(stop->positions, end.positions, diagonal);
        if (stop->iterations >= tenth_begins) result.last_tenth = std::max(result.last_tenth, away.largest);
        const double distances[] = {away.rms, away.largest};
        for (const std::size_t which : {0, 1}) {
            within[which] = within[which] && distances[which] <= bar;
            const bool tells = descent.at_rest || stop->iterations < tenth_begins;
            if (within[which] && tells) *sought[which] = Arrival{stop->iterations, stop->seconds};
        }
    }
    return result;
}

} // namespace knead::peers
