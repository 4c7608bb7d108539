// Handles that go along with one that is dragged.

#include "edit/editing.h"

namespace knead {
namespace {

using namespace knead::test;

// Two moving ends of a bar, of which one takes the other along.
const std::string two_ends = above("top", 2, "moving") +
                             R"({"op":"handle","name":"low","role":"moving",)"
                             R"("region":{"halfspace":{"point":[0,0,-2],"normal":[0,0,-1]}}})"
                             "\n";

std::string together(const std::string& frames, const std::string& with = R"("low")") {
    return R"({"op":"drag","handle":"top","pivot":[0,0,2.5],"with":[)" + with + R"(],"frames":[)" + frames +
           "]}\n";
}

Vec3d turned_about_top(const Vec3d& p, double degrees) {
    const Vec3d pivot(0, 0, 2.5), arm = p - pivot;
    const Quatd turn(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vec3d::UnitY()));
    return pivot + turn._transformVector(arm);
}

TEST(DragsTogether, CarryAllThatTheyHoldLikeOneRigidBody) {
    Desk desk(bar());
    const Vec3d origin = desk.document().cloud().origin;
    desk.play(two_ends + together(turn('y', 30) + "," + turn('y', 60) + "," + turn('y', 90)) + settle(300));
    EXPECT_LT(desk.handle_error(), 1e-6);
    EXPECT_LT(farthest(desk, every,
                       [&](const Vec3d& p) -> Vec3d { return turned_about_top(p + origin, 90) - origin; }),
              1e-3 * desk.diagonal());
}

// However often they go round: nothing is wound up between them.
TEST(DragsTogether, GoRoundTogether) {
    Desk desk(bar());
    std::string frames;
    for (int degrees = 30; degrees <= 690; degrees += 30)
        frames += (frames.empty() ? "" : ",") + turn('z', degrees);
    desk.play(two_ends + together(frames) + settle(300));
    const auto& motions = desk.document().motions();
    const auto turned = [&](const Vec3d& p) -> Vec3d { return motions[0].linear * p + motions[0].offset; };
    EXPECT_LT(farthest(desk, every, turned), 1e-3 * desk.diagonal());
    for (const HandleMotion& motion : motions)
        EXPECT_NEAR(motion.turned.z(), 690 * std::numbers::pi / 180, 1e-4);
}

// What takes the one from where it was takes the other from where that was, scaled and sheared, too.
TEST(DragsTogether, BeginWhereEachWas) {
    const std::string first = R"({"op":"drag","handle":"low","pivot":[0,0,-2.5],"frames":[)" +
                              turn('x', 40, "[0.5,0,0]") + "]}\n" + drag(turn('y', 30));
    const auto motion_in = [](Desk& desk, int handle) {
        return desk.document().motions()[static_cast<std::size_t>(handle)];
    };
    Desk desk(bar());
    desk.play(two_ends + first);
    const HandleMotion top = motion_in(desk, 0), low = motion_in(desk, 1);
    desk.play(together(R"({"translate":[0,1,0],"rotate":[0.9,0.1,0.4,0],"scale":[1,2,0.5]})"));
    const HandleMotion top_now = motion_in(desk, 0), low_now = motion_in(desk, 1);
    const Mat3d map = top_now.linear * top.linear.inverse();
    for (const Vec3d& p : {Vec3d(0, 0, 0), Vec3d(1, 2, 3)}) {
        const Vec3d by_top = map * (low.linear * p + low.offset - top.offset) + top_now.offset;
        EXPECT_LT((low_now.linear * p + low_now.offset - by_top).norm(), 1e-12);
    }
    EXPECT_LT(desk.handle_error(), 1e-6);
    desk.play(undo);
    EXPECT_EQ(motion_in(desk, 1).linear, low.linear);
    EXPECT_EQ(motion_in(desk, 1).offset, low.offset);
}

TEST(DragsTogether, AreOneStepAndMadeAgainToTheBit) {
    const std::string acts = together(lift) + settle(5) + together(turn('y', 40)) + drag(turn('x', 20)) +
                             R"({"op":"drag","handle":"low","pivot":[0,0,0],"frames":[)" + lift + "]}\n";
    Desk straight(bar()), roundabout(bar());
    straight.play(two_ends + acts);
    roundabout.document().keep_at_most({.shapes = 1, .samples = 1, .sample_bytes = 0});
    roundabout.play(two_ends + acts + commit + undo + undo + undo + undo + redo + redo + redo + undo + redo);
    EXPECT_EQ(roundabout.shape(), straight.shape());
    for (std::size_t h = 0; h < 2; ++h)
        EXPECT_EQ(roundabout.document().motions()[h].linear, straight.document().motions()[h].linear);
}

TEST(DragsTogether, EveryPoseIsOnTheWayOfEach) {
    Desk desk(bar());
    desk.play(two_ends + together(turn('y', 30) + "," + turn('y', 60)) + drag(turn('y', 80)) +
              R"({"op":"drag","handle":"low","pivot":[0,0,0],"frames":[)" + turn('z', 10) + "]}\n" +
              together(turn('y', 90)));
    const std::vector<HandleMotion> top = desk.document().way_of("top"), low = desk.document().way_of("low");
    EXPECT_EQ(top.size(), 4U);
    ASSERT_EQ(low.size(), 4U);
    EXPECT_EQ(low.back().linear, desk.document().motions()[1].linear);
    EXPECT_EQ(low[1].rotation, top[1].rotation) << "as long as it had no pose of its own";
}

// The joint that its own drag had goes along, through a commit, too.
TEST(DragsTogether, TakePivotsAlong) {
    Desk desk(bar());
    const Vec3d origin = desk.document().cloud().origin;
    desk.play(two_ends + R"({"op":"drag","handle":"low","pivot":[0,0,-2.5],"frames":[)" + turn('z', 30) +
              "]}\n" + together(lift) + commit + together(turn('y', 90)));
    const Pivots pivots = desk.document().last_pivots();
    const Vec3d lifted(0.5, 0, -2.25);
    EXPECT_LT((pivots.at("low") - (turned_about_top(lifted, 90) - origin)).norm(), 1e-6);
    EXPECT_LT((pivots.at("top") - (Vec3d(0, 0, 2.5) - origin)).norm(), 1e-6);
}

TEST(DragsTogether, OnlyOfMovingHandlesOnce) {
    Desk desk(bar());
    desk.play(two_ends + foot);
    EXPECT_SAYS(refusal(desk, together(lift, R"("nobody")")), "\"with\": there is no handle \"nobody\" here");
    EXPECT_SAYS(refusal(desk, together(lift, R"("foot")")), "\"with\": \"foot\" is not a moving handle");
    EXPECT_SAYS(refusal(desk, together(lift, R"("top")")), "names a handle that is dragged already");
    EXPECT_SAYS(refusal(desk, together(lift, R"("low","low")")), "names a handle that is dragged already");
    EXPECT_SAYS(refusal(desk, together(lift, "3")), "with");
    desk.play(together(lift, ""));
    EXPECT_EQ(desk.document().motions()[1].offset, Vec3d::Zero());
}

} // namespace
} // namespace knead
