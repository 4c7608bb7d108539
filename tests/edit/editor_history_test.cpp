// What undo, redo and playing do to the editor beside its document: the handle that is chosen, the pose that
// is reset.

#include "edit/editor_bar.h"
#include "edit/editor_import.h"

namespace knead::test {

TEST_F(BarEditor, UndoAndRedoBringTheChosenHandleBack) {
    make_handles();
    editor_.camera.orthographic = true;
    select_heights(-0.2, 0.2);
    apply(editor_, MakeHandle{HandleRole::moving, "belt"});
    calm();
    ASSERT_TRUE(chosen_handle(editor_));
    EXPECT_EQ(editor_.chosen, "belt");
    apply(editor_, UndoStep{});
    calm();
    EXPECT_EQ(editor_.chosen, "high") << "which was chosen when the belt was made";
    apply(editor_, ChooseHandle{"low"});
    apply(editor_, RedoStep{});
    calm();
    EXPECT_EQ(editor_.chosen, "belt");
    ASSERT_TRUE(chosen_handle(editor_));
    EXPECT_TRUE(gizmo_of(editor_));
    apply(editor_, RenameHandle{"belt", "girdle"});
    calm();
    apply(editor_, UndoStep{});
    calm();
    EXPECT_EQ(editor_.chosen, "belt");
    apply(editor_, DeleteHandles{{"belt"}});
    calm();
    EXPECT_FALSE(chosen_handle(editor_));
    apply(editor_, UndoStep{});
    calm();
    ASSERT_TRUE(chosen_handle(editor_)) << "a deleted handle comes back chosen";
    EXPECT_EQ(chosen_handle(editor_)->name, "belt");
}

TEST_F(BarEditor, SaysWhatIsTakenBackAndDoneAgain) {
    make_handles();
    const std::string high = R"(new moving handle "high")";
    EXPECT_EQ(words_of_undo(editor_), high);
    EXPECT_EQ(words_of_redo(editor_), "");
    apply(editor_, UndoStep{});
    EXPECT_EQ(editor_.just_done, "Taken back: " + high);
    calm();
    EXPECT_EQ(words_of_redo(editor_), high);
    apply(editor_, LookAtSide{Side::right});
    EXPECT_NE(editor_.just_done, "") << "who only looks round has told nothing else";
    apply(editor_, RedoStep{});
    EXPECT_EQ(editor_.just_done, "Done again: " + high);
    calm();
    select_heights(-1, 1);
    EXPECT_EQ(editor_.just_done, "");
    EXPECT_EQ(words_of_undo(editor_), "a selection, or what is hidden");
    apply(editor_, DeleteHandles{{"high"}});
    EXPECT_EQ(editor_.just_done, R"("high" is deleted, and its points stay; Ctrl+Z takes it back)");
    calm();
    apply(editor_, UndoStep{});
    EXPECT_EQ(editor_.just_done, R"(Taken back: "high" deleted)");
}

TEST_F(BarEditor, UndoingADragChoosesTheHandleThatWasDragged) {
    make_handles();
    turn_chosen("40");
    apply(editor_, ChooseHandle{"low"});
    apply(editor_, UndoStep{});
    calm();
    EXPECT_EQ(editor_.chosen, "high");
}

TEST_F(BarEditor, AnUndoneSelectionLeavesTheChosenHandleAlone) {
    make_handles();
    select_heights(-1, 1);
    apply(editor_, ChooseHandle{"low"});
    apply(editor_, UndoStep{});
    EXPECT_EQ(editor_.chosen, "low");
}

TEST_F(BarEditor, MirroringAfterACommitSaysThatThereIsNoPose) {
    make_handles();
    turn_chosen("40");
    apply(editor_, CommitPose{});
    calm();
    editor_.notices.clear();
    apply(editor_, MirrorHandle{"high", 2});
    calm();
    EXPECT_EQ(editor_.document->handles.size(), 3U);
    EXPECT_FALSE(editor_.document->posed);
    ASSERT_EQ(editor_.notices.size(), 1U);
    EXPECT_NE(editor_.notices[0].words.find("no pose to mirror"), std::string::npos);
    EXPECT_EQ(editor_.chosen, "high mirrored");
}

TEST_F(BarEditor, ResettingAPoseOfAWholeTurnUnwindsIt) {
    make_handles();
    const LineArray<float> rest = editor_.frame.positions();
    transform_chosen('R', 'Z', "360");
    apply(editor_, ResetPoses{{"high"}});
    calm();
    ASSERT_EQ(editor_.frame.positions().size(), rest.size());
    float farthest = 0;
    for (std::size_t i = 0; i < rest.size(); ++i)
        farthest = std::max(farthest, std::abs(editor_.frame.positions()[i] - rest[i]));
    EXPECT_LT(farthest, 1e-3F);
    apply(editor_, UndoStep{});
    calm();
    EXPECT_NE(editor_.frame.positions(), rest);
}

TEST_F(BarEditor, WhatIsPostedIsUnsavedBeforeItIsDone) {
    EXPECT_FALSE(has_unsaved_session(editor_));
    select_heights(2, 3);
    apply(editor_, MakeHandle{HandleRole::moving, {}});
    EXPECT_TRUE(has_unsaved_session(editor_));
    calm();
    editor_.live->save_session(folder_ / "kept.knead");
    calm();
    EXPECT_FALSE(has_unsaved_session(editor_));
    press('R');
    EXPECT_TRUE(has_unsaved_session(editor_)) << "a drag is under way";
    press(Key::escape);
    calm();
    EXPECT_FALSE(has_unsaved_session(editor_));
}

TEST_F(BarEditor, ASliderThatMovesOnIsUnsavedBeforeItIsDone) {
    SettingsChange change;
    change.stiffness = 2;
    apply(editor_, ChangeSettings{change});
    calm();
    editor_.live->save_session(folder_ / "kept.knead");
    calm();
    EXPECT_FALSE(has_unsaved_session(editor_));
    change.stiffness = 3;
    apply(editor_, ChangeSettings{change});
    EXPECT_TRUE(has_unsaved_session(editor_));
    calm();
    EXPECT_TRUE(has_unsaved_session(editor_));
}

TEST_F(BarEditor, NothingIsDoneThatAFileBeingOpenedWouldTakeAway) {
    const std::size_t steps = editor_.past.size();
    open(editor_, editor_.opening_request);
    select_heights(2, 3);
    apply(editor_, MakeHandle{HandleRole::moving, {}});
    EXPECT_EQ(editor_.past.size(), steps);
    ASSERT_FALSE(editor_.notices.empty());
    EXPECT_NE(editor_.notices.back().words.find("being opened"), std::string::npos);
    cancel_opening(editor_);
}

TEST_F(BarEditor, HandlesOfAnotherSessionAreNoWayRoundThat) {
    make_handles();
    save_session(editor_, folder_ / "a.knead", false);
    EXPECT_TRUE(editor_.saving);
    calm();
    EXPECT_FALSE(editor_.saving);
    turn_chosen("40");
    calm();
    apply(editor_, UndoStep{.to_look = true});
    calm();
    handles_from_session(editor_, folder_ / "a.knead");
    EXPECT_TRUE(can_redo(editor_));
    EXPECT_NE(editor_.notices.back().words.find("earlier step"), std::string::npos);
    apply(editor_, RedoStep{});
    calm();
    const std::size_t steps = editor_.past.size();
    handles_from_session(editor_, folder_ / "a.knead");
    EXPECT_EQ(editor_.past.size(), steps + 1);
}

TEST_F(BarEditor, AStepThatIsRefusedLosesNothingToRedo) {
    make_handles();
    turn_chosen("40");
    const LineArray<float> turned = editor_.frame.positions();
    apply(editor_, UndoStep{});
    calm();
    ASSERT_TRUE(can_redo(editor_));
    Transform far;
    far.shift = {1e25, 0, 0};
    apply(editor_, BeginDrag{});
    apply(editor_, DragTo{far});
    apply(editor_, EndDrag{});
    calm();
    ASSERT_FALSE(editor_.notices.empty());
    EXPECT_NE(editor_.notices.back().words.find("out of all range"), std::string::npos)
        << editor_.notices.back().words;
    EXPECT_EQ(editor_.notices.back().words.find("frames"), std::string::npos) << "there is no file here";
    ASSERT_TRUE(can_redo(editor_));
    apply(editor_, RedoStep{});
    calm();
    EXPECT_EQ(editor_.frame.positions(), turned);
}

// The list still shows the handle whose making was undone.
TEST_F(BarEditor, DeletingAHandleThatIsGoneCommitsNothing) {
    make_handles();
    apply(editor_, ChooseHandle{"high"});
    turn_chosen("40");
    select_heights(-0.5, 0.5);
    apply(editor_, MakeHandle{HandleRole::moving, "third"});
    calm();
    apply(editor_, UndoStep{});
    apply(editor_, DeleteHandles{{"third"}});
    calm();
    EXPECT_TRUE(editor_.document->posed);
    ASSERT_TRUE(can_redo(editor_));
    apply(editor_, RedoStep{});
    calm();
    EXPECT_EQ(editor_.document->handles.size(), 3U);
}

TEST_F(BarEditor, AnUndoThatIsStillToBeCarriedOutIsUnsaved) {
    make_handles();
    turn_chosen("40");
    save_session(editor_, folder_ / "a.knead", false);
    calm();
    ASSERT_FALSE(has_unsaved_session(editor_));
    apply(editor_, UndoStep{});
    EXPECT_TRUE(has_unsaved_session(editor_)) << "whoever closes the window now has to be asked";
    calm();
    EXPECT_TRUE(has_unsaved_session(editor_));
    apply(editor_, RedoStep{});
    calm();
    EXPECT_FALSE(has_unsaved_session(editor_));
}

TEST_F(BarEditor, WhoeverLooksBackLosesNothingByAnAct) {
    make_handles();
    turn_chosen("40");
    calm();
    const LineArray<float> turned = editor_.frame.positions();
    const std::size_t selected = editor_.selected;
    apply(editor_, UndoStep{.to_look = true});
    calm();
    editor_.notices.clear();
    apply(editor_, ChangeSelection{SelectionStep::invert});
    EXPECT_EQ(editor_.selected, selected);
    press('R');
    EXPECT_FALSE(editor_.tools.drag || editor_.drag);
    ASSERT_EQ(editor_.notices.size(), 2U);
    EXPECT_NE(editor_.notices.back().words.find("earlier step"), std::string::npos);
    apply(editor_, RedoStep{});
    calm();
    EXPECT_EQ(editor_.frame.positions(), turned);
    apply(editor_, ChangeSelection{SelectionStep::invert});
    EXPECT_NE(editor_.selected, selected) << "at the last step there is nothing to lose";

    apply(editor_, UndoStep{});
    apply(editor_, UndoStep{});
    calm();
    apply(editor_, ChangeSelection{SelectionStep::invert});
    EXPECT_FALSE(can_redo(editor_)) << "who takes a step back means it";
}

TEST_F(BarEditor, WhoeverRedoesAStepWhileLookingBackGoesOnLooking) {
    make_handles();
    turn_chosen("40");
    save_session(editor_, folder_ / "a.knead", false);
    calm();
    const std::size_t home = editor_.past.size();
    for (int step = 0; step < 2; ++step) apply(editor_, UndoStep{.to_look = true});
    apply(editor_, RedoStep{});
    calm();
    EXPECT_TRUE(looks_back(editor_));
    EXPECT_EQ(editor_.looks_from, home) << "where looking ends";
    apply(editor_, RedoStep{.to_look = true});
    calm();
    EXPECT_FALSE(looks_back(editor_));
    EXPECT_FALSE(has_unsaved_session(editor_));
}

TEST_F(BarEditor, WhoeverIsBackFromLookingGoesOnThoughThereIsSomethingToRedo) {
    make_handles();
    turn_chosen("40");
    turn_chosen("20");
    apply(editor_, UndoStep{}); // of the second turn, which stays to be redone
    calm();
    const std::size_t home = editor_.past.size();
    apply(editor_, UndoStep{.to_look = true});
    EXPECT_TRUE(looks_back(editor_));
    apply(editor_, RedoStep{.to_look = true});
    calm();
    EXPECT_EQ(editor_.past.size(), home);
    EXPECT_FALSE(looks_back(editor_));
    editor_.notices.clear();
    turn_chosen("10");
    EXPECT_EQ(editor_.past.size(), home + 1);
    EXPECT_TRUE(editor_.notices.empty());
    EXPECT_FALSE(can_redo(editor_));
}

TEST_F(BarEditor, ALaterStepIsNoEarlierOne) {
    make_handles();
    turn_chosen("40");
    apply(editor_, UndoStep{});
    calm();
    apply(editor_, UndoStep{.to_look = true});
    apply(editor_, RedoStep{.to_look = true});
    apply(editor_, RedoStep{.to_look = true}); // what was undone before
    calm();
    EXPECT_FALSE(looks_back(editor_));
    apply(editor_, UndoStep{.to_look = true});
    EXPECT_FALSE(looks_back(editor_));
    apply(editor_, UndoStep{.to_look = true});
    EXPECT_TRUE(looks_back(editor_));
    apply(editor_, UndoStep{});
    EXPECT_FALSE(looks_back(editor_)) << "who takes a step back means it";
    calm();
}

TEST_F(BarEditor, WhoeverLooksBackUndoesToWhatTheyLookAt) {
    make_handles();
    turn_chosen("40");
    turn_chosen("20");
    turn_chosen("10");
    for (int step = 0; step < 2; ++step) apply(editor_, UndoStep{.to_look = true});
    calm();
    const std::size_t seen = editor_.past.size();
    const LineArray<float> shape = editor_.frame.positions();
    apply(editor_, UndoStep{});
    calm();
    EXPECT_EQ(editor_.past.size(), seen);
    EXPECT_FALSE(looks_back(editor_));
    EXPECT_EQ(editor_.frame.positions(), shape);
    turn_chosen("5"); // and goes on from there
    EXPECT_EQ(editor_.past.size(), seen + 1);
    EXPECT_FALSE(can_redo(editor_));

    while (can_undo(editor_)) apply(editor_, UndoStep{.to_look = true}); // to the cloud as it was opened
    apply(editor_, UndoStep{});
    calm();
    EXPECT_TRUE(editor_.past.empty());
    EXPECT_FALSE(looks_back(editor_));
}

TEST_F(BarEditor, PlayingAStepIsDoingItAgain) {
    make_handles();
    transform_chosen('R', 'Z', "90");
    const LineArray<float> turned = editor_.frame.positions();
    apply(editor_, UndoStep{});
    calm();
    ASSERT_TRUE(can_redo(editor_));
    apply(editor_, PacePlaying{1, true});
    apply(editor_, PlayStep{});
    apply(editor_, AdvancePlaying{2});
    ASSERT_TRUE(wait_until([&] {
        refresh(editor_);
        return editor_.status.playing && editor_.status.playing->frame == 2;
    }));
    EXPECT_EQ(editor_.status.playing->handle, "high");
    EXPECT_FALSE(can_redo(editor_));
    const std::size_t steps = editor_.past.size();
    SettingsChange samples;
    samples.samples = 500;
    EXPECT_TRUE(poses_may_change(editor_));
    for (const Command& from_pose :
         {Command(CommitPose{}), Command(ChangeSettings{samples}), Command(BeginDrag{}),
          Command(ResetPoses{{"high"}}), Command(SetPivot{})}) {
        apply(editor_, from_pose);
        EXPECT_EQ(editor_.past.size(), steps) << "it would take another pose than is shown";
        EXPECT_FALSE(editor_.drag);
    }
    ASSERT_FALSE(editor_.notices.empty());
    EXPECT_NE(editor_.notices.back().words.find("middle of a step"), std::string::npos);
    apply(editor_, PacePlaying{4, false});
    calm();
    EXPECT_EQ(editor_.frame.positions(), turned);
    EXPECT_FALSE(editor_.status.playing);
}

} // namespace knead::test
