// The gizmo and the modal G, R, S, with no window: given input, an exact outcome.

#include "edit/tools_bench.h"

#include <cmath>

namespace knead {
namespace {

using namespace test;

TEST(MoveTools, RX45EnterTurnsByAnEighth) {
    Bench bench;
    bench.add_gizmo({0.1, 0.2, 0.3});
    bench.move({520, 310});
    bench.type("R");
    EXPECT_TRUE(bench.tools.modal);
    bench.type("X45");
    EXPECT_EQ(bench.only<BeginDrag>().pivot, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_NEAR(bench.last().angle, pi / 4, 1e-15);
    EXPECT_EQ(bench.last().axis, glm::dvec3(1, 0, 0));
    EXPECT_EQ(bench.last().pivot, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_TRUE(bench.hit(Key::enter));
    EXPECT_TRUE(is<EndDrag>(bench.commands.back()));
    EXPECT_EQ(bench.tools.doing, Doing::nothing);
    EXPECT_FALSE(bench.tools.drag);
    EXPECT_EQ(bench.commands.size(), 4U) << "BeginDrag, 4, 45, EndDrag";
}

TEST(MoveTools, TurningTwiceRoundIsFourPi) {
    Bench bench;
    bench.add_gizmo();
    bench.move({500, 300});
    bench.hit('R');
    for (int i = 1; i <= 100; ++i) {
        const double angle = 4 * pi * i / 100;
        bench.move(middle + 100.0 * glm::dvec2(std::cos(angle), -std::sin(angle)));
    }
    EXPECT_NEAR(bench.last().angle, 4 * pi, 1e-9);
    bench.press({500, 300});
    bench.release({500, 300});
    EXPECT_TRUE(is<EndDrag>(bench.commands.back())) << "the release after the click is no click";
}

TEST(MoveTools, AnotherOfGRSGoesOnAsThatFromWhereTheHandleWas) {
    Bench bench;
    bench.add_gizmo({0.1, 0.2, 0.3});
    bench.move({520, 310});
    bench.hit('G');
    bench.move({560, 330});
    EXPECT_GT(glm::length(bench.last().shift), 0);
    bench.hit('R');
    EXPECT_TRUE(bench.tools.modal);
    bench.type("Z90");
    EXPECT_NEAR(bench.last().angle, pi / 2, 1e-15);
    EXPECT_EQ(bench.last().axis, glm::dvec3(0, 0, 1));
    EXPECT_EQ(glm::length(bench.last().shift), 0);
    EXPECT_EQ(bench.last().pivot, glm::dvec3(0.1, 0.2, 0.3));
    bench.hit(Key::enter);
    EXPECT_EQ(bench.all<BeginDrag>().size(), 1U) << "one drag, and one step to undo";
    EXPECT_EQ(bench.all<EndDrag>().size(), 1U);
}

TEST(MoveTools, GFollowsTheHandAndRightClickCancels) {
    Bench bench;
    bench.add_gizmo();
    bench.move({200, 200});
    bench.hit('G');
    bench.move({230, 180});
    EXPECT_TRUE(near(bench.last().shift, {30 * bench.pixel(), 0, 20 * bench.pixel()}, 1e-12));
    bench.move({230, 180});
    bench.move({230, 180}, alt);
    EXPECT_EQ(bench.all<DragTo>().size(), 1U) << "only what changed is told";
    bench.hit('Z');
    EXPECT_EQ(bench.last().shift.x, 0);
    bench.press({230, 180}, plain, MouseButton::right);
    EXPECT_TRUE(is<CancelDrag>(bench.commands.back()));
    EXPECT_TRUE(bench.all<EndDrag>().empty());
    EXPECT_EQ(bench.tools.doing, Doing::nothing);
}

TEST(MoveTools, EscapeCancels) {
    Bench bench;
    bench.add_gizmo();
    bench.hit('S');
    bench.move({500, 300});
    bench.hit(Key::escape);
    EXPECT_TRUE(is<CancelDrag>(bench.commands.back()));
    EXPECT_TRUE(bench.all<ChangeSelection>().empty());
}

TEST(MoveTools, WhatDidNotMoveIsCancelled) {
    Bench bench;
    bench.add_gizmo();
    bench.hit('R');
    bench.hit('X');
    bench.hit(Key::enter);
    ASSERT_EQ(bench.commands.size(), 2U);
    EXPECT_TRUE(is<CancelDrag>(bench.commands.back()));
}

TEST(MoveTools, NoOtherKeyIsTaken) {
    Bench bench;
    bench.add_gizmo();
    bench.move({500, 300});
    bench.hit('G');
    for (const char c : {'A', 'H', 'V', 'F', '1', 'B', 'G', 'L'}) EXPECT_TRUE(bench.hit(c));
    EXPECT_TRUE(bench.hit('Y', ctrl)); // snapping, along y
    EXPECT_TRUE(bench.hit(Key::del));
    EXPECT_EQ(bench.all<BeginDrag>().size(), bench.commands.size());
    EXPECT_EQ(bench.tools.drag->kind, TransformKind::translate);
    EXPECT_TRUE(bench.hit('Z', ctrl)); // but what takes back takes this back
    EXPECT_FALSE(bench.tools.drag);
    EXPECT_EQ(bench.all<CancelDrag>().size(), 1U);
}

TEST(MoveTools, AShiftThatIsHeldWhenItBeginsSelectsThroughTheGizmo) {
    for (const bool adds : {false, true}) {
        Bench bench;
        bench.add_gizmo();
        bench.move(middle);
        ASSERT_TRUE(bench.tools.hovered);
        bench.press(middle, adds ? shift : plain);
        EXPECT_EQ(bench.all<BeginDrag>().size(), adds ? 0U : 1U);
        EXPECT_EQ(bench.tools.doing == Doing::selecting, adds);
    }
}

TEST(MoveTools, CtrlSnapsAndShiftSlows) {
    Bench bench;
    bench.add_gizmo();
    bench.move({500, 300});
    bench.hit('R');
    bench.move({500, 281}, ctrl);
    EXPECT_NEAR(bench.last().angle, 10 * pi / 180, 1e-12);
    bench.hit(Key::escape);
    bench.move({200, 200});
    bench.hit('G');
    bench.move({300, 200}, shift);
    EXPECT_TRUE(near(bench.last().shift, {10 * bench.pixel(), 0, 0}, 1e-12));
}

TEST(MoveTools, KeysGoThroughWorldOwnAndFree) {
    Bench bench;
    bench.add_gizmo();
    bench.context.local_axes = glm::angleAxis(pi / 2, glm::dvec3(0, 1, 0)); // own x is -z of the world
    bench.move(middle);
    bench.hit('G');
    bench.hit('X');
    bench.move({430, 280});
    EXPECT_GT(bench.last().shift.x, 0);
    EXPECT_EQ(bench.last().shift.z, 0);
    bench.hit('X');
    EXPECT_NEAR(bench.last().shift.x, 0, 1e-12);
    EXPECT_GT(bench.last().shift.z, 0);
    bench.hit('X');
    EXPECT_TRUE(near(bench.last().shift, {30 * bench.pixel(), 0, 20 * bench.pixel()}, 1e-12));
    bench.hit('X', shift);
    EXPECT_EQ(bench.last().shift.x, 0) << "across x";
}

TEST(MoveTools, AGizmosArrowDragsAlongItsAxis) {
    Bench bench;
    bench.add_gizmo();
    bench.move(middle + glm::dvec2(85, 2));
    EXPECT_EQ(bench.tools.hovered, (GizmoPart{TransformKind::translate, {Constraint::Kind::axis, 0, false}}));
    bench.press(middle + glm::dvec2(85, 2));
    EXPECT_EQ(bench.tools.doing, Doing::transforming);
    bench.move(middle + glm::dvec2(125, 2));
    EXPECT_TRUE(near(bench.last().shift, {40 * bench.pixel(), 0, 0}, 1e-9));
    bench.release(middle + glm::dvec2(125, 2));
    ASSERT_EQ(bench.commands.size(), 3U);
    EXPECT_TRUE(is<BeginDrag>(bench.commands[0]));
    EXPECT_TRUE(is<EndDrag>(bench.commands[2]));
}

TEST(MoveTools, AGizmosRingTurnsPastWholeTurns) {
    Bench bench;
    bench.add_gizmo();
    const auto on_ring = [](double angle) {
        return middle + 63.0 * glm::dvec2(std::cos(angle), -std::sin(angle));
    };
    bench.press(on_ring(0.7));
    ASSERT_TRUE(bench.tools.drag);
    EXPECT_EQ(bench.tools.drag->kind, TransformKind::rotate);
    EXPECT_EQ(bench.tools.drag->constraint, (Constraint{Constraint::Kind::axis, 1, false}));
    for (int i = 1; i <= 60; ++i) bench.move(on_ring(0.7 + 2.5 * pi * i / 60));
    EXPECT_NEAR(bench.last().angle, -2.5 * pi, 1e-9) << "y points away: against the clock is negative";
    bench.hit(Key::escape);
    EXPECT_TRUE(is<CancelDrag>(bench.commands.back()));
    bench.release(on_ring(0));
    EXPECT_TRUE(is<CancelDrag>(bench.commands.back())) << "the release selects nothing";
}

TEST(MoveTools, AClickOnTheGizmoMovesNothing) {
    Bench bench;
    bench.add_gizmo();
    bench.click(middle + glm::dvec2(85, 2));
    ASSERT_EQ(bench.commands.size(), 2U);
    EXPECT_TRUE(is<CancelDrag>(bench.commands[1]));
}

TEST(MoveTools, OrbitingDuringADragLeavesItWhereItIs) {
    for (const char kind : {'G', 'R', 'S'}) {
        Bench bench;
        bench.add_gizmo();
        bench.move({500, 300});
        bench.hit(kind);
        bench.move({520, 250});
        const glm::dvec3 before = transformed(bench.last(), {1, 1, 1});
        const std::size_t told = bench.all<DragTo>().size();
        bench.press({520, 250}, plain, MouseButton::middle);
        EXPECT_TRUE(bench.tools.orbiting_in_drag);
        bench.move({600, 300});
        bench.move({670, 280});
        bench.release({670, 280}, plain, MouseButton::middle);
        bench.take(Wheel{1, {50, 50}, plain});
        EXPECT_FALSE(bench.tools.orbiting_in_drag);
        EXPECT_EQ(bench.all<MoveCamera>().size(), 3U);
        EXPECT_EQ(bench.all<DragTo>().size(), told);
        EXPECT_TRUE(near(transformed(transform_of(*bench.tools.drag), {1, 1, 1}), before, 1e-12));
        bench.move({671, 280});
        EXPECT_TRUE(near(transformed(bench.last(), {1, 1, 1}), before, 0.1)) << "it goes on from there";
        bench.press({671, 280}, alt);
        bench.move({700, 280}, alt);
        bench.release({700, 280}, alt);
        EXPECT_EQ(bench.tools.doing, Doing::transforming) << "Alt+left orbits too";
        bench.hit(Key::enter);
        EXPECT_TRUE(is<EndDrag>(bench.commands.back()));
    }
}

TEST(MoveTools, LettingTheGizmoGoWhileOrbitingEndsTheDrag) {
    Bench bench;
    bench.add_gizmo();
    bench.press(middle + glm::dvec2(85, 2));
    bench.move(middle + glm::dvec2(105, 2));
    bench.press(middle + glm::dvec2(105, 2), plain, MouseButton::middle);
    bench.move(middle + glm::dvec2(125, 2));
    bench.release(middle + glm::dvec2(125, 2));
    EXPECT_TRUE(is<EndDrag>(bench.commands.back()));
    EXPECT_EQ(bench.tools.doing, Doing::nothing);
}

TEST(MoveTools, TheArrowsCanMoveThePivot) {
    Bench bench;
    bench.add_gizmo();
    bench.tools.move_pivot = true;
    bench.press(middle + glm::dvec2(85, 2));
    bench.move(middle + glm::dvec2(105, 2));
    ASSERT_TRUE(bench.only<SetPivot>().pivot);
    EXPECT_TRUE(near(*bench.only<SetPivot>().pivot, {20 * bench.pixel(), 0, 0}, 1e-9));
    EXPECT_EQ(bench.only<SetPivot>().stage, SetPivot::Stage::moving);
    bench.release(middle + glm::dvec2(105, 2));
    ASSERT_EQ(bench.commands.size(), 2U);
    EXPECT_EQ(bench.all<SetPivot>().back().stage, SetPivot::Stage::set);
    EXPECT_EQ(bench.all<SetPivot>().back().pivot, bench.all<SetPivot>().front().pivot);
    bench.press(middle + glm::dvec2(85, 2));
    bench.move(middle + glm::dvec2(185, 2));
    bench.hit(Key::escape);
    EXPECT_EQ(bench.all<SetPivot>().back().stage, SetPivot::Stage::given_up);
    EXPECT_TRUE(bench.all<BeginDrag>().empty());
}

TEST(MoveTools, AClickPutsThePivotThereWhereItIsMoved) {
    for (const SelectTool select :
         {SelectTool::click, SelectTool::lasso, SelectTool::polygon, SelectTool::brush}) {
        Bench bench;
        bench.tools.select = select;
        const glm::dvec2 joint(120, 80);
        const auto click = [&](glm::dvec2 at) {
            bench.commands.clear();
            bench.click(at);
        };
        bench.tools.move_pivot = true; // but there is no handle
        click(joint);
        EXPECT_TRUE(bench.all<SetPivotInside>().empty());
        bench.hit(Key::escape);
        bench.add_gizmo();
        bench.tools.move_pivot = true;
        click(joint);
        EXPECT_EQ(bench.only<SetPivotInside>().pixel, joint);
        EXPECT_EQ(bench.commands.size(), 1U) << "and selects nothing";
        click(middle + glm::dvec2(85, 2)); // on an arrow
        EXPECT_EQ(bench.only<SetPivotInside>().pixel, middle + glm::dvec2(85, 2));
        bench.tools.move_pivot = false;
        click(joint);
        EXPECT_TRUE(bench.all<SetPivotInside>().empty());
    }
}

TEST(MoveTools, TheKeyMovesThePivotWhereTheArrowsDo) {
    Bench bench;
    bench.add_gizmo();
    bench.tools.move_pivot = true;
    bench.move(middle);
    bench.hit('G');
    bench.move(middle + glm::dvec2(20, 0));
    ASSERT_TRUE(bench.only<SetPivot>().pivot);
    EXPECT_TRUE(near(*bench.only<SetPivot>().pivot, {20 * bench.pixel(), 0, 0}, 1e-9));
    EXPECT_TRUE(bench.all<BeginDrag>().empty()) << "the handle stays";
    bench.hit('R');
    EXPECT_EQ(bench.all<SetPivot>().back().stage, SetPivot::Stage::given_up);
    EXPECT_EQ(bench.only<BeginDrag>().pivot, glm::dvec3(0.0)) << "it turns about where the pivot was";
    EXPECT_FALSE(bench.tools.drags_pivot);
    bench.hit('G');
    EXPECT_EQ(bench.all<CancelDrag>().size(), 1U);
    bench.move(middle + glm::dvec2(30, 0));
    bench.hit(Key::enter);
    EXPECT_EQ(bench.all<SetPivot>().back().stage, SetPivot::Stage::set);
    EXPECT_TRUE(near(*bench.all<SetPivot>().back().pivot, {10 * bench.pixel(), 0, 0}, 1e-9));
}

TEST(MoveTools, AFreshNumberCanBeTypedInAGizmosDrag) {
    Bench bench;
    bench.add_gizmo();
    bench.press(middle + glm::dvec2(85, 2));
    bench.move(middle + glm::dvec2(105, 2));
    bench.type("0.25");
    EXPECT_TRUE(near(bench.last().shift, {0.25, 0, 0}, 1e-15));
    bench.hit(Key::backspace);
    EXPECT_TRUE(near(bench.last().shift, {0.2, 0, 0}, 1e-15));
}

} // namespace
} // namespace knead
