// Moves on both sides of the cloud at once.

#include "edit/editor_bar.h"
#include "edit/view_vectors.h"

#include <numbers>

namespace knead::test {

namespace {

constexpr double degree = std::numbers::pi / 180;

// A bar fixed in its middle, with a moving handle at each end, of which the lower one is shorter: "high" from
// 2 to 3, "low" from -3 to -2.2. Moves are mirrored across z, and "high" is chosen.
class BothEnds : public BarEditor {
protected:
    void SetUp() override {
        BarEditor::SetUp();
        editor_.camera.orthographic = true;
        select_heights(-0.2, 0.2);
        apply(editor_, MakeHandle{HandleRole::fixed, "middle"});
        make_moving("high", 2, 3);
        make_moving("low", -3, -2.2);
        apply(editor_, MirrorMoves{2});
        apply(editor_, ChooseHandle{"high"});
    }
    void make_moving(const char* name, double low, double high) {
        select_heights(low, high);
        apply(editor_, MakeHandle{HandleRole::moving, name});
        calm();
    }
    const HandleMotion& motion_of_handle(const std::string& name) {
        const auto& handles = editor_.document->handles;
        const auto found = std::ranges::find(handles, name, &Handle::name);
        return editor_.document->motions[static_cast<std::size_t>(found - handles.begin())];
    }
    std::string counterpart() {
        const auto& pairs = editor_.symmetry->pairs;
        return pairs.empty() ? std::string() : pairs[0].counterpart;
    }
};

} // namespace

TEST_F(BothEnds, MoveInOneStep) {
    EXPECT_EQ(counterpart(), "low");
    const std::size_t steps = editor_.past.size();
    transform_chosen('R', 'X', "400");
    EXPECT_NEAR(motion_of_handle("high").turned.x(), 400 * degree, 1e-6);
    EXPECT_NEAR(motion_of_handle("low").turned.x(), -400 * degree, 1e-6);
    EXPECT_EQ(editor_.past.size(), steps + 1);
    EXPECT_EQ(words_of_undo(editor_), "\"high\" and \"low\" posed");
    const auto middle = middle_of(editor_, editor_.document->handles[2]);
    transform_chosen('G', 'Z', "0.5");
    EXPECT_NEAR(middle_of(editor_, editor_.document->handles[2])->z, middle->z - 0.5, 1e-3)
        << "they part, wherever they were";
    apply(editor_, UndoStep{});
    apply(editor_, UndoStep{});
    calm();
    for (const char* name : {"high", "low"}) EXPECT_FALSE(leaves_rest(motion_of_handle(name))) << name;
}

TEST_F(BothEnds, AreSeenToMoveBeforeTheDocumentAnswers) {
    Transform turn;
    turn.axis = {1, 0, 0};
    turn.angle = 30 * degree;
    turn.pivot = gizmo_of(editor_)->center;
    apply(editor_, BeginDrag{turn.pivot});
    apply(editor_, DragTo{turn});
    apply(editor_, EndDrag{});
    EXPECT_NEAR(motion_now(editor_, 2).turned.x(), -30 * degree, 1e-9);
    const HandleMotion expected = motion_now(editor_, 2);
    calm();
    EXPECT_LT((motion_of_handle("low").linear - expected.linear).norm(), 1e-9);
    EXPECT_LT((motion_of_handle("low").offset - expected.offset).norm(), 1e-6);
}

// The joint of the one is where the mirror shows that of the other, unless both have one of their own.
TEST_F(BothEnds, TurnAboutJointsAcrossFromEachOther) {
    const std::size_t steps = editor_.past.size();
    apply(editor_, SetPivot{glm::dvec3(0, 0, 1)});
    EXPECT_EQ(editor_.past.size(), steps + 1);
    glm::dvec3 image = *middle_of(editor_, editor_.document->handles[1]);
    image.z *= -1;
    const glm::dvec3 shift = *middle_of(editor_, editor_.document->handles[2]) - image;
    transform_chosen('R', 'X', "90");
    const HandleMotion low = motion_of_handle("low");
    const Vec3d joint(shift.x, shift.y, shift.z - 1);
    ASSERT_TRUE(pivot_of(editor_, "low")) << "and each keeps it";
    EXPECT_LT(glm::distance(*pivot_of(editor_, "low"), to_glm(joint)), 1e-6);
    EXPECT_LT((low.linear * joint + low.offset - joint).norm(), 1e-3);
    apply(editor_, UndoStep{});
    apply(editor_, UndoStep{});
    calm();
    EXPECT_FALSE(pivot_of(editor_, "low"));
    EXPECT_FALSE(pivot_of(editor_, "high"));
    apply(editor_, RedoStep{});
    calm();
    EXPECT_TRUE(pivot_of(editor_, "low"));
    apply(editor_, ChooseHandle{"low"});
    calm();
    EXPECT_EQ(counterpart(), "high");
    apply(editor_, SetPivot{glm::dvec3(0, 0, -1.75)});
    apply(editor_, ChooseHandle{"high"});
    transform_chosen('R', 'X', "90");
    const HandleMotion own = motion_of_handle("low");
    EXPECT_LT((own.linear * Vec3d(0, 0, -1.75) + own.offset - Vec3d(0, 0, -1.75)).norm(), 1e-6);
}

// Head and neck lie on the plane but for a little, one to this side of it and one to the other.
TEST_F(BothEnds, AreNotWhatLiesInTheMiddle) {
    apply(editor_, MirrorMoves{0});
    for (int k = 0; k < 6; ++k)
        make_moving(("disc " + std::to_string(k)).c_str(), 0.5 + 0.2 * k, 0.6 + 0.2 * k);
    for (const Handle& handle : editor_.document->handles) {
        apply(editor_, ChooseHandle{handle.name});
        EXPECT_EQ(counterpart(), "") << handle.name;
    }
}

// Whose names are on their way to others, or that are deleted, go nowhere under their old ones.
TEST_F(BothEnds, AreNoneWhileTheirNamesChange) {
    const auto turn = [&] {
        Transform by;
        by.axis = {1, 0, 0};
        by.angle = 30 * degree;
        apply(editor_, BeginDrag{});
        apply(editor_, DragTo{by});
        apply(editor_, EndDrag{});
    };
    apply(editor_, RenameHandle{"low", "belt"});
    EXPECT_EQ(counterpart(), "");
    turn();
    apply(editor_, SetPivot{glm::dvec3(0, 0, 1)});
    apply(editor_, ResetPoses{moved_with(editor_, "high")});
    calm();
    EXPECT_EQ(counterpart(), "belt");
    EXPECT_FALSE(leaves_rest(motion_of_handle("high")));
    EXPECT_FALSE(pivot_of(editor_, "low") || pivot_of(editor_, "belt"));
    turn();
    calm();
    EXPECT_NEAR(motion_of_handle("belt").turned.x(), -30 * degree, 1e-6);
    editor_.notices.clear();
    apply(editor_, MirrorMoves{});
    apply(editor_, ChooseAlso{"belt"});
    apply(editor_, RenameHandle{"belt", "low"});
    apply(editor_, ResetPoses{moved_with(editor_, "high")}); // by the name that it will have then
    apply(editor_, DeleteHandles{{"low"}});
    apply(editor_, DeleteHandles{{"high", "low"}});
    calm();
    for (const Notice& notice : editor_.notices) EXPECT_NE(notice.kind, Notice::Kind::error) << notice.words;
    EXPECT_EQ(editor_.document->handles.size(), 1U);
    apply(editor_, UndoStep{});
    apply(editor_, UndoStep{});
    calm();
    for (const char* name : {"high", "low"}) EXPECT_FALSE(leaves_rest(motion_of_handle(name))) << name;
}

// No pose parts them, committed or not, nor one that stands aside as legs do.
TEST_F(BothEnds, StayAcrossFromEachOther) {
    apply(editor_, MirrorMoves{});
    transform_chosen('G', 'Z', "1.5");
    apply(editor_, CommitPose{});
    calm();
    apply(editor_, MirrorMoves{2});
    EXPECT_EQ(counterpart(), "low");
    transform_chosen('R', 'X', "20");
    EXPECT_NEAR(motion_of_handle("low").turned.x(), -20 * degree, 1e-6);
    // "high" alone was moved: about where its middle is now, and the other about its own.
    const glm::dvec3 middle = *middle_of(editor_, editor_.document->handles[2]);
    EXPECT_LT((motion_of_handle("low").linear * to_eigen(middle) + motion_of_handle("low").offset -
               to_eigen(middle))
                  .norm(),
              1e-3);
}

// A second handle of the upper side is not what the lower one answers to, and what is held goes nowhere.
TEST_F(BothEnds, AreOnlyThoseThatAreNearestToEachOther) {
    make_moving("ring", 1.5, 1.9);
    EXPECT_EQ(editor_.chosen, "ring");
    EXPECT_EQ(counterpart(), "");
    EXPECT_NE(next_step(editor_).find("\"ring\" moves alone"), std::string::npos) << next_step(editor_);
    apply(editor_, ChooseHandle{"middle"});
    EXPECT_EQ(counterpart(), "");
    apply(editor_, ChooseHandle{"low"});
    EXPECT_EQ(counterpart(), "high");
    apply(editor_, ChangeRole{"high", HandleRole::fixed});
    calm();
    EXPECT_EQ(counterpart(), "ring") << "which is the only one there that moves";
    apply(editor_, MirrorMoves{});
    transform_chosen('R', 'X', "20");
    EXPECT_FALSE(leaves_rest(motion_of_handle("ring")));
}

// Each by itself, whatever went along with what.
TEST_F(BothEnds, TakeAMoveAndAScalingBack) {
    transform_chosen('G', 'Z', "0.5");
    transform_chosen('S', 'X', "2");
    transform_chosen('R', 'X', "30");
    apply(editor_, MirrorMoves{});
    transform_chosen('G', 'Y', "0.25");
    apply(editor_, MirrorMoves{2});
    const std::size_t steps = editor_.past.size();
    const auto moved_by = [&](const char* name) {
        const Handle& handle = editor_.document->handles[name == std::string("high") ? 1 : 2];
        const Vec3d now = to_eigen(*middle_of(editor_, handle));
        return (now - point_at_rest(motion_of_handle(name), now)).norm();
    };
    EXPECT_GT(moved_by("high"), 0.5);
    EXPECT_GT(moved_by("low"), 0.45);
    for (const PosePart part : {PosePart::move, PosePart::scaling, PosePart::move, PosePart::scaling}) {
        apply(editor_, TakeBackPart{moved_with(editor_, "high"), part});
        calm();
    }
    EXPECT_EQ(editor_.past.size(), steps + 2) << "one step each, and none where nothing is left";
    for (const char* name : {"high", "low"}) {
        EXPECT_LT(moved_by(name), 1e-4) << name;
        const HandleMotion& motion = motion_of_handle(name);
        EXPECT_LT((motion.linear - motion.rotation.toRotationMatrix()).norm(), 1e-9) << name;
        EXPECT_NEAR(std::abs(motion.turned.x()), 30 * degree, 1e-6) << name;
    }
    apply(editor_, TakeBackPart{moved_with(editor_, "high"), PosePart::turn});
    calm();
    EXPECT_EQ(editor_.past.size(), steps + 3);
    for (const char* name : {"high", "low"})
        EXPECT_LT((motion_of_handle(name).linear - Mat3d::Identity()).norm(), 1e-9) << name;
}

// Both of two that lie across from each other go as the mirror says, and another that is chosen takes its own
// counterpart along.
TEST_F(BothEnds, OfWhatIsChosenTogether) {
    apply(editor_, ChooseAlso{"low"});
    EXPECT_TRUE(editor_.also_chosen.empty()) << "it goes along as it is";
    transform_chosen('G', 'Z', "0.1");
    EXPECT_NEAR(motion_of_handle("low").offset.z(), -0.1, 1e-9);
    apply(editor_, UndoStep{});
    make_moving("ring", 1.2, 1.5);
    make_moving("belt", -1.5, -1.2);
    apply(editor_, ChooseHandle{"high"});
    apply(editor_, ChooseAlso{"ring"});
    calm();
    ASSERT_EQ(editor_.symmetry->pairs.size(), 2U);
    EXPECT_EQ(editor_.symmetry->pairs[1].counterpart, "belt");
    EXPECT_NE(next_step(editor_).find("takes 3 handles along, 2 of them mirrored"), std::string::npos);
    transform_chosen('G', 'Z', "0.2");
    EXPECT_NEAR(motion_of_handle("ring").offset.z(), 0.2, 1e-9);
    EXPECT_NEAR(motion_of_handle("low").offset.z(), -0.2, 1e-9);
    EXPECT_NEAR(motion_of_handle("belt").offset.z(), -0.2, 1e-9);
    const std::size_t steps = editor_.past.size();
    EXPECT_EQ(moved_with(editor_, "high").size(), 4U);
    EXPECT_EQ(moved_with(editor_, "low").size(), 1U) << "which goes along, and is not chosen";
    apply(editor_, ResetPoses{moved_with(editor_, "high")});
    calm();
    EXPECT_EQ(editor_.past.size(), steps + 1);
    EXPECT_EQ(words_of_undo(editor_), "4 handles posed");
    for (const char* name : {"high", "ring", "low", "belt"})
        EXPECT_FALSE(leaves_rest(motion_of_handle(name))) << name;
    apply(editor_, DeleteHandles{{"high", "ring"}});
    calm();
    EXPECT_EQ(editor_.document->handles.size(), 3U);
    EXPECT_EQ(words_of_undo(editor_), "2 handles deleted");
    EXPECT_TRUE(editor_.chosen.empty() || !chosen_handle(editor_));
    apply(editor_, UndoStep{});
    calm();
    EXPECT_EQ(editor_.document->handles.size(), 5U);
}

TEST_F(BothEnds, MirrorGoesAcrossTheirPlaneAndLeavesTheHandleChosen) {
    apply(editor_, DeleteHandles{{"low"}});
    calm();
    EXPECT_EQ(counterpart(), "");
    apply(editor_, MirrorHandle{"high", 2});
    calm();
    EXPECT_EQ(editor_.chosen, "high");
    EXPECT_EQ(counterpart(), "high mirrored");
    apply(editor_, MirrorHandle{"high", 2}); // it is there already
    EXPECT_EQ(editor_.chosen, "high");
    apply(editor_, MirrorMoves{});
    apply(editor_, MirrorHandle{"high", 2});
    EXPECT_EQ(editor_.chosen, "high mirrored");
}

TEST_F(BothEnds, AClickWithShiftLetsAHandleGoAlong) {
    apply(editor_, MirrorMoves{});
    glm::dvec2 pixel = pixel_of({0, 0, -2.9});
    const double below = pixel.y;
    while (handle_under(editor_, pixel) != "low" && pixel.y > below - 100) --pixel.y; // between two points
    const SelectPointUnder click{pixel, SelectMode::add};
    apply(editor_, click);
    EXPECT_EQ(editor_.also_chosen, std::vector<std::string>{"low"});
    EXPECT_EQ(editor_.selected, 0U);
    apply(editor_, click);
    EXPECT_TRUE(editor_.also_chosen.empty());
    select_heights(1, 2);
    const std::size_t before = editor_.selected;
    apply(editor_, click);
    EXPECT_EQ(editor_.selected, before + 1) << "where points are selected it is one more";
    EXPECT_TRUE(editor_.also_chosen.empty());
}

} // namespace knead::test
