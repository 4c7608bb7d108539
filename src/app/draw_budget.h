#pragma once
// How much a frame may draw so that the window follows the hand.

#include <algorithm>
#include <cstddef>

namespace knead {

// Follows the measured time of frames: where one took longer than it should, the next draws fewer points.
// Where that is not enough, as when the picture's pixels themselves take too long in software, moving
// pictures are drawn with half as many pixels each way.
struct DrawBudget {
    static constexpr std::size_t least = 15'000, most = 20'000'000;
    static constexpr std::size_t plenty = 150'000; // coarse and as many points: fine ones have a chance again
    static constexpr double target = 1.0 / 36;     // seconds of a frame, a little better than 30 a second

    std::size_t points = 100'000;
    bool coarse = false; // moving pictures

    // A picture of something that moves, in which so many points were drawn, took so long, everything
    // included.
    void learn(std::size_t drawn, double seconds) {
        // A picture that was not as full as it might have been says nothing about fuller ones.
        const bool was_full = drawn * 10 >= points * 8;
        if (!was_full && seconds < target) {
            if (coarse && seconds < 0.4 * target) coarse = false;
            return;
        }
        const double factor = std::clamp(target / std::max(seconds, 1e-4), 0.6, 1.2);
        const auto next = static_cast<std::size_t>(static_cast<double>(std::min(points, drawn)) * factor);
        points = std::clamp(next, least, most);
        if (!coarse && points < 2 * least && seconds > 1.2 * target) coarse = true;
        if (coarse && points > plenty) {
            coarse = false;
            points /= 3;
        }
    }
};

} // namespace knead
