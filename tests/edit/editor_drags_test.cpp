// Drags of which the document has not told yet.

#include "edit/editor_bar.h"
#include "edit/handle_motion.h"

#include <numbers>

namespace knead::test {

namespace {

void turn_by(Editor& editor, double degrees) {
    Transform turn;
    turn.axis = {0, 0, 1};
    turn.angle = degrees * std::numbers::pi / 180;
    apply(editor, BeginDrag{});
    apply(editor, DragTo{turn});
    apply(editor, EndDrag{});
}

double turned(const Editor& editor) {
    return pose_of_chosen(editor)->motion.turned.z() * 180 / std::numbers::pi;
}

} // namespace

TEST_F(BarEditor, KnowsThePoseOfDragsThatTheDocumentHasNotAnswered) {
    make_handles();
    apply(editor_, ChooseHandle{"high"});
    calm();
    turn_by(editor_, 400);
    EXPECT_NEAR(turned(editor_), 400, 1e-6);
    turn_by(editor_, -100);
    turn_by(editor_, 45);
    EXPECT_NEAR(turned(editor_), 345, 1e-6);
    EXPECT_FALSE(poses_may_change(editor_));
    apply(editor_, ChooseHandle{"low"});
    EXPECT_FALSE(pose_of_chosen(editor_)) << "a fixed one has none";
    apply(editor_, ChooseHandle{"high"});
    calm();
    EXPECT_NEAR(turned(editor_), 345, 1e-6) << "as the document counted it";
    apply(editor_, UndoStep{});
    EXPECT_TRUE(poses_may_change(editor_));
    calm();
    EXPECT_FALSE(poses_may_change(editor_));
    EXPECT_NEAR(turned(editor_), 300, 1e-6);
    apply(editor_, ResetPoses{{"high"}});
    EXPECT_TRUE(poses_may_change(editor_));
    calm();
    EXPECT_EQ(turned(editor_), 0);
}

TEST_F(BarEditor, KnowsThePosesOfSeveralHandlesThatTheDocumentHasNotAnswered) {
    make_handles();
    select_heights(-0.5, 0.5);
    apply(editor_, MakeHandle{HandleRole::moving, "middle"});
    calm();
    const auto choose_and_turn = [&](const char* handle, double degrees) {
        apply(editor_, ChooseHandle{handle});
        turn_by(editor_, degrees);
    };
    choose_and_turn("high", 10);
    choose_and_turn("middle", 5);
    choose_and_turn("high", 20);
    EXPECT_NEAR(turned(editor_), 30, 1e-6);
    apply(editor_, BeginDrag{});
    apply(editor_, CancelDrag{});
    EXPECT_NEAR(turned(editor_), 30, 1e-6) << "what was cancelled is not what went before";
    apply(editor_, ChooseHandle{"middle"});
    EXPECT_NEAR(turned(editor_), 5, 1e-6);
    apply(editor_, ChooseHandle{"high"});
    calm();
    EXPECT_NEAR(turned(editor_), 30, 1e-6) << "as the document counted it";
    EXPECT_TRUE(editor_.earlier_drags.empty() && !editor_.drag);
}

// "high" and "middle", the former chosen and the latter going along.
class TwoChosen : public BarEditor {
protected:
    void SetUp() override {
        BarEditor::SetUp();
        make_handles();
        select_heights(-0.5, 0.5);
        apply(editor_, MakeHandle{HandleRole::moving, "middle"});
        calm();
        apply(editor_, ChooseHandle{"high"});
        apply(editor_, ChooseAlso{"middle"});
    }
    const HandleMotion& motion_of_handle(const char* name) {
        const auto& handles = editor_.document->handles;
        const auto found = std::ranges::find(handles, name, &Handle::name);
        return editor_.document->motions[static_cast<std::size_t>(found - handles.begin())];
    }
};

TEST_F(TwoChosen, AreMovedTogetherInOneStep) {
    const std::size_t steps = editor_.past.size();
    turn_by(editor_, 30);
    EXPECT_NEAR(motion_now(editor_, 2).turned.z(), std::numbers::pi / 6, 1e-6) << "before it is answered";
    turn_by(editor_, 60);
    calm();
    EXPECT_EQ(editor_.past.size(), steps + 2);
    for (const char* name : {"high", "middle"})
        EXPECT_NEAR(motion_of_handle(name).turned.z(), std::numbers::pi / 2, 1e-6) << name;
    EXPECT_EQ(words_of_undo(editor_), "\"high\" and \"middle\" posed");
    apply(editor_, UndoStep{});
    calm();
    for (const char* name : {"high", "middle"})
        EXPECT_NEAR(motion_of_handle(name).turned.z(), std::numbers::pi / 6, 1e-6) << name;
    EXPECT_EQ(editor_.also_chosen, std::vector<std::string>{"middle"}) << "they still go together";
    apply(editor_, ResetPoses{{"middle"}});
    calm();
    EXPECT_FALSE(leaves_rest(motion_of_handle("middle")));
    EXPECT_NEAR(motion_of_handle("high").turned.z(), std::numbers::pi / 6, 1e-6);
}

TEST_F(TwoChosen, TakeTheirPivotsAlong) {
    apply(editor_, ChooseHandle{"middle"});
    apply(editor_, SetPivot{glm::dvec3(1, 0, 0)});
    apply(editor_, ChooseHandle{"high"});
    apply(editor_, ChooseAlso{"middle"});
    turn_by(editor_, 90);
    calm();
    const auto pivot = pivot_of(editor_, "middle");
    ASSERT_TRUE(pivot);
    EXPECT_LT(glm::distance(*pivot, glm::dvec3(0, 1, 0)), 1e-6);
    apply(editor_, UndoStep{});
    calm();
    EXPECT_LT(glm::distance(*pivot_of(editor_, "middle"), glm::dvec3(1, 0, 0)), 1e-6);
}

TEST_F(TwoChosen, HaveTheirGizmosWhereTheyWereTakenBeforeThatIsAnswered) {
    const auto shift_by = [&](const glm::dvec3& way) {
        Transform shift;
        shift.shift = way;
        apply(editor_, BeginDrag{gizmo_of(editor_)->center});
        apply(editor_, DragTo{shift});
        apply(editor_, EndDrag{});
    };
    apply(editor_, ChooseHandle{"middle"});
    const glm::dvec3 began = gizmo_of(editor_)->center;
    shift_by({1, 0, 0});
    apply(editor_, ChooseHandle{"high"});
    apply(editor_, ChooseAlso{"middle"});
    shift_by({0, 2, 0});
    apply(editor_, ChooseHandle{"middle"});
    const glm::dvec3 before = gizmo_of(editor_)->center;
    EXPECT_LT(glm::distance(before, began + glm::dvec3(1, 2, 0)), 1e-9);
    calm();
    EXPECT_LT(glm::distance(before, gizmo_of(editor_)->center), 1e-5);
}

TEST_F(TwoChosen, MoveTogetherUnderANameThatIsYetToCome) {
    apply(editor_, RenameHandle{"middle", "belt"});
    turn_by(editor_, 30);
    calm();
    EXPECT_NEAR(motion_of_handle("belt").turned.z(), std::numbers::pi / 6, 1e-6);
    apply(editor_, DeleteHandles{{"belt"}});
    turn_by(editor_, 30);
    calm();
    EXPECT_NEAR(motion_of_handle("high").turned.z(), std::numbers::pi / 6, 1e-6) << "without the other";
}

TEST_F(TwoChosen, UntilTheyAreNoLonger) {
    const auto also = [&] { return editor_.also_chosen; };
    apply(editor_, RenameHandle{"middle", "belt"});
    calm();
    EXPECT_EQ(also(), std::vector<std::string>{"belt"});
    apply(editor_, RenameHandle{"high", "head"});
    calm();
    EXPECT_EQ(editor_.chosen, "head");
    EXPECT_EQ(also(), std::vector<std::string>{"belt"});
    editor_.notices.clear();
    apply(editor_, ChooseAlso{"low"});
    EXPECT_EQ(editor_.notices.size(), 1U) << "a fixed one goes nowhere";
    apply(editor_, ChooseAlso{"belt"});
    EXPECT_TRUE(also().empty());
    apply(editor_, ChooseAlso{"belt"});
    apply(editor_, DeleteHandles{{"belt"}});
    calm();
    EXPECT_TRUE(also().empty());
    turn_by(editor_, 30);
    calm();
    EXPECT_NEAR(motion_of_handle("head").turned.z(), std::numbers::pi / 6, 1e-6);
    apply(editor_, ChooseHandle{"low"});
    apply(editor_, ChooseAlso{"head"});
    EXPECT_EQ(editor_.chosen, "head") << "where none is chosen that moves";
}

TEST_F(BarEditor, ResetsAndMirrorsAPoseThatTheDocumentHasNotAnswered) {
    make_handles();
    apply(editor_, ChooseHandle{"high"});
    calm();
    turn_by(editor_, 30);
    apply(editor_, ResetPoses{{"high"}});
    calm();
    EXPECT_EQ(editor_.past.size(), 4U + 2U) << "two selections and handles, a turn and its way back";
    EXPECT_EQ(turned(editor_), 0);
    turn_by(editor_, 40);
    apply(editor_, MirrorHandle{"high", 0});
    calm();
    for (const Notice& notice : editor_.notices)
        EXPECT_EQ(notice.words.find("no pose to mirror"), std::string::npos) << notice.words;
    ASSERT_EQ(editor_.document->handles.size(), 3U);
    EXPECT_NEAR(2 * std::acos(std::abs(editor_.document->motions[2].rotation.w())),
                40 * std::numbers::pi / 180, 1e-9)
        << "as far as the one across";
}

TEST_F(BarEditor, ADragThatEndsIsOfTheHandleThatItBeganWith) {
    make_handles();
    select_heights(-0.5, 0.5);
    apply(editor_, MakeHandle{HandleRole::moving, "middle"});
    calm();
    editor_.pivots["high"] = {1, 0, 2};
    editor_.pivots["middle"] = {0, 0, 0.25};
    apply(editor_, ChooseHandle{"high"});
    Transform shift;
    shift.shift = {0, 0, 1};
    apply(editor_, BeginDrag{});
    apply(editor_, DragTo{shift});
    apply(editor_, ChooseHandle{"middle"});
    apply(editor_, EndDrag{});
    calm();
    EXPECT_EQ(pivot_of(editor_, "high"), glm::dvec3(1, 0, 3));
    EXPECT_EQ(pivot_of(editor_, "middle"), glm::dvec3(0, 0, 0.25));
}

TEST_F(BarEditor, BeginsNoDragBeforeTheOneThatGoesOnHasEnded) {
    make_handles();
    apply(editor_, ChooseHandle{"high"});
    calm();
    const std::size_t steps = editor_.past.size();
    apply(editor_, BeginDrag{});
    turn_by(editor_, 30); // ends the first
    EXPECT_EQ(editor_.past.size(), steps + 1);
    apply(editor_, CommitPose{});
    calm();
    EXPECT_FALSE(editor_.document->posed) << "what came after it was carried out";
}

} // namespace knead::test
