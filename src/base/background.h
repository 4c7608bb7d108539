#pragma once
// A thread of its own for work that goes on beside the caller's.

#include <functional>
#include <thread>

namespace knead {

// Runs `work` on a new thread, and joins it when destroyed: whoever ends a Background first tells its work to
// stop. `work` must not throw.
class Background {
public:
    explicit Background(std::function<void()> work) : thread_(std::move(work)) {}
    ~Background() { thread_.join(); }
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

private:
    std::thread thread_;
};

} // namespace knead
