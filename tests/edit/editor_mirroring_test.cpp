// Handles and poses on the other side.

#include "edit/editor_bar.h"

#include <cmath>
#include <numbers>
#include <tuple>

namespace knead::test {

namespace {

constexpr double pi = std::numbers::pi;

// A bar fixed in its middle, with a moving handle at each end.
class BarFixedInItsMiddle : public BarEditor {
protected:
    void make_three_handles() {
        editor_.camera.orthographic = true;
        select_heights(-0.2, 0.2);
        apply(editor_, MakeHandle{HandleRole::fixed, "middle"});
        select_heights(2, 3);
        apply(editor_, MakeHandle{HandleRole::moving, "high"});
        select_heights(-3, -2.2);
        apply(editor_, MakeHandle{HandleRole::moving, "low"});
        calm();
    }
};

} // namespace

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

TEST_F(BarEditor, MirroringAnotherPoseOntoTheSameTwinCommitsNeither) {
    make_handles();
    apply(editor_, MirrorHandle{"high", 2}); // at rest
    calm();
    for (const char* degrees : {"40", "20"}) {
        apply(editor_, ChooseHandle{"high"});
        transform_chosen('R', 'X', degrees);
        apply(editor_, MirrorHandle{"high", 2});
        calm();
    }
    ASSERT_EQ(editor_.document->handles.size(), 3U);
    const auto degrees = [&](std::size_t handle) {
        return Eigen::AngleAxisd(editor_.document->motions[handle].rotation).angle() * 180 / pi;
    };
    EXPECT_NEAR(degrees(1), 60, 1e-7) << "of this edit still";
    EXPECT_NEAR(degrees(2), 60, 1e-7);
    apply(editor_, UndoStep{});
    calm();
    EXPECT_NEAR(degrees(1), 60, 1e-7);
    EXPECT_NEAR(degrees(2), 40, 1e-7);
}

// A handle that was made by hand on the other side takes the pose; another one there would leave it a part of
// its points, and tear the cloud between the two.
TEST_F(BarFixedInItsMiddle, MirroringOntoAMovingHandlePosesThatOne) {
    make_three_handles();
    apply(editor_, ChangeHold{"low", false, 0.3});
    calm();
    const std::vector<Index> points = *editor_.document->handles[2].points;
    apply(editor_, ChooseHandle{"high"});
    transform_chosen('R', 'X', "40");
    apply(editor_, MirrorHandle{"high", 2});
    calm();
    ASSERT_EQ(editor_.document->handles.size(), 3U);
    const Handle& low = editor_.document->handles[2];
    EXPECT_EQ(low.name, "low");
    EXPECT_EQ(*low.points, points);
    EXPECT_EQ(low.falloff, 0.3) << "it holds as it did";
    EXPECT_EQ(editor_.chosen, "low");
    for (const std::size_t handle : {1U, 2U})
        EXPECT_NEAR(Eigen::AngleAxisd(editor_.document->motions[handle].rotation).angle() * 180 / pi, 40,
                    1e-7);
    apply(editor_, UndoStep{});
    calm();
    EXPECT_EQ(editor_.document->motions[2].rotation.angularDistance(Quatd::Identity()), 0);
}

// One that holds fast is no pose for another, and what lies across at rest has none to give.
TEST_F(BarFixedInItsMiddle, MirroringWithoutAPoseLeavesAMovingHandleThere) {
    make_three_handles();
    apply(editor_, MirrorHandle{"high", 2});
    calm();
    EXPECT_EQ(editor_.document->handles.size(), 3U);
    EXPECT_EQ(editor_.chosen, "low");
    EXPECT_NE(editor_.notices.back().words.find("There is no pose to mirror"), std::string::npos);
    apply(editor_, ChangeRole{"high", HandleRole::fixed});
    calm();
    apply(editor_, MirrorHandle{"high", 2});
    calm();
    for (const Handle& handle : editor_.document->handles)
        if (handle.name == "low") {
            EXPECT_EQ(handle.role, HandleRole::moving);
        }
}

// Its pivot is its own, and goes along.
TEST_F(BarFixedInItsMiddle, MirroringKeepsThePivotOfTheHandleThere) {
    make_three_handles();
    apply(editor_, SetPivot{glm::dvec3(0, 0, -2)});
    calm();
    apply(editor_, ChooseHandle{"high"});
    transform_chosen('G', 'Z', "1");
    apply(editor_, MirrorHandle{"high", 2});
    calm();
    ASSERT_TRUE(pivot_of(editor_, "low"));
    EXPECT_LT(glm::distance(*pivot_of(editor_, "low"), glm::dvec3(0, 0, -3)), 1e-6);
}

// The first time the pose is committed with the twin's making, and the shape is no mirror image of itself
// then.
TEST_F(BarEditor, MirroringOnInABentShapeTakesTheTwinThatIsThere) {
    make_handles();
    transform_chosen('R', 'X', "25");
    apply(editor_, MirrorHandle{"high", 2});
    calm();
    apply(editor_, CommitPose{});
    calm();
    apply(editor_, ChooseHandle{"high"});
    transform_chosen('R', 'X', "20");
    apply(editor_, MirrorHandle{"high", 2});
    calm();
    ASSERT_EQ(editor_.document->handles.size(), 3U);
    for (const std::size_t handle : {1U, 2U})
        EXPECT_NEAR(Eigen::AngleAxisd(editor_.document->motions[handle].rotation).angle() * 180 / pi, 20,
                    1e-7);
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

TEST_F(BarEditor, MirrorsAPoseInTheShapeThatWasCommitted) {
    editor_.camera.orthographic = true;
    apply(editor_, ChangeSelection{SelectionStep::all});
    apply(editor_, MakeHandle{HandleRole::moving, "whole"});
    calm();
    transform_chosen('G', 'Z', "3");
    press(Key::enter); // committed
    calm();
    apply(editor_, DeleteHandles{{"whole"}});
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

} // namespace knead::test
