#include "edit/live_drag.h"

#include "edit/way_back.h"

#include <algorithm>

namespace knead {

Transform next_on_the_way(const Transform& shown, const Transform& wanted) {
    Transform next = wanted;
    const double from = shown.axis == wanted.axis || shown.angle == 0 ? shown.angle : 0;
    next.angle = from + std::clamp(wanted.angle - from, -widest_turn, widest_turn);
    return next;
}

void LiveProgress::report(std::string_view stage, double fraction) {
    shared_.with([&](LiveShared& shared) {
        shared.status.doing = stage;
        shared.status.fraction = fraction;
    });
}

bool LiveProgress::cancelled() const {
    return shared_.with([](const LiveShared& shared) { return shared.stop; });
}

} // namespace knead
