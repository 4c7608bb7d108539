#pragma once
// Points, influences and motions to upsample, and the answer in double.

#include "upsample/upsample.h"

#include <vector>

namespace knead::test {

struct Scene {
    std::vector<float> positions;
    std::vector<float> normals;
    std::vector<Index> mover;
    InfluenceRows rows;
    InfluenceWeights weights = InfluenceWeights::smooth;
    std::vector<Vec3d> places; // of samples
    std::vector<Motion> motions;

    UpsampleInput input() const { return {positions, normals, mover, &rows, weights, places}; }
};

struct Posed {
    std::vector<float> positions;
    std::vector<float> normals;

    bool
    operator==(const Posed&) const = default; // equal values: for finite ones, all bits but a zero's sign
};

// Positions in [-1, 1]^3, unit normals, narrow rows of random distances (every fourth with one sample, others
// with five, with a sample right at the point, or with all of them equally far), every seventh point moved by
// one motion alone, rotations of any angle with a shift of up to 1; the last fifth of the motions are
// handles.
Scene random_scene(std::size_t points, std::size_t motions, unsigned seed, bool with_normals = true);

// The motion that takes p to M p + shift.
Motion motion_of(const Mat3d& linear, const Vec3d& shift);

// One prepare() and one run().
Posed upsampled(Upsampler& upsampler, const Scene& scene);

// The header's formulas in double: p', and cof(...) n before it gets its length back.
Vec3d exact_position(const Scene& scene, std::size_t point);
Vec3d exact_turned(const Scene& scene, std::size_t point);

// The i-th vector of a packed array.
Vec3d at(const std::vector<float>& packed, std::size_t i);

} // namespace knead::test
