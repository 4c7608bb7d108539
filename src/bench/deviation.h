#pragma once
// How far two poses of one cloud are apart, two poses of two clouds of one surface, and how evenly a pose
// stretches the links between neighbours.

#include "cloud/point_cloud.h"

#include <span>
#include <vector>

namespace knead {

class Pipeline;
class Workers;

// Between two poses, in units of D, the diagonal of the bounding box at rest.
struct Deviation {
    double rms = 0;
    double largest = 0;
};

// Two poses of one cloud, both 3n; points that are not finite at rest must not be counted, so they have to be
// equal in both. `diagonal` of 0 leaves the cloud's units.
Deviation deviation_between(std::span<const float> a, std::span<const float> b, double diagonal);

// A cloud at rest and posed, both 3n about the same origin; the first `points` of them count.
struct PosedCloud {
    std::span<const float> rest, posed;
    std::size_t points = 0;
};

// Two samplings of one surface, posed alike: where the points of `a` went, from where `b` says that they
// went. That is told by the point of `b` that is nearest at rest, and by how it and the eleven next to it
// turned: without the turn, two points that lie half a spacing apart would seem to go different ways. The
// same fields of two samplings come out as zero up to the square of the spacing over the radius of the bend.
// Neither is empty; O(a · b).
Deviation field_deviation(const PosedCloud& a, const PosedCloud& b, double diagonal, Workers& workers);

// How uneven a pose is from point to point: the rms of log(length posed / length at rest) over the links of
// the pipeline's graph that have a free end in a part that a handle holds. `posed`: 3n in the order of the
// pipeline. 0 where there is no such link.
double link_noise(const Pipeline& pipeline, std::span<const float> posed);

// How many times as uneven few samples may be as the full solution.
inline constexpr double noise_bar = 1.2;

} // namespace knead
