#pragma once
// Where labels go that stand beside things in a picture, so that none lies on another or on what is in the
// way.

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace knead {

struct LabelBox {
    glm::dvec2 lowest{0.0}, highest{0.0};
    bool overlaps(const LabelBox& other) const;
    bool contains(const LabelBox& other) const;
};

struct Label {
    glm::dvec2 anchor{0.0}; // what it names, a pixel
    glm::dvec2 size{0.0};
    double rise = 0; // it would rather be so far above its anchor, from middle to middle
};

struct PlacedLabel {
    bool shown = false; // whether a place was found
    LabelBox box;
    bool is_led = false; // it lies away from its anchor: a line from `foot`, on its border, is to lead there
    glm::dvec2 foot{0.0};
};

// Places the labels one after the other, so the first ones have the choice: where they would rather be, or as
// near as there is room, within `bounds` and off the obstacles. Labels whose anchor lies out of bounds are
// not shown.
std::vector<PlacedLabel> lay_out_labels(std::span<const Label> labels, std::span<const LabelBox> obstacles,
                                        const LabelBox& bounds);

} // namespace knead
