#pragma once
// A loop over many like pieces of work that reports how far it is.

#include "base/progress.h"
#include "base/workers.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace knead {

// A stage's name and the part of it, 0 … 1, that a loop makes up.
struct StagePart {
    std::string_view name;
    double begin = 0;
    double end = 1;
};

// Calls work(i) for i in 0 … count on all workers, in about 32 batches, with a report after each.
template<typename Work>
void staged_loop(Workers& workers, Progress& progress, const StagePart& part, std::size_t count,
                 Work&& work) {
    constexpr std::size_t batches = 32;
    const std::size_t batch = (count + batches - 1) / batches;
    const std::size_t grain = std::clamp<std::size_t>(batch / 64, 1, 1024);
    progress.step(part.name, part.begin);
    for (std::size_t begin = 0; begin < count; begin += batch) {
        const std::size_t end = std::min(count, begin + batch);
        workers.for_each(end - begin, grain, [&](std::size_t i) { work(begin + i); });
        const double done = static_cast<double>(end) / static_cast<double>(count);
        progress.step(part.name, part.begin + (part.end - part.begin) * done);
    }
}

} // namespace knead
