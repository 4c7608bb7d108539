#include "edit/standing_acts.h"

namespace knead {

namespace {

void move_last(std::vector<StandingAct>& from, std::vector<StandingAct>& to) {
    if (from.empty()) return;
    to.push_back(from.back());
    from.pop_back();
}

} // namespace

bool is_act(const SessionAction& action) {
    return !std::holds_alternative<UndoLine>(action) && !std::holds_alternative<RedoLine>(action) &&
           !std::holds_alternative<CheckLine>(action);
}

StandingActs acts_after(std::span<const SessionLine> lines) {
    StandingActs acts;
    for (const SessionLine& line : lines) {
        if (std::holds_alternative<UndoLine>(line.action)) move_last(acts.done, acts.undone);
        if (std::holds_alternative<RedoLine>(line.action)) move_last(acts.undone, acts.done);
        if (!is_act(line.action)) continue;
        acts.done.push_back({++acts.count, &line});
        acts.undone.clear();
    }
    return acts;
}

} // namespace knead
