// The camera's tools, with no window: given input, an exact outcome.

#include "edit/tools_bench.h"

#include <array>

namespace knead {
namespace {

using namespace test;

TEST(CameraTools, MiddleDragOrbits) {
    Bench bench;
    bench.drag({middle, {250, 300}, {100, 300}}, plain, MouseButton::middle);
    EXPECT_TRUE(near(eye_of(bench.context.camera), {5, 0, 0}, 1e-12));
    EXPECT_EQ(bench.tools.doing, Doing::nothing);
    bench.move({0, 0});
    EXPECT_TRUE(near(eye_of(bench.context.camera), {5, 0, 0}, 1e-12)) << "the hand is off";
    for (const Command& command : bench.commands) EXPECT_TRUE(is<MoveCamera>(command));
}

TEST(CameraTools, AltLeftIsAMiddleButton) {
    Bench bench;
    bench.add_gizmo();
    bench.drag({middle, {100, 300}}, alt);
    EXPECT_TRUE(near(eye_of(bench.context.camera), {5, 0, 0}, 1e-12));
    bench.drag({middle, {410, 320}}, {true, false, true});
    EXPECT_TRUE(near(bench.context.camera.pivot, {0, -10 * bench.pixel(), 20 * bench.pixel()}, 1e-12));
    EXPECT_EQ(bench.commands.size(), 2U);
}

TEST(CameraTools, ShiftPansAndCtrlZooms) {
    Bench bench;
    const double pixel = bench.pixel();
    bench.drag({middle, {440, 270}}, shift, MouseButton::middle);
    EXPECT_TRUE(near(bench.context.camera.pivot, {-40 * pixel, 0, -30 * pixel}, 1e-12));
    bench.drag({middle, {400, 260}}, ctrl, MouseButton::middle);
    EXPECT_NEAR(bench.context.camera.distance, 5 * 0.81, 1e-12);
}

TEST(CameraTools, TheWheelZoomsToTheCursor) {
    Bench bench;
    const glm::dvec3 point{0.5, 0, 0.3};
    const glm::dvec2 at = project(bench.context.camera, screen, point)->pixel;
    EXPECT_TRUE(bench.take(Wheel{2, at, plain}));
    EXPECT_NEAR(bench.context.camera.distance, 5 * 0.81, 1e-12);
    EXPECT_TRUE(near(project(bench.context.camera, screen, point)->pixel, at, 1e-9));
}

TEST(CameraTools, KeysLookAtSides) {
    struct Expected {
        char key;
        Key pad;
        Side side, opposite;
    };
    const std::array<Expected, 3> all{{{'1', Key::pad_1, Side::front, Side::back},
                                       {'3', Key::pad_3, Side::right, Side::left},
                                       {'7', Key::pad_7, Side::top, Side::bottom}}};
    for (const Expected& expected : all) {
        Bench bench;
        EXPECT_TRUE(bench.hit(expected.key));
        EXPECT_TRUE(bench.hit(expected.pad));
        EXPECT_TRUE(bench.hit(expected.key, ctrl));
        EXPECT_TRUE(bench.hit(expected.pad, ctrl));
        const auto sides = bench.all<LookAtSide>();
        ASSERT_EQ(sides.size(), 4U);
        EXPECT_EQ(sides[0].side, expected.side);
        EXPECT_EQ(sides[1].side, expected.side);
        EXPECT_EQ(sides[2].side, expected.opposite);
        EXPECT_EQ(sides[3].side, expected.opposite);
    }
    Bench bench;
    bench.hit('5');
    EXPECT_TRUE(bench.context.camera.orthographic);
    bench.hit(Key::pad_5);
    EXPECT_FALSE(bench.context.camera.orthographic);
    bench.hit('F');
    bench.hit(Key::home);
    ASSERT_EQ(bench.all<FrameView>().size(), 2U);
    EXPECT_EQ(bench.all<FrameView>()[0].what, FrameWhat::selection);
    EXPECT_EQ(bench.all<FrameView>()[1].what, FrameWhat::everything);
}

} // namespace
} // namespace knead
