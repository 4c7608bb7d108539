#pragma once
// What a hand does to a handle in one drag: a rotation by any number of turns, a scaling and a shift, about a
// pivot.

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <numbers>

namespace knead {

// p → pivot + Q S (p - pivot) + shift, with Q the rotation by `angle` about `axis` and S the scaling along
// `axes`. It comes on top of the pose that the handle had when the drag began.
struct Transform {
    glm::dvec3 pivot{0.0};
    glm::dvec3 shift{0.0};
    glm::dvec3 axis{0.0, 0.0, 1.0}; // unit
    double angle = 0;               // radians; 4π is two whole turns, not none
    glm::dvec3 scale{1.0};          // along `axes`
    glm::dquat axes{1, 0, 0, 0};

    bool operator==(const Transform&) const = default;
};

glm::dvec3 transformed(const Transform& transform, const glm::dvec3& point);
// Whether two do the same, or one does nothing: they may be written in more than one way.
bool do_the_same(const Transform& a, const Transform& b);
bool does_nothing(const Transform& transform);

// By less a handle is not scaled: to nothing, or inside out.
inline constexpr double least_factor = 0.01;

// At once a handle turns by no more than this, and half a turn, in radians: twenty turns.
inline constexpr double most_turned = 40 * std::numbers::pi;
// Beyond that a typed angle keeps so many turns and what is left over of a whole one, half a turn at most
// either way: nobody means the others. 0 for one that is not finite.
double within_turns(double angle);

} // namespace knead
