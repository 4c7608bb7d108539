#pragma once
// How many points a picture of something that moves may have so that the window follows the hand.

#include <algorithm>
#include <cstddef>

namespace knead {

// Learns what a point costs and what all the rest of a picture does, each as a sluggish mean, and lets as
// many points be drawn as fit into the time between two pictures. Orbiting and dragging, beside which a shape
// is solved, cost differently: each has a budget of its own.
//
// Only where the fewest points are too many, again and again, pictures get half as many pixels each way; then
// full ones are tried again now and then, and the less often the more often that failed.
class DrawBudget {
public:
    static constexpr std::size_t least = 60'000, most = 20'000'000;

    // `target`: seconds of a picture.
    explicit DrawBudget(double target) : target_(target) {}

    std::size_t points() const { return points_; }
    bool coarse() const { return coarse_; }

    // A picture, with so many points, took so long altogether, and the points so much of that.
    void learn(std::size_t drawn, double of_points, double altogether) {
        if (drawn == 0) return;
        const double one = of_points / static_cast<double>(drawn);
        observe(one_point_, one);
        observe(rest_, altogether - of_points);
        const double fits = (target_ - rest_) / std::max(one_point_, 1e-12);
        const auto wanted =
            static_cast<std::size_t>(std::clamp(fits, static_cast<double>(least), static_cast<double>(most)));
        // Other points are seen as a flicker: for a little more it is not worth it.
        if (wanted > points_ + points_ / 6 || wanted < points_ - points_ / 12) points_ = wanted;
        judge_pixels(altogether);
    }

private:
    // One picture in seven counts, and none, when something else took the processor, for more than double.
    static void observe(double& mean, double value) {
        mean = mean > 0 ? mean + 0.15 * (std::clamp(value, 0.5 * mean, 2 * mean) - mean) : value;
    }

    void judge_pixels(double altogether) {
        const bool late = points_ == least && altogether > 1.5 * target_;
        late_ = late ? late_ + 1 : 0;
        if (!coarse_ && late_ >= 8) return change_pixels();
        if (coarse_ && ++coarse_pictures_ >= coarse_for_) {
            coarse_for_ = std::min(2 * coarse_for_, 1000);
            change_pixels();
        }
    }

    // What was learnt is of other pixels.
    void change_pixels() {
        coarse_ = !coarse_;
        late_ = coarse_pictures_ = 0;
        one_point_ = rest_ = 0;
        points_ = least;
    }

    double target_;
    double one_point_ = 0, rest_ = 0; // seconds
    std::size_t points_ = 100'000;
    bool coarse_ = false;
    int late_ = 0;            // pictures in a row
    int coarse_pictures_ = 0; // since they are
    int coarse_for_ = 60;     // so many, until full ones are tried
};

} // namespace knead
