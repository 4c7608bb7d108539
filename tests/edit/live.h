#pragma once
// What the tests of live documents share: waiting for one, and a bar to work on.

#include "edit/live_document.h"
#include "io/cloud_file.h"
#include "shapes/shapes.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>

namespace knead::test {

// Waits for a condition; a minute is for ever.
inline bool wait_until(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (std::chrono::steady_clock::now() < end) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
}

inline void wait_until_open(const LiveDocument& live) {
    ASSERT_TRUE(wait_until([&] { return live.status().stage != LiveDocument::Stage::opening; }));
}

inline void wait_until_idle(const LiveDocument& live) {
    ASSERT_TRUE(wait_until([&] { return !live.status().busy; }));
}

// The bar of shapes/shapes.h as a file: 1 × 1 × 5 along z about the origin.
inline std::filesystem::path bar_file(const ScratchFolder& folder, std::size_t points = 3000) {
    std::filesystem::path file = folder / "bar.ply";
    SilentProgress silent;
    Workers workers(1);
    ShapeOptions options;
    options.points = points;
    write_cloud(file, make_shape(Shape::bar, options, workers, silent), {}, silent);
    return file;
}

// Its ends: the lower one fixed, the upper one moving.
inline std::vector<SessionAction> bar_handles() {
    HandleLine low{"low", HandleRole::fixed, Region(HalfspaceRegion{{0, 0, -2}, {0, 0, -1}})};
    HandleLine high{"high", HandleRole::moving, Region(HalfspaceRegion{{0, 0, 2}, {0, 0, 1}})};
    return {low, high};
}

inline Transform turned(double angle, glm::dvec3 axis = {0, 0, 1}, glm::dvec3 pivot = {0, 0, 2}) {
    Transform transform;
    transform.pivot = pivot;
    transform.axis = axis;
    transform.angle = angle;
    return transform;
}

} // namespace knead::test
