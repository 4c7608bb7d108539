// The tools, with no window: given input, exact selection, exact pose, exact camera.

#include "edit/tools.h"

#include "view/viewing.h"

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace knead {
namespace {

using test::camera_from;
using test::near;
using test::pi;
using test::screen;
using Doing = Tools::Doing;

constexpr Modifiers plain{};
constexpr Modifiers shift{true, false, false};
constexpr Modifiers ctrl{false, true, false};
constexpr Modifiers alt{false, false, true};
constexpr glm::dvec2 middle{400, 300};

// A hand before a cloud that does what it is told: the camera obeys.
struct Bench {
    Tools tools;
    ToolContext context;
    std::vector<Command> commands;

    Bench() {
        context.camera = camera_from(Side::front);
        context.viewport = screen;
    }
    void add_gizmo(const glm::dvec3& center = {0, 0, 0}) {
        context.gizmo.emplace();
        context.gizmo->center = center;
    }
    bool take(const Input& input) {
        const std::size_t before = commands.size();
        const bool used = handle_input(tools, context, input, commands);
        for (std::size_t i = before; i < commands.size(); ++i)
            if (const auto* move = std::get_if<MoveCamera>(&commands[i])) context.camera = move->camera;
        return used;
    }
    bool move(glm::dvec2 to, Modifiers held = {}) { return take(MouseMove{to, held}); }
    bool press(glm::dvec2 at, Modifiers held = {}, MouseButton button = MouseButton::left, int clicks = 1) {
        return take(MousePress{button, at, held, clicks});
    }
    bool release(glm::dvec2 at, Modifiers held = {}, MouseButton button = MouseButton::left) {
        return take(MouseRelease{button, at, held});
    }
    void drag(const std::vector<glm::dvec2>& path, Modifiers held = {},
              MouseButton button = MouseButton::left) {
        press(path.front(), held, button);
        for (const glm::dvec2& p : path) move(p, held);
        release(path.back(), held, button);
    }
    void click(glm::dvec2 at, Modifiers held = {}, int clicks = 1) {
        press(at, held, MouseButton::left, clicks);
        release(at, held);
    }
    bool hit(char letter, Modifiers held = {}) { return take(KeyPress{key(letter), held, false}); }
    bool hit(Key which, Modifiers held = {}) { return take(KeyPress{which, held, false}); }
    // As a window does: the key, then the character.
    void type(std::string_view text) {
        for (const char c : text) {
            hit(c);
            take(Character{static_cast<char32_t>(c)});
        }
    }
    template<typename T>
    std::vector<T> all() const {
        std::vector<T> some;
        for (const Command& command : commands)
            if (const auto* one = std::get_if<T>(&command)) some.push_back(*one);
        return some;
    }
    template<typename T>
    T only() const {
        EXPECT_EQ(all<T>().size(), 1U);
        return all<T>().empty() ? T{} : all<T>().front();
    }
    Transform last() const {
        EXPECT_FALSE(all<DragTo>().empty());
        return all<DragTo>().empty() ? Transform{} : all<DragTo>().back().transform;
    }
    double pixel() const { return pixel_size_at(context.camera, screen, {0, 0, 0}); }
};

template<typename T>
bool is(const Command& command) {
    return std::holds_alternative<T>(command);
}

// --- The camera ---

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

// --- Choosing ---

TEST(SelectTools, AClickIsAClickWithEveryTool) {
    for (const SelectTool tool : {SelectTool::click, SelectTool::box, SelectTool::lasso, SelectTool::brush}) {
        Bench bench;
        bench.tools.select = tool;
        bench.drag({{100, 50}, {102, 52}, {101, 50}});
        ASSERT_EQ(bench.commands.size(), 1U);
        EXPECT_EQ(bench.only<SelectPointUnder>().pixel, glm::dvec2(100, 50));
        EXPECT_EQ(bench.only<SelectPointUnder>().mode, SelectMode::replace);
        bench.click({9, 9}, shift);
        bench.click({9, 9}, ctrl);
        EXPECT_EQ(bench.all<SelectPointUnder>()[1].mode, SelectMode::add);
        EXPECT_EQ(bench.all<SelectPointUnder>()[2].mode, SelectMode::remove);
    }
}

TEST(SelectTools, ADoubleClickSetsThePivot) {
    for (const SelectTool tool :
         {SelectTool::click, SelectTool::box, SelectTool::lasso, SelectTool::brush, SelectTool::polygon}) {
        Bench bench;
        bench.tools.select = tool;
        bench.click({100, 50});
        bench.click({100, 50}, plain, 2);
        EXPECT_EQ(bench.only<SetPivotUnder>().pixel, glm::dvec2(100, 50));
        EXPECT_EQ(bench.tools.doing, Doing::nothing);
        EXPECT_TRUE(bench.tools.band.empty());
    }
}

TEST(SelectTools, BoxTakesTheTwoCorners) {
    Bench bench;
    bench.hit('B');
    bench.hit('T');
    bench.press({100, 50}, ctrl);
    bench.move({300, 200}, ctrl);
    EXPECT_EQ(bench.tools.doing, Doing::selecting);
    bench.move({90, 210});
    bench.release({80, 220});
    const SelectRegion select = bench.only<SelectRegion>();
    EXPECT_EQ(std::get<ScreenBox>(select.region).corner, glm::dvec2(100, 50));
    EXPECT_EQ(std::get<ScreenBox>(select.region).opposite, glm::dvec2(80, 220));
    EXPECT_EQ(select.mode, SelectMode::remove) << "what was held at the press counts";
    EXPECT_TRUE(select.through);
}

TEST(SelectTools, LassoTakesTheWay) {
    Bench bench;
    bench.hit('Q');
    bench.drag({{100, 50}, {100.5, 50}, {200, 50}, {200, 150}, {100, 150}}, shift);
    const SelectRegion select = bench.only<SelectRegion>();
    const std::vector<glm::dvec2> way{{100, 50}, {200, 50}, {200, 150}, {100, 150}};
    EXPECT_EQ(std::get<ScreenPolygon>(select.region).corners, way);
    EXPECT_EQ(select.mode, SelectMode::add);
    EXPECT_FALSE(select.through);
    EXPECT_TRUE(bench.tools.band.empty());
}

TEST(SelectTools, AWayThatComesBackIsNoClick) {
    Bench bench;
    bench.drag({{100, 50}, {200, 50}, {200, 150}, {100, 50}});
    EXPECT_EQ(bench.all<SelectRegion>().size(), 1U);
}

TEST(SelectTools, BrushPaintsOneStroke) {
    Bench bench;
    bench.hit('K');
    EXPECT_TRUE(bench.hit(']'));
    EXPECT_NEAR(bench.tools.brush_radius, 28.8, 1e-12);
    EXPECT_TRUE(bench.hit('['));
    EXPECT_NEAR(bench.tools.brush_radius, 24, 1e-12);
    bench.drag({{100, 50}, {120, 50}, {140, 70}});
    const SelectRegion select = bench.only<SelectRegion>();
    const std::vector<glm::dvec2> way{{100, 50}, {120, 50}, {140, 70}};
    EXPECT_EQ(std::get<ScreenStroke>(select.region).path, way);
    EXPECT_EQ(std::get<ScreenStroke>(select.region).radius, bench.tools.brush_radius);
    for (int i = 0; i < 100; ++i) bench.hit('[');
    EXPECT_GE(bench.tools.brush_radius, 1);
    for (int i = 0; i < 100; ++i) bench.hit(']');
    EXPECT_LE(bench.tools.brush_radius, 1000);
}

TEST(SelectTools, PolygonTakesItsClicks) {
    const std::vector<glm::dvec2> corners{{100, 50}, {200, 50}, {200, 150}};
    for (const int way : {0, 1, 2}) {
        Bench bench;
        bench.hit('P');
        bench.click(corners[0], shift);
        bench.click({300, 300});
        bench.hit(Key::backspace);
        bench.move({350, 310});
        bench.click(corners[1]);
        bench.click(corners[2]);
        EXPECT_TRUE(bench.commands.empty());
        EXPECT_EQ(bench.tools.band, corners);
        if (way == 0) bench.hit(Key::enter);
        if (way == 1) bench.click(corners[2], plain, 2);
        if (way == 2) bench.press({5, 5}, plain, MouseButton::right);
        ASSERT_EQ(bench.commands.size(), 1U);
        EXPECT_EQ(std::get<ScreenPolygon>(bench.only<SelectRegion>().region).corners, corners);
        EXPECT_EQ(bench.only<SelectRegion>().mode, SelectMode::add);
        EXPECT_EQ(bench.tools.doing, Doing::nothing);
    }
}

TEST(SelectTools, APolygonCanBeDropped) {
    Bench bench;
    bench.hit('P');
    bench.click({100, 50});
    bench.click({200, 50});
    bench.take(Wheel{1, middle, plain});
    bench.press(middle, plain, MouseButton::middle);
    bench.hit('1');
    EXPECT_EQ(bench.context.camera, camera_from(Side::front)) << "the corners are pixels: the camera stays";
    bench.hit(Key::escape);
    EXPECT_EQ(bench.tools.doing, Doing::nothing);
    bench.click({1, 1});
    bench.hit(Key::backspace);
    EXPECT_EQ(bench.tools.doing, Doing::nothing);
    bench.click({1, 1});
    bench.click({9, 1});
    bench.hit(Key::enter); // two corners enclose nothing
    EXPECT_TRUE(bench.commands.empty());
}

TEST(SelectTools, ABandCanBeDropped) {
    Bench bench;
    bench.press({100, 50});
    bench.move({200, 150});
    bench.hit(Key::escape);
    bench.release({200, 150});
    bench.press({100, 50});
    bench.move({200, 150});
    bench.press({200, 150}, plain, MouseButton::right);
    bench.release({200, 150}, plain, MouseButton::right);
    bench.release({200, 150});
    EXPECT_TRUE(bench.commands.empty());
    EXPECT_FALSE(bench.press({200, 150}, plain, MouseButton::right)) << "free for a menu";
}

TEST(SelectTools, KeysChangeSelectionAndHandles) {
    Bench bench;
    for (const auto& [letter, held] :
         {std::pair('A', plain), {'A', alt}, {'I', ctrl}, {'=', ctrl}, {'-', ctrl}, {'L', plain}})
        EXPECT_TRUE(bench.hit(letter, held));
    bench.hit(Key::escape);
    const auto steps = bench.all<ChangeSelection>();
    const std::vector<SelectionStep> expected{
        SelectionStep::all,    SelectionStep::none,      SelectionStep::invert, SelectionStep::grow,
        SelectionStep::shrink, SelectionStep::connected, SelectionStep::none};
    ASSERT_EQ(steps.size(), expected.size());
    for (std::size_t i = 0; i < steps.size(); ++i) EXPECT_EQ(steps[i].step, expected[i]);
    for (const Modifiers held : {plain, shift, alt}) bench.hit('V', held);
    EXPECT_EQ(bench.all<ChangeHidden>()[0].step, HideStep::hide_selected);
    EXPECT_EQ(bench.all<ChangeHidden>()[1].step, HideStep::hide_unselected);
    EXPECT_EQ(bench.all<ChangeHidden>()[2].step, HideStep::show_all);
    for (const Modifiers held : {plain, shift, ctrl}) bench.hit('H', held);
    EXPECT_EQ(bench.all<MakeHandle>()[0].role, HandleRole::moving);
    EXPECT_EQ(bench.all<MakeHandle>()[1].role, HandleRole::fixed);
    EXPECT_EQ(bench.all<MakeHandle>()[2].role, HandleRole::region_of_interest);
    bench.hit(Key::enter);
    bench.hit('Z', ctrl);
    bench.hit('Z', {true, true, false});
    bench.hit('Y', ctrl);
    EXPECT_EQ(bench.all<CommitPose>().size(), 1U);
    EXPECT_EQ(bench.all<UndoStep>().size(), 1U);
    EXPECT_EQ(bench.all<RedoStep>().size(), 2U);
    const std::size_t count = bench.commands.size();
    EXPECT_FALSE(bench.hit('S', ctrl));
    EXPECT_FALSE(bench.hit('O', ctrl));
    EXPECT_FALSE(bench.hit('=')) << "point size is the menu's";
    EXPECT_FALSE(bench.hit('G')) << "nothing to move";
    EXPECT_FALSE(bench.take(Character{U'g'}));
    EXPECT_EQ(bench.commands.size(), count);
}

TEST(SelectTools, HeldKeysRepeatOnlyWhatMakesSense) {
    Bench bench;
    bench.take(KeyPress{key('Z'), ctrl, true});
    bench.take(KeyPress{key('='), ctrl, true});
    EXPECT_EQ(bench.commands.size(), 2U);
    bench.take(KeyPress{key('H'), plain, true});
    bench.take(KeyPress{Key::enter, plain, true});
    bench.take(KeyPress{key('T'), plain, true});
    EXPECT_EQ(bench.commands.size(), 2U);
    EXPECT_FALSE(bench.tools.through);
}

// --- Moving ---

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
    for (const char c : {'A', 'H', 'V', 'F', '1', 'B', 'R', 'S', 'L'}) EXPECT_TRUE(bench.hit(c));
    EXPECT_TRUE(bench.hit('Z', ctrl));
    EXPECT_TRUE(bench.hit(Key::del));
    EXPECT_EQ(bench.all<BeginDrag>().size(), bench.commands.size());
    EXPECT_EQ(bench.tools.drag->kind, TransformKind::translate);
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
    bench.release(middle + glm::dvec2(105, 2));
    EXPECT_EQ(bench.commands.size(), 1U);
    bench.press(middle + glm::dvec2(85, 2));
    bench.move(middle + glm::dvec2(185, 2));
    bench.hit(Key::escape);
    EXPECT_EQ(*bench.all<SetPivot>().back().pivot, glm::dvec3(0.0));
    EXPECT_TRUE(bench.all<BeginDrag>().empty());
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

TEST(Tools, DropEverythingWhenTheWindowLosesTheHand) {
    Bench bench;
    bench.add_gizmo();
    bench.hit('G');
    bench.move({90, 90});
    drop_everything(bench.tools, bench.commands);
    EXPECT_TRUE(is<CancelDrag>(bench.commands.back()));
    bench.press({90, 90}, plain, MouseButton::middle);
    drop_everything(bench.tools, bench.commands);
    EXPECT_EQ(bench.tools.doing, Doing::nothing);
    bench.press({90, 90});
    drop_everything(bench.tools, bench.commands);
    EXPECT_TRUE(bench.tools.band.empty());
    EXPECT_EQ(bench.commands.size(), 3U);
}

TEST(Tools, ADragThatWasTakenAwayIsOver) {
    Bench bench;
    bench.add_gizmo();
    bench.hit('G');
    bench.tools.drag.reset(); // as another cloud is opened
    bench.move({90, 90});
    EXPECT_EQ(bench.tools.doing, Doing::nothing);
}

} // namespace
} // namespace knead
