#pragma once
// How many samples suit a cloud, its handles and this machine: the rule behind "automatic" in the editor. A
// session only ever says a number; this is one way to come to it.
//
// The number is the least that looks like every point a sample, or less where the machine cannot move as many
// while it follows the hand:
//   - 2000 leave no more of the diagonal than 1000 do, 0.11 % on the survey's shapes and on scans of bodies
//     (README, "Measured"), about a pixel of a cloud that fills the view;
//   - many, small and crowded handles ask for more, see HandleSpread;
//   - no more than 1000 or a fourth of the points, whichever is more, and up to 1000 points all of them;
//   - a frame, its iterations and the upsampling, is to take 25 ms.
// Every choice is a rung of 200, 500, 1000, 2000 … 20,000, or every point.

#include "edit/handle_spread.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace knead {

// Seconds of a frame that follows the hand, as measured.
struct FrameCost {
    std::uint64_t samples = 0; // that it had, > 0: as many as were asked for, or all points
    double solving = 0;        // its start and all its iterations
    double upsampling = 0;
};

// Whether one tells of a faster machine than the other, where both had as many iterations.
bool is_faster(const FrameCost& one, const FrameCost& other);

struct SampleNeeds {
    std::size_t points = 0;        // of different positions
    HandleSpread handles;          // what is known of them
    std::optional<FrameCost> cost; // nothing yet: no machine is too slow
};

// What decided the number.
enum class SampleReason { few_points, points, enough, handles, machine };

struct SampleChoice {
    std::optional<std::uint64_t> samples = 2000; // as in Settings; nothing: every point
    SampleReason reason = SampleReason::enough;
    bool operator==(const SampleChoice&) const = default;
};

// Of the needs alone: more points, more demanding handles and a faster machine never lead to fewer samples.
SampleChoice choose_samples(const SampleNeeds& needs);

// The same where there is a number already. A rung stays as long as it would be chosen if all that speaks for
// or against it were `calm` times more or less, so that a choice that was followed is not soon another.
inline constexpr double calm = 1.4;
SampleChoice choose_samples_again(const SampleNeeds& needs, std::optional<std::uint64_t> now);

} // namespace knead
