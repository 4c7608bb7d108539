#pragma once
// Whether the way to a pose matters: the same end by one frame, by ten and by a hundred; half a turn at once,
// where a quaternion does not say which way round; two whole turns in steps.

#include "bench/deviation.h"
#include "bench/survey.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace knead {

class Upsampler;
class Workers;

// How far apart the same end pose may come out, where the way to it is not ambiguous: the largest
// distance over D.
inline constexpr double turn_bar = 0.01;

// A twist may not slip by whole turns: what is left of it is as much as was asked, within so many degrees.
inline constexpr double twist_bar = 5;

// A task, and the way to its pose: every frame turns about the axis by as many degrees more, and goes on by
// as much of the translation.
struct Course {
    std::string name; // "tube, bent 120°"
    DeformationTask task;
    Vec3d axis = Vec3d::UnitZ();
    double degrees = 0;
    Vec3d translate = Vec3d::Zero(); // beside the turn about the task's pivot
    bool ambiguous = false;          // in one frame
    bool twists = false;             // about the cloud's own z axis
};

// One way, with 3 iterations a frame, beside the way with the most frames, settled.
struct TurnResult {
    std::string course;
    std::size_t points = 0;
    std::size_t frames = 0;
    Deviation at_last_frame, settled;
    bool aimed = true;          // false: one frame, and ambiguous
    std::size_t iterations = 0; // of settling
    bool at_rest = false;       // before the iterations ran out
    // Degrees from end to end along z, from slice to slice, once it settled; nothing if the course does not
    // twist.
    std::optional<double> asked_twist, twist;
};

// Goes the course once for every number of frames; the last number is the yardstick. 1000 samples.
std::vector<TurnResult> go_course(const Course& course, std::span<const std::size_t> frames, Workers& workers,
                                  Upsampler& upsampler, Progress& progress);

// All courses: a tube bent by 120° and 180°, a plane shifted, a bar twisted by 180° and 720°, and
// one of twice its length by 360° and 720°.
std::vector<TurnResult> evaluate_turns(Workers& workers, Upsampler& upsampler, Progress& progress);

} // namespace knead
