// The tools that select, with no window: given input, an exact outcome.

#include "edit/tools_bench.h"

namespace knead {
namespace {

using namespace test;

TEST(SelectTools, AClickIsAClickWithEveryToolThatDrawsAnOutline) {
    for (const SelectTool tool : {SelectTool::click, SelectTool::box, SelectTool::lasso}) {
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

TEST(SelectTools, AClickOfTheBrushHasItsRadius) {
    Bench bench;
    bench.hit('K');
    bench.click({100, 50});
    bench.hit('T');
    bench.click({9, 9}, shift);
    bench.click({9, 9}, ctrl);
    const std::vector<SelectPointUnder> dabs = bench.all<SelectPointUnder>();
    ASSERT_EQ(dabs.size(), 3U);
    EXPECT_EQ(dabs[0].pixel, glm::dvec2(100, 50));
    EXPECT_EQ(dabs[0].radius, bench.tools.brush_radius);
    EXPECT_FALSE(dabs[0].through);
    EXPECT_TRUE(dabs[1].through);
    EXPECT_EQ(dabs[0].mode, SelectMode::replace);
    EXPECT_EQ(dabs[1].mode, SelectMode::add);
    EXPECT_EQ(dabs[2].mode, SelectMode::remove);
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
    EXPECT_TRUE(bench.take(Character{U']'}));
    EXPECT_NEAR(bench.tools.brush_radius, 28.8, 1e-12);
    EXPECT_TRUE(bench.take(Character{U'['}));
    EXPECT_NEAR(bench.tools.brush_radius, 24, 1e-12);
    bench.drag({{100, 50}, {120, 50}, {140, 70}});
    const SelectRegion select = bench.only<SelectRegion>();
    const std::vector<glm::dvec2> way{{100, 50}, {120, 50}, {140, 70}};
    EXPECT_EQ(std::get<ScreenStroke>(select.region).path, way);
    EXPECT_EQ(std::get<ScreenStroke>(select.region).radius, bench.tools.brush_radius);
    EXPECT_EQ(select.mode, SelectMode::add) << "to the strokes before";
    bench.drag({{100, 50}, {120, 50}}, ctrl);
    EXPECT_EQ(bench.all<SelectRegion>().back().mode, SelectMode::remove);
    for (int i = 0; i < 100; ++i) bench.take(Character{U'['});
    EXPECT_GE(bench.tools.brush_radius, 1);
    for (int i = 0; i < 100; ++i) bench.take(Character{U']'});
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

TEST(SelectTools, TakingBackGoesCornerByCornerOfAPolygon) {
    Bench bench;
    bench.hit('P');
    bench.click({100, 50});
    bench.click({200, 50});
    bench.click({300, 300});
    EXPECT_TRUE(bench.hit('Z', ctrl));
    EXPECT_EQ(bench.tools.band, (std::vector<glm::dvec2>{{100, 50}, {200, 50}}));
    bench.hit('Z', {true, true, false}); // which is another key
    EXPECT_EQ(bench.tools.band.size(), 2U);
    bench.hit('Z', ctrl);
    bench.hit('Z', ctrl);
    EXPECT_EQ(bench.tools.doing, Doing::nothing);
    EXPECT_TRUE(bench.commands.empty());
    bench.hit('Z', ctrl);
    bench.only<UndoStep>();
}

TEST(SelectTools, TakingBackDropsAnyOtherBand) {
    for (const SelectTool tool : {SelectTool::box, SelectTool::lasso, SelectTool::brush}) {
        Bench bench;
        bench.tools.select = tool;
        bench.press({100, 50});
        bench.move({120, 80});
        EXPECT_TRUE(bench.hit('Z', ctrl));
        EXPECT_EQ(bench.tools.doing, Doing::nothing);
        bench.move({200, 90});
        bench.release({200, 90});
        EXPECT_TRUE(bench.commands.empty());
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
    const auto steps = bench.all<ChangeSelection>();
    const std::vector<SelectionStep> expected{SelectionStep::all,    SelectionStep::none,
                                              SelectionStep::invert, SelectionStep::grow,
                                              SelectionStep::shrink, SelectionStep::connected};
    bench.hit(Key::escape);
    EXPECT_EQ(bench.all<DropChoice>().size(), 1U);
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
    EXPECT_FALSE(bench.take(Character{U'g'}));
    EXPECT_EQ(bench.commands.size(), count);
    EXPECT_TRUE(bench.hit('G'));
    EXPECT_EQ(bench.all<RefuseTransform>().size(), 1U) << "nothing to move";
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

} // namespace
} // namespace knead
