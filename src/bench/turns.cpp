#include "bench/turns.h"

#include "bench/posing.h"
#include "bench/properties.h"
#include "shapes/shapes.h"

#include <algorithm>
#include <numbers>

namespace knead {

namespace {

constexpr unsigned settle_limit = 1000;
constexpr std::size_t twist_slices = 100;

DragLine way(const Course& course, std::size_t frames) {
    DragLine line{"handle", course.task.pivot, {}};
    for (std::size_t f = 1; f <= frames; ++f) {
        const double part = static_cast<double>(f) / static_cast<double>(frames);
        HandlePose pose;
        pose.rotate =
            Eigen::AngleAxisd(part * course.degrees * std::numbers::pi / 180, course.axis.normalized());
        pose.translate = part * course.translate;
        line.frames.push_back(pose);
    }
    return line;
}

Course course_of(const char* name, const std::string& words, const Vec3d& axis, double degrees,
                 Workers& workers, Progress& progress) {
    Course course;
    course.name = words;
    course.task = generated_task(name, workers, progress);
    course.axis = axis;
    course.degrees = degrees;
    course.translate = course.task.pose.translate;
    course.ambiguous = degrees >= 180;
    course.twists = axis == Vec3d::UnitZ() && degrees > 0;
    return course;
}

} // namespace

std::vector<TurnResult> go_course(const Course& course, std::span<const std::size_t> frames, Workers& workers,
                                  Upsampler& upsampler, Progress& progress) {
    struct Way {
        std::vector<float> at_last_frame, settled;
    };
    std::vector<Way> ways;
    std::vector<TurnResult> results;
    double diagonal = 0;
    for (const std::size_t count : frames) {
        const auto document = open_task(course.task, Settings{}, workers, upsampler);
        document->drag(way(course, count), course.name, progress);
        Way gone;
        gone.at_last_frame = document->positions(progress);
        const std::size_t dragged = document->log().iteration.size();
        const Settling settling = settle(*document, settle_limit, progress);
        gone.settled = document->positions(progress);
        ways.push_back(std::move(gone));
        diagonal = document->bounds().diagonal();

        TurnResult result;
        result.course = course.name;
        result.points = course.task.cloud.size();
        result.frames = count;
        result.aimed = count > 1 || !course.ambiguous;
        result.iterations = settling.iterations - dragged;
        result.at_rest = settling.at_rest;
        if (course.twists) {
            const std::vector<double> turns =
                turns_along_z(course.task.cloud.positions, ways.back().settled, twist_slices);
            result.asked_twist = course.degrees;
            result.twist = turns.back() - turns.front();
        }
        results.push_back(std::move(result));
    }
    for (std::size_t w = 0; w < ways.size(); ++w) {
        results[w].at_last_frame = deviation_between(ways[w].at_last_frame, ways.back().settled, diagonal);
        results[w].settled = deviation_between(ways[w].settled, ways.back().settled, diagonal);
    }
    return results;
}

std::vector<TurnResult> evaluate_turns(Workers& workers, Upsampler& upsampler, Progress& progress) {
    const auto course = [&](const char* name, const char* words, const Vec3d& axis, double degrees) {
        return course_of(name, words, axis, degrees, workers, progress);
    };
    constexpr std::size_t few_frames[] = {1, 10, 100};
    constexpr std::size_t whole_turn[] = {18, 36, 360}; // of 20°, 10° and 1°
    constexpr std::size_t two_turns[] = {36, 72};
    std::vector<TurnResult> results;
    const auto go = [&](const Course& gone, std::span<const std::size_t> frames) {
        std::ranges::move(go_course(gone, frames, workers, upsampler, progress), std::back_inserter(results));
    };
    go(course("made-cylinder", "tube, bent 120°", Vec3d::UnitY(), 120), few_frames);
    go(course("made-plane", "plane, shifted", Vec3d::UnitZ(), 0), few_frames);
    go(course("made-bar", "bar, twisted 180°", Vec3d::UnitZ(), 180), few_frames);
    go(course("made-cylinder", "tube, bent 180°", Vec3d::UnitY(), 180), few_frames);
    go(course("made-bar", "bar, twisted 720°", Vec3d::UnitZ(), 720), two_turns);
    // A rod that is clamped at both ends and twisted slowly by more than 8.99 B/C radians, 515° where it is
    // as stiff in bending, B, as in twisting, C, throws a loop (Greenhill's problem of 1883): from there
    // on the way matters.
    go(course("made-long-bar", "long bar, twisted 360°", Vec3d::UnitZ(), 360), whole_turn);
    go(course("made-long-bar", "long bar, twisted 720°", Vec3d::UnitZ(), 720), two_turns);
    return results;
}

} // namespace knead
