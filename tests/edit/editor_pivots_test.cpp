// Where handles turn about, and how that goes along.

#include "edit/editor_bar.h"

namespace knead::test {

namespace {

// Saves the session and opens it in another editor, as a window would that comes after. False if it does not
// come up.
bool open_saved_in(Editor& again, Editor& editor, const std::filesystem::path& session) {
    save_session(editor, session, true);
    wait_until_idle(*editor.live);
    again.viewport = {800, 800};
    OpenRequest request;
    request.file = session;
    request.device = "reference";
    open(again, request);
    return wait_until([&] { return refresh(again) && again.document; });
}

} // namespace

TEST_F(BarEditor, APivotGoesInsideOfWhatIsClickedOrSelected) {
    make_handles();
    calm();
    apply(editor_, ChooseHandle{"high"});
    apply(editor_, LookAtSide{Side::front});
    const auto pivot = [&] { return pivot_of(editor_, "high").value_or(glm::dvec3(99)); };
    // The bar is 1 wide and deep, and hollow: its middle is half way through.
    const glm::dvec3 on_front(0.1, -0.5, 1.2);
    apply(editor_, SetPivotInside{project(editor_.camera, editor_.viewport, on_front)->pixel});
    EXPECT_NEAR(pivot().y, 0, 0.02);
    EXPECT_NEAR(pivot().z, 1.2, 0.3);
    const glm::dvec3 clicked = pivot();
    apply(editor_, SetPivotInside{{1, 1}}); // beside it
    EXPECT_EQ(pivot(), clicked);
    select_heights(0.4, 0.9);
    apply(editor_, SetPivotToSelection{});
    EXPECT_LT(glm::distance(pivot(), glm::dvec3(0, 0, 0.65)), 0.1);
    apply(editor_, UndoStep{});
    EXPECT_EQ(pivot(), clicked);
    apply(editor_, UndoStep{}); // the selection
    apply(editor_, UndoStep{});
    EXPECT_FALSE(pivot_of(editor_, "high"));
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
    apply(editor_, ResetPoses{{"high"}});
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
    for (const bool commits : {false, true}) {
        if (commits) apply(editor_, CommitPose{});
        Editor again{1};
        ASSERT_TRUE(open_saved_in(again, editor_, folder_ / "kept.knead"));
        ASSERT_TRUE(pivot_of(again, "high"));
        EXPECT_LT(glm::distance(*pivot_of(again, "high"), pivot), 1e-6);
        EXPECT_FALSE(pivot_of(again, "middle"));
        apply(again, UndoStep{});
        EXPECT_FALSE(pivot_of(again, "high")) << "the handle may be elsewhere then";
        apply(again, RedoStep{});
        EXPECT_TRUE(pivot_of(again, "high"));
        wait_until_idle(*again.live);
        refresh(again);
        apply(again, ChooseHandle{"high"});
        apply(again, SetPivot{}); // of which no line told
        wait_until_idle(*again.live);
        refresh(again);
        EXPECT_FALSE(pivot_of(again, "high")) << "it stays away";
        apply(again, UndoStep{});
        EXPECT_TRUE(pivot_of(again, "high"));
    }
}

TEST_F(BarEditor, APivotIsSavedWithOrWithoutADragAndGoesBackAndForthWhenOpenedAgain) {
    make_handles();
    const glm::dvec3 joint(0.5, 0, 1.5), other(0.25, 0, 1);
    apply(editor_, SetPivot{joint});
    calm();
    EXPECT_TRUE(has_unsaved_session(editor_));
    turn_chosen("30"); // about it
    apply(editor_, CommitPose{});
    calm();
    apply(editor_, SetPivot{other});
    calm();
    Editor again{1};
    ASSERT_TRUE(open_saved_in(again, editor_, folder_ / "kept.knead"));
    const auto is_at = [&](const std::optional<glm::dvec3>& place) {
        const auto now = pivot_of(again, "high");
        return now.has_value() == place.has_value() && (!now || glm::distance(*now, *place) < 1e-6);
    };
    EXPECT_TRUE(is_at(other));
    apply(again, UndoStep{});
    EXPECT_TRUE(is_at(joint)) << "of the commit";
    for (int step = 0; step < 2; ++step) apply(again, UndoStep{}); // that, and the turn
    EXPECT_TRUE(is_at(joint)) << "at rest";
    apply(again, UndoStep{});
    EXPECT_TRUE(is_at({}));
    for (int step = 0; step < 4; ++step) apply(again, RedoStep{});
    EXPECT_TRUE(is_at(other));
    wait_until_idle(*again.live);
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
    ASSERT_TRUE(editor_.document->handles.back().pivot) << "and the session has it";
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
    apply(editor_, DeleteHandles{{"high"}});
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

// Which takes a commit, that takes the pivots along.
TEST_F(BarEditor, ChangingAHandleWhileAnotherIsPosedLeavesThatOneItsPivotAndItsPoints) {
    make_handles();
    select_heights(1.5, 2.5); // part of it is the other one's
    apply(editor_, MakeHandle{HandleRole::moving, "collar"});
    calm();
    apply(editor_, SetPivot{glm::dvec3(0.5, 0, 1.5)});
    transform_chosen('G', 'X', "1");
    apply(editor_, ChangeHold{"high", true, 0});
    calm();
    EXPECT_FALSE(editor_.document->posed);
    const auto& handles = editor_.document->handles;
    ASSERT_EQ(handles.size(), 3U);
    EXPECT_EQ(handles.back().name, "collar") << "it still has what both hold";
    ASSERT_TRUE(handles.back().pivot);
    EXPECT_LT((*handles.back().pivot - Vec3d(1.5, 0, 1.5)).norm(), 1e-6) << "where it was taken";
}

TEST_F(BarEditor, ANewHandleOfAnOldNameHasNoPivotWhenOpenedAgain) {
    make_handles();
    apply(editor_, ChooseHandle{"high"});
    calm();
    editor_.pivots["high"] = {0.5, 0, 1.5}; // as an older session had it, which told of none
    turn_chosen("30");
    apply(editor_, CommitPose{});
    apply(editor_, DeleteHandles{{"high"}});
    select_heights(-0.5, 0.5);
    apply(editor_, MakeHandle{HandleRole::moving, "high"});
    calm();
    Editor again{1};
    ASSERT_TRUE(open_saved_in(again, editor_, folder_ / "kept.knead"));
    EXPECT_FALSE(pivot_of(again, "high"));
    wait_until_idle(*again.live);
}

TEST_F(BarEditor, AResetThatIsGivenTwiceIsOne) {
    make_handles();
    const glm::dvec3 joint(0.5, 0, 1.5);
    apply(editor_, SetPivot{joint});
    turn_chosen("360");
    const std::size_t steps = editor_.past.size();
    apply(editor_, ResetPoses{{"high"}});
    apply(editor_, ResetPoses{{"high"}});
    calm();
    EXPECT_EQ(editor_.past.size(), steps + 1);
    EXPECT_LT(glm::distance(*pivot_of(editor_, "high"), joint), 1e-9);
    apply(editor_, ResetPoses{{"high"}});
    calm();
    EXPECT_EQ(editor_.past.size(), steps + 1) << "it is at rest";
}

} // namespace knead::test
