#pragma once
// How a long stage tells how far it is, and learns that it should stop.

#include "base/error.h"

#include <string_view>

namespace knead {

// Implemented by whoever shows it: a bar in a terminal, a bar in the window, nothing in a test. Stages call
// it from one thread at a time, some hundred times in all.
class Progress {
public:
    virtual ~Progress() = default;

    // `stage` is a few words for the user ("finding neighbours"), `fraction` how much of the stage is done, 0
    // … 1.
    virtual void report(std::string_view stage, double fraction) = 0;

    // Whether the user asked to stop. May be called from any thread.
    virtual bool cancelled() const = 0;

    // Reports, and throws Cancelled if the user asked to stop.
    void step(std::string_view stage, double fraction) {
        report(stage, fraction);
        stop_if_cancelled();
    }

    void stop_if_cancelled() const {
        if (cancelled()) throw Cancelled();
    }
};

// Shows nothing and is never cancelled.
class SilentProgress final : public Progress {
public:
    void report(std::string_view /*stage*/, double /*fraction*/) override {}
    bool cancelled() const override { return false; }
};

} // namespace knead
