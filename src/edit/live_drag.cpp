#include "edit/live_drag.h"

#include "edit/way_back.h"

#include <algorithm>
#include <cmath>

namespace knead {

namespace {

double step_towards(double from, double to) {
    return from + std::clamp(to - from, -widest_turn, widest_turn);
}

// With its sign, which tells 300° from -60°.
glm::dquat turn_of(const Transform& transform) {
    return {std::cos(transform.angle / 2), std::sin(transform.angle / 2) * transform.axis};
}

bool is_one_step_off(const Transform& shown, const Transform& wanted) {
    return glm::dot(turn_of(shown), turn_of(wanted)) >= std::cos(widest_turn / 2);
}

} // namespace

Transform next_on_the_way(const Transform& shown, const Transform& wanted) {
    Transform next = wanted;
    if (shown.axis == wanted.axis || shown.angle == 0) {
        next.angle = step_towards(shown.angle, wanted.angle);
    } else if (!is_one_step_off(shown, wanted)) {
        next.angle = step_towards(shown.angle, 0);
        if (next.angle != 0) next.axis = shown.axis;
    }
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
