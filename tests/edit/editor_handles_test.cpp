// Handles in the editor: made, changed, told of.

#include "edit/editor_bar.h"

#include <algorithm>
#include <tuple>

namespace knead::test {

TEST_F(BarEditor, ASelectionBecomesAHandleAndBackInOneStep) {
    make_handles();
    ASSERT_EQ(editor_.document->handles.size(), 2U);
    EXPECT_EQ(editor_.document->handles[1].points->size(), points_between(2, 3));
    EXPECT_EQ(editor_.chosen, "high");
    EXPECT_EQ(editor_.selected, 0U);
    EXPECT_EQ(std::ranges::count(editor_.marks, handle_mark(1)),
              static_cast<std::ptrdiff_t>(points_between(2, 3)));
    apply(editor_, UndoStep{});
    calm();
    EXPECT_EQ(editor_.document->handles.size(), 1U);
    EXPECT_EQ(editor_.selected, points_between(2, 3));
    EXPECT_EQ(editor_.chosen, "");
    apply(editor_, RedoStep{});
    calm();
    EXPECT_EQ(editor_.document->handles.size(), 2U);
    EXPECT_EQ(editor_.selected, 0U);
}

TEST_F(BarEditor, AHandleIsToldHowItHoldsAndKeepsItThroughItsRole) {
    make_handles();
    apply(editor_, ChangeHold{"high", true, 0.25});
    calm();
    const auto high = [&] {
        const auto& handles = editor_.document->handles;
        return *std::ranges::find(handles, "high", &Handle::name);
    };
    EXPECT_TRUE(high().free_rotation);
    EXPECT_EQ(high().falloff, 0.25);
    apply(editor_, ChangeRole{"high", HandleRole::fixed});
    calm();
    EXPECT_EQ(high().role, HandleRole::fixed);
    EXPECT_TRUE(high().free_rotation);
    EXPECT_EQ(high().falloff, 0.25);
    apply(editor_, UndoStep{});
    apply(editor_, UndoStep{});
    calm();
    EXPECT_FALSE(high().free_rotation);
    EXPECT_EQ(high().falloff, 0);
}

// Acts wait while the document is at something long, and the hand goes on meanwhile.
TEST_F(BarEditor, AnActCountsForTheHandlesThatThereAreWhenItsTurnComes) {
    make_handles();
    select_heights(-3, -2.5); // which "low" has, too
    apply(editor_, MakeHandle{HandleRole::fixed, "lowest"});
    calm();
    const auto named = [&](const char* name) {
        const auto& handles = editor_.document->handles;
        const auto found = std::ranges::find(handles, name, &Handle::name);
        return found == handles.end() ? nullptr : &*found;
    };
    apply(editor_, DeleteHandles{{"lowest"}}); // the editor has not seen any of these when the next comes
    apply(editor_, ChangeRole{"low", HandleRole::moving});
    calm();
    EXPECT_EQ(named("lowest"), nullptr) << "it was deleted before";
    ASSERT_NE(named("low"), nullptr);
    EXPECT_EQ(named("low")->role, HandleRole::moving);
    apply(editor_, UndoStep{});
    apply(editor_, UndoStep{});
    calm();
    apply(editor_, ColorHandle{"lowest", 0x112233});
    apply(editor_, RenameHandle{"lowest", "foot"});
    apply(editor_, ChangeHold{"low", true, 0});
    calm();
    EXPECT_EQ(named("lowest"), nullptr);
    ASSERT_NE(named("foot"), nullptr);
    EXPECT_EQ(named("foot")->color, 0x112233U);
    EXPECT_TRUE(named("low")->free_rotation);
    const std::size_t steps = editor_.past.size();
    apply(editor_, ChangeRole{"low", HandleRole::moving});
    apply(editor_, ChangeRole{"low", HandleRole::moving});
    calm();
    EXPECT_EQ(editor_.past.size(), steps + 1) << "what changes nothing is no step";
}

TEST_F(BarEditor, AHandleSaysFromWhomItTakesPoints) {
    make_handles();
    editor_.notices.clear();
    select_heights(-1, 0);
    apply(editor_, MakeHandle{HandleRole::moving, "middle"});
    EXPECT_TRUE(editor_.notices.empty());
    select_heights(-2.5, 1);
    apply(editor_, MakeHandle{HandleRole::moving, "more"});
    ASSERT_EQ(editor_.notices.size(), 1U);
    const std::string& words = editor_.notices.back().words;
    EXPECT_NE(words.find("from \"low\""), std::string::npos) << words;
    EXPECT_EQ(words.find("\"low\", which holds none"), std::string::npos) << words;
    calm();
    editor_.notices.clear();
    apply(editor_, ChangeSelection{SelectionStep::all});
    apply(editor_, MakeHandle{HandleRole::moving, "all"});
    ASSERT_EQ(editor_.notices.size(), 1U);
    EXPECT_NE(editor_.notices.back().words.find("\"low\", which holds none any more"), std::string::npos);
    calm();
    editor_.notices.clear();
    apply(editor_, ChangeSelection{SelectionStep::all});
    apply(editor_, MakeHandle{HandleRole::region_of_interest, "where"});
    EXPECT_TRUE(editor_.notices.empty()) << "a region takes nothing";
}

TEST_F(BarEditor, AnotherColorLeavesThePoseAndIsAStepToUndo) {
    make_handles();
    select_heights(-3, -2.5); // which "low" has, too
    apply(editor_, MakeHandle{HandleRole::fixed, "lowest"});
    calm();
    editor_.chosen = "high";
    turn_chosen("40");
    const LineArray<float> posed = editor_.frame.positions();
    editor_.notices.clear();
    apply(editor_, ColorHandle{"low", 0x123456});
    calm();
    const auto color = [&] { return editor_.document->handles.front().color; };
    EXPECT_EQ(editor_.document->handles.front().name, "low") << "in its place";
    EXPECT_EQ(color(), 0x123456U);
    EXPECT_TRUE(editor_.document->posed);
    EXPECT_TRUE(editor_.notices.empty());
    apply(editor_, RenameHandle{"low", "foot"});
    calm();
    EXPECT_EQ(color(), 0x123456U);
    apply(editor_, UndoStep{});
    apply(editor_, UndoStep{});
    calm();
    EXPECT_FALSE(color().has_value());
    EXPECT_TRUE(editor_.document->posed);
    EXPECT_EQ(editor_.frame.positions(), posed);
    apply(editor_, RedoStep{});
    calm();
    EXPECT_EQ(color(), 0x123456U);
    apply(editor_, ColorHandle{"low", std::nullopt});
    calm();
    EXPECT_FALSE(color().has_value());
}

TEST_F(BarEditor, UndoSaysWhatOfAHandleChanged) {
    make_handles();
    EXPECT_EQ(words_of_undo(editor_), "new moving handle \"high\"");
    apply(editor_, ColorHandle{"high", 0x123456});
    calm();
    EXPECT_EQ(words_of_undo(editor_), "another colour for \"high\"");
    apply(editor_, SetPivot{glm::dvec3(0, 0, 2)});
    calm();
    EXPECT_EQ(words_of_undo(editor_), "the pivot of \"high\" moved");
    apply(editor_, ChangeHold{"high", false, 0.5});
    calm();
    EXPECT_EQ(words_of_undo(editor_), "\"high\" changed");
    apply(editor_, UndoStep{});
    calm();
    EXPECT_EQ(words_of_undo(editor_), "the pivot of \"high\" moved");
    EXPECT_EQ(words_of_redo(editor_), "\"high\" changed");
}

TEST_F(BarEditor, ADabOfTheBrushTakesWhatIsInItsCircleOrChoosesTheHandleThatItHits) {
    editor_.camera.orthographic = true;
    apply(editor_, SelectPointUnder{pixel_of({0, 0, 0}), SelectMode::replace, 60});
    const std::size_t in_circle = editor_.selected;
    EXPECT_GT(in_circle, 10U);
    apply(editor_, SelectPointUnder{pixel_of({0, 0, 0}), SelectMode::replace, 60, true});
    EXPECT_GT(editor_.selected, in_circle) << "and what is behind it";
    apply(editor_, SelectPointUnder{pixel_of({0, 0, 0}), SelectMode::remove, 60, true});
    EXPECT_EQ(editor_.selected, 0U);
    make_handles();
    editor_.chosen.clear();
    const std::size_t selected = editor_.selected;
    apply(editor_, SelectPointUnder{pixel_of({0, 0, 2.3}), SelectMode::replace, 60});
    EXPECT_EQ(editor_.chosen, "high");
    EXPECT_EQ(editor_.selected, selected);
    apply(editor_, SelectPointUnder{pixel_of({0, 0, 2.3}), SelectMode::add, 60});
    EXPECT_GT(editor_.selected, selected) << "points of handles, too";
}

TEST_F(BarEditor, APointThatLeavesRotationFreeSaysWhyItDoesNotTurn) {
    editor_.camera.orthographic = true;
    apply(editor_, SelectPointUnder{pixel_of({0, 0, 1})});
    ASSERT_EQ(editor_.selected, 1U);
    apply(editor_, MakeHandle{HandleRole::moving, "peg"});
    calm();
    EXPECT_TRUE(gizmo_of(editor_)->rotate) << "it turns what is around it";
    EXPECT_GT(least_falloff(editor_, *chosen_handle(editor_)), 0);
    apply(editor_, ChangeHold{"peg", true, 0});
    calm();
    EXPECT_FALSE(gizmo_of(editor_)->rotate);
    EXPECT_TRUE(gizmo_of(editor_)->translate);
    for (const char letter : {'R', 'S'}) {
        editor_.notices.clear();
        press(letter);
        EXPECT_FALSE(editor_.tools.drag);
        ASSERT_EQ(editor_.notices.size(), 1U);
        EXPECT_NE(editor_.notices[0].words.find("leaves rotation free"), std::string::npos);
    }
    press('G');
    EXPECT_TRUE(editor_.tools.drag);
    press(Key::escape);
    apply(editor_, SetPivot{glm::dvec3(0, 0, 0)}); // about which it can go round
    press('R');
    EXPECT_TRUE(editor_.tools.drag);
}

TEST_F(BarEditor, AnAmountThatIsTypedForNoMovingHandleIsNotTakenForOtherKeys) {
    make_handles();
    turn_chosen("30");
    apply(editor_, ChooseHandle{"low"});
    editor_.notices.clear();
    const Camera camera = editor_.camera;
    const auto refused = [&](const char* what) {
        press('G');
        press('Z');
        type("3.7");
        press(Key::enter);
        calm();
        ASSERT_EQ(editor_.notices.size(), 1U);
        EXPECT_NE(editor_.notices.back().words.find(what), std::string::npos) << editor_.notices.back().words;
        EXPECT_EQ(editor_.camera, camera);
        EXPECT_TRUE(editor_.document->posed) << "it was not committed";
        editor_.notices.clear();
    };
    refused("\"low\" is no moving handle");
    press('G');
    press('1');
    press(Key::tab);
    handle_input(editor_, KeyPress{key('2'), {.shift = true}}); // as digits are typed in France
    press(Key::enter);
    calm();
    EXPECT_TRUE(editor_.document->posed);
    editor_.notices.clear();
    press('G');
    EXPECT_FALSE(handle_input(editor_, KeyPress{Key::tab, {}})) << "it goes to a handle that moves";
    editor_.notices.clear();
    apply(editor_, DropChoice{});
    refused("No handle is chosen");
    press('G');
    move({401, 100});
    press('3');
    EXPECT_NE(editor_.camera, camera) << "the hand did something else";
    press('G');
    press(Key::enter);
    press(Key::enter);
    calm();
    EXPECT_FALSE(editor_.document->posed) << "one amount alone";
}

TEST_F(BarEditor, LargeHandlesNeedNoFalloff) {
    make_handles();
    for (const Handle& handle : editor_.document->handles) EXPECT_EQ(least_falloff(editor_, handle), 0);
}

// What is declared anew comes last, and the last one has what several hold.
TEST_F(BarEditor, AChangedHandleLeavesLaterOnesTheirPoints) {
    make_handles();
    for (const auto& [from, to, name] : {std::tuple{2.2, 2.4, "ring"}, {-1.0, 0.0, "belt"}}) {
        select_heights(from, to);
        apply(editor_, MakeHandle{HandleRole::moving, name});
        calm();
    }
    const std::vector<std::uint8_t> marks = editor_.marks;
    apply(editor_, ChangeHold{"high", false, 0.25});
    calm();
    std::vector<std::string> order;
    for (const Handle& handle : editor_.document->handles) order.push_back(handle.name);
    EXPECT_EQ(order, (std::vector<std::string>{"low", "high", "ring", "belt"}));
    EXPECT_EQ(editor_.marks, marks);
    apply(editor_, UndoStep{});
    calm();
    EXPECT_EQ(chosen_handle(editor_)->name, "belt");
    EXPECT_EQ(editor_.document->handles[1].falloff, 0) << "all of it is one step";
    apply(editor_, ChangeRole{"low", HandleRole::moving}); // which shares points with nobody
    calm();
    EXPECT_EQ(editor_.document->handles.back().name, "low");
}

TEST_F(BarEditor, AHandleIsGivenTheSelectionAndLetsGoOfIt) {
    make_handles();
    const std::vector<std::uint8_t> made = editor_.marks;
    select_heights(2.3, 3); // of "high", which ends at 2.5
    apply(editor_, MakeHandle{HandleRole::moving, "tip"});
    calm();
    const auto held = [&](const char* name) {
        const auto& handles = editor_.document->handles;
        const auto number = std::ranges::find(handles, name, &Handle::name) - handles.begin();
        return static_cast<std::size_t>(std::ranges::count(editor_.marks, handle_mark(std::size_t(number))));
    };
    const std::size_t high = held("high"), tip = held("tip");
    EXPECT_EQ(high, points_between(2, 2.3));
    editor_.notices.clear();
    select_heights(1, 2.4);
    apply(editor_, AssignPoints{"high", SelectMode::add});
    calm();
    EXPECT_EQ(held("high"), points_between(1, 2.4));
    EXPECT_EQ(held("tip"), points_between(2.4, 3)) << "what was not asked for is left to it";
    EXPECT_EQ(editor_.selected, 0U);
    EXPECT_NE(editor_.notices.back().words.find("\"high\" takes"), std::string::npos);
    EXPECT_NE(editor_.notices.back().words.find("from \"tip\""), std::string::npos);

    select_heights(2.2, 3);
    apply(editor_, AssignPoints{"high", SelectMode::remove});
    calm();
    EXPECT_EQ(held("high"), points_between(1, 2.2));
    EXPECT_EQ(held("tip"), tip) << "it had them before";

    select_heights(-1, 0);
    apply(editor_, AssignPoints{"high", SelectMode::replace});
    calm();
    EXPECT_EQ(held("high"), points_between(-1, 0));

    for (int step = 0; step < 6; ++step) apply(editor_, UndoStep{}); // with their selections
    calm();
    EXPECT_EQ(held("high"), high);
    EXPECT_EQ(held("tip"), tip);
    EXPECT_EQ(editor_.selected, 0U);
    for (int step = 0; step < 2; ++step) apply(editor_, UndoStep{});
    calm();
    EXPECT_EQ(editor_.marks, made);
}

TEST_F(BarEditor, PointsThatChangeNothingAreSaidAndAreNoStep) {
    make_handles();
    const auto told = [&](SelectMode mode) {
        editor_.notices.clear();
        const std::size_t steps = editor_.past.size(), selected = editor_.selected;
        apply(editor_, AssignPoints{"high", mode});
        calm();
        EXPECT_EQ(editor_.past.size(), steps);
        EXPECT_EQ(editor_.selected, selected);
        return editor_.notices.size() == 1 ? editor_.notices.back().words : "";
    };
    EXPECT_NE(told(SelectMode::add).find("Select the points first"), std::string::npos);
    select_heights(2, 3);
    EXPECT_NE(told(SelectMode::add).find("already"), std::string::npos);
    EXPECT_NE(told(SelectMode::replace).find("already"), std::string::npos);
    EXPECT_NE(told(SelectMode::remove).find("would hold no point"), std::string::npos);
    select_heights(0, 1);
    EXPECT_NE(told(SelectMode::remove).find("holds none"), std::string::npos);
}

TEST_F(BarEditor, AHandleIsGivenBackWhatALaterOneTook) {
    make_handles();
    const std::vector<std::uint8_t> made = editor_.marks;
    for (const SelectMode mode : {SelectMode::add, SelectMode::replace}) {
        select_heights(2.3, 3);
        apply(editor_, MakeHandle{HandleRole::moving, "tip"});
        calm();
        select_heights(mode == SelectMode::add ? 2.3 : 2, 3);
        apply(editor_, AssignPoints{"high", mode});
        calm();
        const std::vector<Handle>& handles = editor_.document->handles;
        ASSERT_EQ(handles.back().name, "high");
        EXPECT_EQ(
            static_cast<std::size_t>(std::ranges::count(editor_.marks, handle_mark(handles.size() - 1))),
            points_between(2, 3));
        for (int step = 0; step < 4; ++step) apply(editor_, UndoStep{}); // with their selections
        calm();
        EXPECT_EQ(editor_.marks, made);
    }
}

TEST_F(BarEditor, EscapeDropsTheSelectionAndThenTheChosenHandle) {
    make_handles();
    select_heights(0, 1);
    press(Key::escape);
    EXPECT_EQ(editor_.selected, 0U);
    EXPECT_EQ(editor_.chosen, "high");
    press(Key::escape);
    EXPECT_EQ(editor_.chosen, "");
    EXPECT_FALSE(gizmo_of(editor_));
    press(Key::escape);
    apply(editor_, UndoStep{});
    EXPECT_EQ(editor_.selected, points_between(0, 1));
}

TEST_F(BarEditor, WhatIsSaidOfAPoseThatWasCommittedFirstGoesWithItsUndoing) {
    make_handles();
    turn_chosen("40");
    editor_.notices.clear();
    apply(editor_, ChangeHold{"high", true, 0});
    calm();
    ASSERT_EQ(editor_.notices.size(), 1U);
    EXPECT_EQ(editor_.notices.back().about, Notice::About::committed);
    apply(editor_, UndoStep{});
    calm();
    EXPECT_EQ(editor_.notices.back().about, Notice::About::committed);
    EXPECT_EQ(editor_.notices.back().words, "") << "it holds no longer";
}

TEST_F(BarEditor, HandlesMadeInQuickSuccessionHaveNamesOfTheirOwn) {
    editor_.camera.orthographic = true;
    select_heights(2, 3);
    apply(editor_, MakeHandle{HandleRole::moving, ""});
    select_heights(-3, -2);
    apply(editor_, MakeHandle{HandleRole::moving, ""});
    calm();
    ASSERT_EQ(editor_.document->handles.size(), 2U);
    EXPECT_EQ(editor_.document->handles[1].name, "handle 2");
}

// A fixed handle that is made leaves the moving one chosen, so as to be moved; the name that is typed next is
// for the new one all the same.
TEST_F(BarEditor, WhatWasJustMadeIsWhatIsNamed) {
    editor_.camera.orthographic = true;
    select_heights(2, 3);
    apply(editor_, MakeHandle{HandleRole::moving, "high"});
    select_heights(-3, -2);
    apply(editor_, MakeHandle{HandleRole::fixed, "low"});
    EXPECT_FALSE(handle_to_name(editor_)) << "and not the other one meanwhile";
    calm();
    EXPECT_EQ(editor_.chosen, "high");
    ASSERT_TRUE(handle_to_name(editor_));
    EXPECT_EQ(handle_to_name(editor_)->name, "low");
    apply(editor_, ChooseHandle{"high"});
    EXPECT_EQ(handle_to_name(editor_)->name, "high");
    apply(editor_, MakeHandle{HandleRole::fixed, "again"}); // nothing is selected
    EXPECT_EQ(handle_to_name(editor_)->name, "high");
    select_heights(-1, 0);
    apply(editor_, MakeHandle{HandleRole::fixed, "waist"});
    calm();
    EXPECT_EQ(handle_to_name(editor_)->name, "waist");
    apply(editor_, UndoStep{});
    calm();
    EXPECT_EQ(handle_to_name(editor_)->name, "high");
}

} // namespace knead::test
