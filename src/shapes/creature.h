#pragma once
// The creature as a signed distance field with colours: a tabby cat that stands on two legs, its arms held
// out. shapes/shapes.h says where its parts are.
//
// Its parts are round cones and rounded triangles (the exact distances of Inigo Quilez,
// https://iquilezles.org/articles/distfunctions), joined by the quadratic smooth minimum
// (https://iquilezles.org/articles/smin), which blends no farther than its width: parts that are farther than
// that from the nearest one are left out by their bounding spheres without changing the field.

#include "shapes/scanner.h"

#include <array>
#include <vector>

namespace knead {

enum class BodyPart { body, head, ear, muzzle, nose, eye, arm, leg, tail };

// A cone between two balls; a ball when both ends are one.
struct RoundCone {
    Vec3d from = Vec3d::Zero();
    Vec3d to = Vec3d::Zero();
    double from_radius = 0;
    double to_radius = 0;
};

// A triangle with thickness.
struct RoundTriangle {
    std::array<Vec3d, 3> corners{Vec3d::Zero(), Vec3d::Zero(), Vec3d::Zero()};
    double radius = 0;
};

struct CreaturePiece {
    BodyPart part = BodyPart::body;
    bool is_cone = true;
    RoundCone cone;
    RoundTriangle triangle;
    double blend = 0;      // width of the smooth minimum with the pieces before
    double along_from = 0; // how far along its limb the piece begins and ends, 0 … 1
    double along_to = 0;
};

struct Ball {
    Vec3d middle = Vec3d::Zero();
    double radius = 0;
};

// Pieces first … end - 1 and a ball around them all.
struct PieceGroup {
    std::size_t first = 0;
    std::size_t end = 0;
    Ball around;
    double widest_blend = 0;
};

struct Creature {
    std::vector<CreaturePiece> pieces;
    std::vector<Ball> around; // each piece
    std::vector<PieceGroup> groups;
};

Creature make_creature();

// Signed distance to its surface, exact but for the blends, where it is a lower bound of the amount.
double creature_distance(const Creature& creature, const Vec3d& place);

// The piece whose own surface is nearest.
struct NearestPiece {
    const CreaturePiece* piece = nullptr;
    double along = 0; // the nearest place on its limb, 0 … 1
};
NearestPiece nearest_piece(const Creature& creature, const Vec3d& place);

// The fur, eyes and so on at a point of the surface.
Colour creature_colour(const Creature& creature, const Vec3d& place, const Vec3d& normal);

// The area of its surface in square units, measured (tests/shapes/creature_test.cpp measures again).
inline constexpr double creature_area = 4.65;

// The creature for scanning, with a box around it; it holds the creature itself.
ScannedBody creature_body();

// Where the scanner stands: eight places around, the front ones closer and sharper, and none below.
std::vector<Viewpoint> creature_viewpoints();

} // namespace knead
