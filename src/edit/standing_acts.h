#pragma once
// Which lines of a session stand at the end, once undo and redo have been carried out.

#include "edit/session.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace knead {

// Whether it does something of its own that can be undone: neither goes back or forth, nor checks.
bool is_act(const SessionAction& action);

struct StandingAct {
    std::uint64_t number = 0; // among all acts there ever were, from 1
    const SessionLine* line = nullptr;
};

struct StandingActs {
    std::vector<StandingAct> done;   // in the order in which they were
    std::vector<StandingAct> undone; // what could be redone, the next one last
    std::uint64_t count = 0;         // of all acts there ever were
};

// What the lines, which it points to, lead to. Where there is nothing to undo or to redo, such a line does
// nothing.
StandingActs acts_after(std::span<const SessionLine> lines);

} // namespace knead
