// Handles in the editor: made, changed, mirrored.

#include "edit/editor_bar.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace knead::test {

namespace {

constexpr double pi = std::numbers::pi;

} // namespace

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

TEST_F(BarEditor, MirroringTakesThePointsAndThePoseAcross) {
    make_handles();
    transform_chosen('R', 'X', "40");
    const Eigen::AngleAxisd first(editor_.document->motions[1].rotation);
    apply(editor_, MirrorHandle{"high", 2});
    calm();
    ASSERT_EQ(editor_.document->handles.size(), 3U);
    const Handle& mirrored = editor_.document->handles[2];
    EXPECT_EQ(mirrored.name, "high mirrored");
    EXPECT_NEAR(static_cast<double>(mirrored.points->size()), static_cast<double>(points_between(-3, -2)),
                60);
    const Eigen::AngleAxisd turn(editor_.document->motions[2].rotation);
    EXPECT_NEAR(turn.angle(), 40 * pi / 180, 1e-9);
    EXPECT_NEAR(turn.axis().x() * first.axis().x(), -1, 1e-9);
}

// Also by more than half a turn, which by the shortest way would be less the other way round.
TEST_F(BarEditor, AMirroredHandleIsWoundUpAsTheOtherIs) {
    editor_.camera.orthographic = true;
    select_heights(-0.2, 0.2);
    apply(editor_, MakeHandle{HandleRole::fixed, "middle"});
    select_heights(2, 3);
    apply(editor_, MakeHandle{HandleRole::moving, "high"});
    calm();
    const auto& rest = editor_.opened.opened->positions;
    const auto turn_at = [&](double z) { // about the bar's axis, of a slice
        double sine = 0, cosine = 0;
        for (std::size_t i = 0; i < rest.size(); i += 3) {
            if (std::abs(static_cast<double>(rest[i + 2]) - z) > 0.1) continue;
            const float* now = editor_.frame.positions().data() + i;
            sine += static_cast<double>(rest[i] * now[1] - rest[i + 1] * now[0]);
            cosine += static_cast<double>(rest[i] * now[0] + rest[i + 1] * now[1]);
        }
        return std::atan2(sine, cosine);
    };
    const auto twist_to = [&](double end) { // from the middle, in degrees
        double sum = 0;
        for (int step = 0; step < 20; ++step)
            sum += std::remainder(turn_at(end * (step + 1) / 20) - turn_at(end * step / 20), 2 * pi);
        return sum * 180 / pi;
    };
    apply(editor_, ChooseHandle{"high"});
    apply(editor_, BeginDrag{glm::dvec3(0, 0, 2)});
    Transform twist;
    twist.axis = {0, 0, 1};
    twist.angle = 190 * pi / 180;
    apply(editor_, DragTo{twist});
    apply(editor_, EndDrag{});
    calm();
    apply(editor_, MirrorHandle{"high", 2});
    calm();
    EXPECT_EQ(editor_.document->handles.back().name, "high mirrored");
    EXPECT_NEAR(twist_to(2), 190, 5);
    EXPECT_NEAR(twist_to(-2), 190, 5);
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
    apply(editor_, DeleteHandle{"lowest"}); // the editor has not seen any of these when the next comes
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

TEST_F(BarEditor, MirrorsAPoseInTheShapeThatWasCommitted) {
    editor_.camera.orthographic = true;
    apply(editor_, ChangeSelection{SelectionStep::all});
    apply(editor_, MakeHandle{HandleRole::moving, "whole"});
    calm();
    transform_chosen('G', 'Z', "3");
    press(Key::enter); // committed
    calm();
    apply(editor_, DeleteHandle{"whole"});
    calm();
    apply(editor_, FrameView{});
    select_heights(2.5, 3.5); // the middle of the bar is at 3 now
    apply(editor_, MakeHandle{HandleRole::fixed, "middle"});
    select_heights(5, 6);
    apply(editor_, MakeHandle{HandleRole::moving, "high"});
    calm();
    turn_chosen("40");
    apply(editor_, MirrorHandle{"high", 2});
    calm();
    ASSERT_EQ(editor_.document->handles.size(), 3U);
    const std::optional<glm::dvec3> high = middle_of(editor_, editor_.document->handles[1]);
    const std::optional<glm::dvec3> low = middle_of(editor_, editor_.document->handles[2]);
    ASSERT_TRUE(high && low);
    EXPECT_NEAR(low->z + high->z, 6, 0.05) << "across the plane z = 3";
    EXPECT_NEAR(low->x, high->x, 0.05);
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
    refused("Click a moving handle");
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

TEST_F(BarEditor, EveryHandleKeepsItsPivotAndTakesItAlong) {
    make_handles();
    select_heights(-0.5, 0.5);
    apply(editor_, MakeHandle{HandleRole::moving, "middle"});
    calm();
    const auto at = [&](const char* handle) {
        apply(editor_, ChooseHandle{handle});
        return gizmo_of(editor_)->center;
    };
    const glm::dvec3 middle = at("high"), joint(0, 0, 2);
    apply(editor_, SetPivot{glm::dvec3(1, 0, 2), SetPivot::Stage::moving});
    apply(editor_, SetPivot{joint});
    EXPECT_NE(at("middle"), joint);
    apply(editor_, DropChoice{});
    EXPECT_EQ(at("high"), joint) << "also after another was chosen, and none";

    turn_chosen("90"); // about the view's axis, y
    EXPECT_LT(glm::distance(at("high"), joint), 1e-9);
    transform_chosen('G', 'Z', "1");
    EXPECT_LT(glm::distance(at("high"), joint + glm::dvec3(0, 0, 1)), 1e-9) << "it goes along";
    apply(editor_, ResetPose{"high"});
    calm();
    EXPECT_LT(glm::distance(at("high"), joint), 1e-9);
    apply(editor_, UndoStep{});
    EXPECT_LT(glm::distance(at("high"), joint + glm::dvec3(0, 0, 1)), 1e-9);
    apply(editor_, RenameHandle{"high", "top"});
    calm();
    EXPECT_LT(glm::distance(at("top"), joint + glm::dvec3(0, 0, 1)), 1e-9);
    for (int step = 0; step < 3; ++step) apply(editor_, UndoStep{}); // the name, the shift, the turn
    calm();
    EXPECT_EQ(at("high"), joint);

    const std::size_t steps = editor_.past.size();
    apply(editor_, UndoStep{});
    EXPECT_EQ(editor_.past.size(), steps - 1) << "one step, however often the hand moved";
    EXPECT_EQ(at("high"), middle);
    apply(editor_, RedoStep{});
    EXPECT_EQ(at("high"), joint);
    apply(editor_, SetPivot{glm::dvec3(3, 3, 3), SetPivot::Stage::moving});
    apply(editor_, SetPivot{{}, SetPivot::Stage::given_up});
    EXPECT_EQ(at("high"), joint);
    EXPECT_EQ(editor_.past.size(), steps) << "nothing moved";
    apply(editor_, SetPivot{});
    EXPECT_EQ(at("high"), middle);
}

TEST_F(BarEditor, PivotsAreThereWhenTheSessionIsOpenedAgain) {
    make_handles();
    select_heights(-0.5, 0.5);
    apply(editor_, MakeHandle{HandleRole::moving, "middle"});
    calm();
    turn_chosen("20"); // about its middle
    apply(editor_, ChooseHandle{"high"});
    editor_.pivots["high"] = {0.5, 0, 1.5};
    turn_chosen("30");
    turn_chosen("40");
    const glm::dvec3 pivot = *pivot_of(editor_, "high");
    const std::filesystem::path kept = folder_ / "kept.knead";
    for (const bool commits : {false, true}) {
        if (commits) apply(editor_, CommitPose{});
        save_session(editor_, kept, true);
        calm();
        Editor again{1};
        again.viewport = {800, 800};
        OpenRequest request;
        request.file = kept;
        request.device = "reference";
        open(again, request);
        ASSERT_TRUE(wait_until([&] { return refresh(again) && again.document; }));
        ASSERT_TRUE(pivot_of(again, "high"));
        EXPECT_LT(glm::distance(*pivot_of(again, "high"), pivot), 1e-6);
        EXPECT_FALSE(pivot_of(again, "middle"));
    }
}

TEST_F(BarEditor, AMirroredHandleHasItsPivotAcross) {
    make_handles();
    apply(editor_, ChooseHandle{"high"});
    calm();
    editor_.pivots["high"] = {0.4, 0.1, 2};
    turn_chosen("30");
    apply(editor_, MirrorHandle{"high", 2});
    calm();
    const std::string made = editor_.document->handles.back().name;
    ASSERT_NE(made, "high");
    const glm::dvec3 there = *pivot_of(editor_, "high"), across = pivot_of(editor_, made).value_or(there);
    EXPECT_NEAR(across.x, there.x, 0.05);
    EXPECT_NEAR(across.y, there.y, 0.05);
    EXPECT_LT(across.z, -1);
    apply(editor_, UndoStep{});
    calm();
    EXPECT_FALSE(pivot_of(editor_, made));
}

TEST_F(BarEditor, AHandleOfANameThatWasBeginsWithNoPivot) {
    make_handles();
    const glm::dvec3 middle = gizmo_of(editor_)->center, elsewhere(5, 5, 5);
    const auto pivot = [&] {
        calm();
        apply(editor_, ChooseHandle{"high"});
        return gizmo_of(editor_)->center;
    };
    apply(editor_, SetPivot{elsewhere});
    apply(editor_, DeleteHandle{"high"});
    calm();
    select_heights(2, 3);
    apply(editor_, MakeHandle{HandleRole::moving, "high"});
    EXPECT_EQ(pivot(), middle);
    for (int step = 0; step < 3; ++step) apply(editor_, UndoStep{}); // made, selected, deleted
    EXPECT_EQ(pivot(), elsewhere) << "it comes back with the handle that was deleted";
    apply(editor_, RenameHandle{"high", "top"});
    calm();
    select_heights(0, 1);
    apply(editor_, MakeHandle{HandleRole::moving, "high"});
    EXPECT_NE(pivot(), elsewhere);
}

TEST_F(BarEditor, LargeHandlesNeedNoFalloff) {
    make_handles();
    for (const Handle& handle : editor_.document->handles) EXPECT_EQ(least_falloff(editor_, handle), 0);
}

TEST_F(BarEditor, MirroringElsewhereMakesAnotherHandle) {
    make_handles();
    const auto names = [&] {
        std::vector<std::string> all;
        for (const Handle& handle : editor_.document->handles) all.push_back(handle.name);
        return all;
    };
    for (const int axis : {0, 2, 2}) { // on itself; across; and there again
        apply(editor_, MirrorHandle{"high", axis});
        calm();
    }
    EXPECT_EQ(names(), (std::vector<std::string>{"low", "high", "high mirrored", "high mirrored 2"}));
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
    const LineArray<float> rest = editor_.frame.positions();
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

} // namespace knead::test
