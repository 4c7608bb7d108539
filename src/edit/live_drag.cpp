#include "edit/live_drag.h"

namespace knead {

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
