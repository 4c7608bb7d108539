#pragma once
// A value that two threads share: nobody reaches it without its lock.

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

namespace knead {

template<typename Value>
class Locked {
public:
    Locked() = default;
    explicit Locked(Value value) : value_(std::move(value)) {}

    // Calls use(value) under the lock and returns its result. Keep it short: the other side waits.
    template<typename Use>
    auto with(Use&& use) {
        const std::scoped_lock lock(mutex_);
        return std::forward<Use>(use)(value_);
    }
    template<typename Use>
    auto with(Use&& use) const {
        const std::scoped_lock lock(mutex_);
        return std::forward<Use>(use)(value_);
    }

    // The same, and wakes whoever waits in when().
    template<typename Change>
    auto change(Change&& change_value) {
        struct Wake {
            std::condition_variable& changed;
            ~Wake() { changed.notify_all(); }
        } const wake{changed_};
        return with(std::forward<Change>(change_value));
    }

    // Waits until ready(value) holds, then calls use(value) under the same lock.
    template<typename Ready, typename Use>
    auto when(Ready&& ready, Use&& use) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return ready(std::as_const(value_)); });
        return std::forward<Use>(use)(value_);
    }

    // Waits until ready(value) holds, but not longer than `seconds`.
    template<typename Ready>
    void wait(double seconds, Ready&& ready) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                          [&] { return ready(std::as_const(value_)); });
    }

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    Value value_{};
};

} // namespace knead
