#include "edit/way_back.h"

#include <algorithm>
#include <cmath>

namespace knead {

namespace {

// The cosine of half the turn that a shortcut makes at most, 120°. Where the handle stayed within it all the
// time, it went no other way round.
constexpr double least_cosine = 0.5;

constexpr double rounding = 1e-9; // of cosines, by which two turns are alike

double turn_between(const HandleMotion& from, const HandleMotion& to) {
    return 2 * std::acos(std::clamp(from.rotation.dot(to.rotation), -1.0, 1.0));
}

// Where the way back turns off: numbers in `way`, from the last one to the first.
std::vector<std::size_t> corners(std::span<const HandleMotion> way) {
    std::vector<std::size_t> result{way.size() - 1};
    for (std::size_t at = way.size() - 1; at > 0; result.push_back(at)) {
        const Quatd& here = way[at].rotation;
        --at;
        while (at > 0 && here.dot(way[at - 1].rotation) >= least_cosine) --at;
    }
    return result;
}

// The way from rest, without what was gone there and back again: from one place over a second to a third that
// is nearer to the first than the second is to the farther of both.
std::vector<HandleMotion> from_rest_without_returns(std::span<const HandleMotion> way) {
    std::vector<HandleMotion> result{HandleMotion{}};
    for (const HandleMotion& next : way) {
        const auto goes_back = [&] {
            const Quatd &last = result.back().rotation, &before = result[result.size() - 2].rotation;
            const double farther = std::min(before.dot(last), last.dot(next.rotation));
            return before.dot(next.rotation) > farther - rounding;
        };
        while (result.size() > 1 && goes_back()) result.pop_back();
        result.push_back(next);
    }
    return result;
}

} // namespace

bool is_back(std::span<const HandleMotion> way) {
    return way.empty() || (is_at_rest(way.back()) && corners(from_rest_without_returns(way)).size() <= 2);
}

DragLine way_back(const std::string& handle, std::span<const HandleMotion> way, const Vec3d& middle,
                  const Vec3d& origin) {
    const std::vector<HandleMotion> from_rest = from_rest_without_returns(way);
    const std::vector<std::size_t> stops = corners(from_rest);
    const HandlePose posed = pose_of(from_rest.back(), middle + origin, origin);
    double whole = 0, done = 0;
    for (std::size_t k = 1; k < stops.size(); ++k)
        whole += turn_between(from_rest[stops[k - 1]], from_rest[stops[k]]);

    DragLine line{handle, middle + origin, {}};
    for (std::size_t k = 1; k < stops.size(); ++k) {
        const HandleMotion &from = from_rest[stops[k - 1]], &to = from_rest[stops[k]];
        const Vec3d start = moved_point(from, middle) - middle;
        const Vec3d end = moved_point(to, middle) - middle;
        const double turn = turn_between(from, to);
        const int frames = std::max(1, static_cast<int>(std::ceil(turn / widest_turn - 1e-9)));
        for (int f = 1; f <= frames; ++f) {
            const double t = static_cast<double>(f) / frames;
            const double left = whole > 0 ? 1 - (done + t * turn) / whole : 0;
            HandlePose pose;
            pose.rotate = between(from.rotation, to.rotation, t);
            pose.translate = start + t * (end - start);
            pose.scale = Vec3d::Ones() + std::clamp(left, 0.0, 1.0) * (posed.scale - Vec3d::Ones());
            pose.axes = posed.axes;
            line.frames.push_back(pose);
        }
        done += turn;
    }
    if (line.frames.empty()) line.frames.emplace_back();
    line.frames.back() = HandlePose{};
    return line;
}

DragLine way_there(const std::string& handle, std::span<const HandleMotion> way, const Vec3d& middle,
                   const Vec3d& origin) {
    DragLine line = way_back(handle, way, middle, origin);
    line.frames.pop_back(); // at rest
    std::ranges::reverse(line.frames);
    line.frames.push_back(pose_of(way.back(), middle + origin, origin));
    return line;
}

} // namespace knead
