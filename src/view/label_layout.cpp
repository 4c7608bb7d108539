#include "view/label_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace knead {

namespace {

constexpr double gap = 3; // pixels between labels
constexpr int rings = 7;  // of places around the one that a label would rather have
constexpr int places_on_ring = 12;

LabelBox box_about(glm::dvec2 middle, glm::dvec2 size) {
    const glm::dvec2 corner = glm::round(middle - 0.5 * size);
    return {corner, corner + size};
}

bool is_free(const LabelBox& box, std::span<const LabelBox> taken, const LabelBox& bounds) {
    const LabelBox wide{box.lowest - gap, box.highest + gap};
    return bounds.contains(box) &&
           std::ranges::none_of(taken, [&](const LabelBox& other) { return wide.overlaps(other); });
}

// The nearest free place around `wished`, above and below before left and right.
std::optional<LabelBox> free_place(const Label& label, std::span<const LabelBox> taken,
                                   const LabelBox& bounds) {
    const glm::dvec2 wished = label.anchor - glm::dvec2(0, label.rise);
    if (const LabelBox box = box_about(wished, label.size); is_free(box, taken, bounds)) return box;
    for (int ring = 1; ring <= rings; ++ring)
        for (int k = 0; k < places_on_ring; ++k) {
            // 0, 1, -1, 2, -2 … steps from straight up
            const int step = k % 2 ? (k + 1) / 2 : -k / 2;
            const double angle = 2 * std::numbers::pi * step / places_on_ring;
            // Labels are wide: sideways they go farther.
            const glm::dvec2 way(std::sin(angle) * 0.5 * (label.size.x + label.size.y),
                                 -std::cos(angle) * label.size.y);
            const LabelBox box = box_about(wished + (ring + 0.25) * way, label.size);
            if (is_free(box, taken, bounds)) return box;
        }
    return std::nullopt;
}

} // namespace

bool LabelBox::overlaps(const LabelBox& other) const {
    return lowest.x < other.highest.x && other.lowest.x < highest.x && lowest.y < other.highest.y &&
           other.lowest.y < highest.y;
}

bool LabelBox::contains(const LabelBox& other) const {
    return lowest.x <= other.lowest.x && lowest.y <= other.lowest.y && highest.x >= other.highest.x &&
           highest.y >= other.highest.y;
}

std::vector<PlacedLabel> lay_out_labels(std::span<const Label> labels, std::span<const LabelBox> obstacles,
                                        const LabelBox& bounds) {
    std::vector<LabelBox> taken(obstacles.begin(), obstacles.end());
    std::vector<PlacedLabel> placed(labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const Label& label = labels[i];
        if (!bounds.contains({label.anchor, label.anchor})) continue;
        const std::optional<LabelBox> box = free_place(label, taken, bounds);
        if (!box) continue;
        taken.push_back(*box);
        const glm::dvec2 foot = glm::clamp(label.anchor, box->lowest, box->highest);
        placed[i] = {true, *box, foot != label.anchor, foot};
    }
    return placed;
}

} // namespace knead
