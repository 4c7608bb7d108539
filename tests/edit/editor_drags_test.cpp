// Drags of which the document has not told yet.

#include "edit/editor_bar.h"

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
    apply(editor_, ResetPose{"high"});
    EXPECT_TRUE(poses_may_change(editor_));
    calm();
    EXPECT_EQ(turned(editor_), 0);
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
