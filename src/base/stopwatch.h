#pragma once
// Elapsed wall-clock time.

#include <chrono>

namespace knead {

class Stopwatch {
public:
    // Seconds since construction or the last restart.
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

    // Seconds since then, and starts again from zero.
    double lap() {
        const Clock::time_point now = Clock::now();
        const double elapsed = std::chrono::duration<double>(now - start_).count();
        start_ = now;
        return elapsed;
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

} // namespace knead
