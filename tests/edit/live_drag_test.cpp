// The way of a live drag from one pose to the next.

#include "edit/handle_motion.h"
#include "edit/live_drag.h"
#include "edit/way_back.h"

#include <gtest/gtest.h>

#include <numbers>

namespace knead {
namespace {

constexpr double degree = std::numbers::pi / 180;

Transform turn(const glm::dvec3& axis, double degrees) {
    Transform transform;
    transform.axis = axis;
    transform.angle = degrees * degree;
    return transform;
}

// Follows until it is there, frame by frame as a drag records them. Returns the motion at the end.
HandleMotion follow(Transform& shown, const Transform& wanted, HandleMotion motion, int& frames) {
    for (frames = 0; !(shown == wanted) && frames < 1000; ++frames) {
        const Transform next = next_on_the_way(shown, wanted);
        const HandleMotion before = motion;
        motion = motion_of(pose_of(followed_by({}, next), Vec3d::Zero(), Vec3d::Zero()), Vec3d::Zero(),
                           Vec3d::Zero(), before);
        const double cosine = std::min(1.0, before.rotation.dot(motion.rotation));
        EXPECT_LE(2 * std::acos(cosine), widest_turn * (1 + 1e-6)) << "a frame turns no farther";
        shown = next;
    }
    return motion;
}

TEST(LiveDrag, ATypedTurnWindsUp) {
    Transform shown;
    int frames = 0;
    const HandleMotion motion = follow(shown, turn({1, 0, 0}, 720), {}, frames);
    EXPECT_NEAR(frames, 720 * degree / widest_turn, 1);
    EXPECT_NEAR(motion.rotation.w(), 1, 1e-9); // 720° is two times round
}

TEST(LiveDrag, AnotherAxisInTheMiddleEndsWhereItWouldHaveAtOnce) {
    Transform at_once, shown;
    int frames = 0;
    const HandleMotion wanted = follow(at_once, turn({0, 0, 1}, 300), {}, frames);
    HandleMotion motion = follow(shown, turn({1, 0, 0}, 300), {}, frames);
    motion = follow(shown, turn({0, 0, 1}, 300), motion, frames);
    EXPECT_NEAR(wanted.rotation.w(), std::cos(150 * degree), 1e-9);
    EXPECT_NEAR(motion.rotation.w(), wanted.rotation.w(), 1e-9);
    EXPECT_NEAR(motion.rotation.z(), wanted.rotation.z(), 1e-9);
}

TEST(LiveDrag, ATurnThatIsNearIsTakenAtOnce) {
    Transform shown = turn({1, 0, 0}, 10);
    const Transform wanted = turn({0, 1, 0}, 5);
    EXPECT_EQ(next_on_the_way(shown, wanted), wanted);
}

} // namespace
} // namespace knead
