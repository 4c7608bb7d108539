#include "base/workers.h"

#include "base/require.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace knead {

namespace {

// How often a waiting thread looks before it sleeps: some ten microseconds, the pause between the loops of
// one stage. Waking a sleeper takes several times as long.
constexpr int looks_before_sleep = 1000;

// A gate that is open lets workers in.
constexpr std::uint32_t open = std::uint32_t{1} << 31U;

template<typename Condition>
bool comes_soon(Condition&& condition) {
    for (int look = 0; look < looks_before_sleep; ++look) {
        if (condition()) return true;
#if defined(__x86_64__)
        __builtin_ia32_pause();
#endif
    }
    return false;
}

} // namespace

struct Workers::State {
    std::vector<std::thread> threads;
    std::mutex mutex;
    std::condition_variable wake;
    std::condition_variable finished;

    // The job at hand; written while the gate is closed and nobody is inside, and published by opening it.
    Call call = nullptr;
    void* context = nullptr;
    std::size_t count = 0;
    std::size_t grain = 1;
    std::exception_ptr failure; // under the mutex
    std::atomic<unsigned long> job{0};
    std::atomic<std::uint32_t> gate{0}; // whether it is open, and how many workers are inside
    std::atomic<bool> stopping{false};
    std::atomic<std::size_t> next_chunk{0};

    void work_through() {
        const std::size_t chunks = (count + grain - 1) / grain;
        for (;;) {
            const std::size_t chunk = next_chunk.fetch_add(1, std::memory_order_relaxed);
            if (chunk >= chunks) return;
            try {
                call(context, chunk * grain, std::min(count, (chunk + 1) * grain));
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (!failure) failure = std::current_exception();
                next_chunk.store(chunks, std::memory_order_relaxed);
            }
        }
    }

    // Into the job at hand, if that is not over.
    bool enter() {
        std::uint32_t seen = gate;
        while (seen & open)
            if (gate.compare_exchange_weak(seen, seen + 1)) return true;
        return false;
    }

    void leave() {
        if (gate.fetch_sub(1) != 1) return; // somebody is inside, or the gate is open
        const std::lock_guard lock(mutex);  // so that the caller is either asleep by now, or looks again
        finished.notify_one();
    }

    void worker_loop() {
        unsigned long done = 0;
        for (;;) {
            const auto called = [&] { return stopping || job != done; };
            if (!comes_soon(called)) {
                std::unique_lock lock(mutex);
                wake.wait(lock, called);
            }
            if (stopping) return;
            done = job;
            if (!enter()) continue;
            work_through();
            leave();
        }
    }
};

Workers::Workers(unsigned threads) : state_(std::make_unique<State>()) {
    if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
    state_->threads.reserve(threads - 1);
    try {
        for (unsigned i = 1; i < threads; ++i)
            state_->threads.emplace_back([this] { state_->worker_loop(); });
    } catch (const std::exception&) {
        // The system has no more of them, or no memory for one: those that there are do.
    }
}

Workers::~Workers() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->stopping = true;
    }
    state_->wake.notify_all();
    for (std::thread& thread : state_->threads) thread.join();
}

unsigned Workers::threads() const {
    return static_cast<unsigned>(state_->threads.size()) + 1;
}

void Workers::run(std::size_t count, std::size_t grain, Call call, void* context) {
    require(grain > 0, "a chunk needs at least one index");
    if (count == 0) return;
    State& state = *state_;
    if (state.threads.empty() || count <= grain) {
        for (std::size_t begin = 0; begin < count; begin += grain)
            call(context, begin, std::min(count, begin + grain));
        return;
    }
    require(state.gate == 0, "parallel loops do not nest");
    state.call = call;
    state.context = context;
    state.count = count;
    state.grain = grain;
    state.next_chunk.store(0, std::memory_order_relaxed);
    state.gate = open;
    {
        const std::lock_guard lock(state.mutex);
        ++state.job;
    }
    state.wake.notify_all();
    state.work_through();
    // Whoever has not come by now has nothing left to do here, and is not waited for: where other programs or
    // the drawing keep the cores busy that may be long.
    state.gate.fetch_and(~open);
    const auto all_done = [&] { return state.gate == 0; };
    if (!comes_soon(all_done)) {
        std::unique_lock lock(state.mutex);
        state.finished.wait(lock, all_done);
    }
    if (state.failure) std::rethrow_exception(std::exchange(state.failure, nullptr));
}

} // namespace knead
