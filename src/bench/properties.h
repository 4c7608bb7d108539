#pragma once
// What has to hold on every cloud: rigid motions stay rigid, nothing moves by itself, turns are kept, and the
// same input gives the same bytes.

#include "base/progress.h"
#include "cloud/point_cloud.h"

#include <cstddef>
#include <string>
#include <vector>

namespace knead {

class Upsampler;
class Workers;

// How far a rigid motion of all handles may leave a point behind, over D: made at once, by rounding to floats
// alone, and where the handles went one after the other, by what settling leaves.
inline constexpr double rigid_bar = 3e-7, rigid_in_turns_bar = 1e-5;

// One cloud with automatic_handles() and 1000 samples.
struct CloudProperties {
    std::string name;
    std::size_t points = 0;
    std::size_t strays = 0;    // points in parts without a handle, which stay and do not count below
    double rigid = 0;          // both handles moved alike in one frame: the largest deviation over D
    double rigid_in_turns = 0; // one handle after the other, then settled
    std::size_t iterations_in_turns = 0;
    std::size_t moved_by_nothing = 0; // points whose bytes changed when the handles stayed
    double handle_error = 0;          // of a bend by 30°, over D
    bool same_again = false;          // the bend's bytes, a second time
    bool same_for_threads = false;    // and on 1 thread and on 2
};

// `device` is what make_upsampler() takes; `threads` 0: one a core.
CloudProperties evaluate_cloud(const std::string& name, const PointCloud& cloud, const std::string& device,
                               unsigned threads, Progress& progress);

// A bar of 1 : 1 : 10, twisted about its long axis by 720°, 10° and 3 iterations a frame.
struct TwistResult {
    std::size_t points = 0;
    double asked = 0;    // degrees
    double measured = 0; // after the last frame, degrees, from slice to slice along the bar
    double uneven = 0;   // then: the largest distance of a slice from an even twist between the handles
    double settled = 0;  // measured again after 100 iterations more
    double settled_uneven = 0;
};
TwistResult evaluate_twist(Workers& workers, Upsampler& upsampler, Progress& progress);

// The turn of thin slices about the z axis, degrees, between rest and pose, in the order of z: the first in
// -180…180, each other within 180 of the one before it. Both 3n, about that axis; `slices` of equal height
// share the cloud. A slice without points takes the turn of the one before.
std::vector<double> turns_along_z(std::span<const float> rest, std::span<const float> posed,
                                  std::size_t slices);

} // namespace knead
