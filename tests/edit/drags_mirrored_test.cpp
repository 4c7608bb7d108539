// Handles that go along with one that is dragged as a mirror shows it.

#include "edit/editing.h"
#include "edit/handle_motion.h"
#include "edit/reflection.h"

namespace knead {
namespace {

using namespace knead::test;

// Two ends of a bar that is like its mirror image across z; its middle is held.
const std::string ends_and_middle =
    above("top", 2, "moving") +
    R"({"op":"handle","name":"low","role":"moving","region":{"halfspace":{"point":[0,0,-2],"normal":[0,0,-1]}}})"
    "\n"
    R"({"op":"handle","name":"middle","role":"fixed","region":{"box":{"min":[-9,-9,-0.2],"max":[9,9,0.2]}}})"
    "\n";

std::string mirrored(const std::string& frames,
                     const std::string& with = R"({"handle":"low","across":[0,0,-3],"pivot":[0,0,-2.5]})") {
    return R"({"op":"drag","handle":"top","pivot":[0,0,2.5],"with":[)" + with + R"(],"frames":[)" + frames +
           "]}\n";
}

const Reflection across_z{Vec3d::UnitZ(), Vec3d::Zero()};

HandleMotion motion_in(Desk& desk, int handle) {
    return desk.document().motions()[static_cast<std::size_t>(handle)];
}

void expect_same_map(const HandleMotion& a, const HandleMotion& b) {
    EXPECT_LT((a.linear - b.linear).norm(), 1e-12);
    EXPECT_LT((a.offset - b.offset).norm(), 1e-12);
}

TEST(DragsMirrored, DoWhatTheMirrorShows) {
    Desk desk(bar());
    ASSERT_LT(desk.document().cloud().origin.norm(), 1e-9) << "about which the mirror below is";
    desk.play(ends_and_middle + mirrored(turn('y', 30) + "," + turn('y', 60, "[0.3,0.2,0.1]")) + settle(300));
    expect_same_map(motion_in(desk, 1), seen_in(across_z, motion_in(desk, 0)));
    EXPECT_NEAR(motion_in(desk, 1).turned.y(), -motion_in(desk, 0).turned.y(), 1e-12);
    EXPECT_LT(desk.handle_error(), 1e-6);
}

// A whole turn and more is one on the other side, too, the other way round.
TEST(DragsMirrored, GoRoundTheOtherWay) {
    Desk desk(bar());
    std::string frames;
    for (int degrees = 30; degrees <= 690; degrees += 30)
        frames += (frames.empty() ? "" : ",") + turn('x', degrees);
    desk.play(ends_and_middle + mirrored(frames));
    EXPECT_NEAR(motion_in(desk, 0).turned.x(), 690 * std::numbers::pi / 180, 1e-4);
    EXPECT_NEAR(motion_in(desk, 1).turned.x(), -690 * std::numbers::pi / 180, 1e-4);
}

// Each about its own joint, whatever poses they had, and scaled along axes that lie aslant.
TEST(DragsMirrored, BeginWhereEachWas) {
    const std::string first = R"({"op":"drag","handle":"low","pivot":[0,0,-2.5],"frames":[)" +
                              turn('x', 40, "[0.5,0,0]") + "]}\n" + drag(turn('y', 30));
    Desk desk(bar());
    desk.play(ends_and_middle + first);
    const HandleMotion top = motion_in(desk, 0), low = motion_in(desk, 1);
    desk.play(mirrored(
        R"({"translate":[0,1,0],"rotate":[0.9,0.1,0.4,0],"scale":[1,2,0.5],"axes":[0.8,0.1,0.3,0.5]})",
        R"({"handle":"low","across":[1,2,3],"pivot":[0.5,0,-2]})"));
    const HandleMotion top_now = motion_in(desk, 0), low_now = motion_in(desk, 1);
    const Reflection mirror = reflection({1, 2, 3}, {0, 0, 2.5}, {0.5, 0, -2});
    const Mat3d map = top_now.linear * top.linear.inverse();
    for (const Vec3d& p : {Vec3d(0, 0, 0), Vec3d(1, 2, 3)}) {
        const Vec3d there = map * (p - top.offset) + top_now.offset; // what the drag did to a place
        const Vec3d rest = low.linear.inverse() * (seen_in(mirror, p) - low.offset);
        EXPECT_LT((low_now.linear * rest + low_now.offset - seen_in(mirror, there)).norm(), 1e-12);
    }
    EXPECT_LT(desk.handle_error(), 1e-6);
    desk.play(undo);
    EXPECT_EQ(motion_in(desk, 1).linear, low.linear);
}

TEST(DragsMirrored, AreMadeAgainToTheBit) {
    const std::string acts = mirrored(lift) + settle(5) + mirrored(turn('y', 40)) + drag(turn('x', 20));
    Desk straight(bar()), roundabout(bar());
    straight.play(ends_and_middle + acts);
    roundabout.document().keep_at_most({.shapes = 1, .samples = 1, .sample_bytes = 0});
    roundabout.play(ends_and_middle + acts + commit + undo + undo + undo + redo + redo + undo + redo);
    EXPECT_EQ(roundabout.shape(), straight.shape());
}

TEST(DragsMirrored, AreRefusedWithoutAMirror) {
    Desk desk(bar());
    desk.play(ends_and_middle);
    const auto refused = [&](const char* with) { return refusal(desk, mirrored(lift, with)); };
    EXPECT_SAYS(refused(R"({"handle":"low","across":[0,0,0],"pivot":[0,0,0]})"), "across");
    EXPECT_SAYS(refused(R"({"handle":"low","across":[0,0,1]})"), "pivot");
    EXPECT_SAYS(refused(R"({"handle":"low","pivot":[0,0,1]})"), "across");
    EXPECT_SAYS(refused(R"({"across":[0,0,1],"pivot":[0,0,1]})"), "handle");
    EXPECT_SAYS(refused(R"({"handle":"low","across":[0,0,1],"pivot":[0,0,1],"at":1})"), "at");
    EXPECT_SAYS(refused(R"({"handle":"top","across":[0,0,1],"pivot":[0,0,1]})"),
                "names a handle that is dragged already");
}

// What a hand does, seen in a mirror, is what the mirror shows of what it does.
TEST(Reflection, OfATransformIsThatOfItsMotion) {
    Transform transform;
    transform.pivot = {0.1, 0.2, 0.3};
    transform.shift = {1, -2, 0.5};
    transform.axis = glm::normalize(glm::dvec3(1, 2, -1));
    transform.angle = 7.5;
    transform.scale = {1, 2, 0.5};
    transform.axes = glm::normalize(glm::dquat(0.8, 0.1, 0.3, 0.5));
    const Reflection mirror = reflection({1, 2, 3}, {0, 1, 0}, {2, 0, -1});
    const HandleMotion one = followed_by({}, seen_in(mirror, transform));
    const HandleMotion other = seen_in(mirror, followed_by({}, transform));
    EXPECT_LT((one.linear - other.linear).norm(), 1e-12);
    EXPECT_LT((one.offset - other.offset).norm(), 1e-12);
    EXPECT_LT((one.rotation.coeffs() - other.rotation.coeffs()).norm(), 1e-9);
}

} // namespace
} // namespace knead
