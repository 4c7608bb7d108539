#include "view/transform_drag.h"

#include "view/amount_text.h"
#include "view/typed_amount.h"
#include "view/viewing.h"

#include <array>
#include <cmath>
#include <string_view>

namespace knead {
namespace {

using test::camera_from;
using test::near;
using test::pi;
using test::screen;

const glm::dquat quarter_about_z = glm::angleAxis(pi / 2, glm::dvec3(0, 0, 1));
constexpr glm::dvec2 middle{400, 300};

// A drag of a handle at the origin, seen from the front: one pixel is `pixel` long.
struct Scene {
    Camera camera = camera_from(Side::front);
    TransformDrag drag;
    double pixel = pixel_size_at(camera, screen, {0, 0, 0});

    explicit Scene(TransformKind kind, glm::dvec2 cursor = {500, 300}, const glm::dquat& axes = {1, 0, 0, 0})
        : drag(begin_transform(kind, {0, 0, 0}, axes, cursor, camera, screen)) {}

    void move(glm::dvec2 cursor, bool slow = false) { follow_cursor(drag, cursor, slow, camera, screen); }
    void type(std::string_view text) {
        for (const char c : text) EXPECT_TRUE(type_character(drag, c));
    }
    void constrain(int axis, bool plane = false, bool local = false) {
        drag.constraint = {plane ? Constraint::Kind::plane : Constraint::Kind::axis, axis, local};
    }
    Transform now() const { return transform_of(drag); }
    // Goes round the pivot against the clock, 100 pixels away.
    void round(double turns) {
        for (int i = 1; i <= 40; ++i) {
            const double angle = 2 * pi * turns * i / 40;
            move(middle + 100.0 * glm::dvec2(std::cos(angle), -std::sin(angle)));
        }
    }
};

TEST(Transform, TurnsAndScalesAboutItsPivot) {
    Transform transform;
    EXPECT_TRUE(near(transformed(transform, {1, 2, 3}), {1, 2, 3}, 1e-15));
    transform.pivot = {1, 0, 0};
    transform.angle = pi / 2;
    transform.scale = {2, 1, 1};
    transform.axes = quarter_about_z; // x of the axes is y of the world
    transform.shift = {0, 0, 5};
    EXPECT_TRUE(near(transformed(transform, {1, 1, 0}), {-1, 0, 5}, 1e-12));
    EXPECT_TRUE(near(transformed(transform, {2, 0, 0}), {1, 1, 5}, 1e-12));
}

TEST(Translating, FreelyFollowsTheCursorInTheScreensPlane) {
    Scene scene(TransformKind::translate, {123, 456});
    scene.move({163, 386});
    EXPECT_TRUE(near(scene.now().shift, {40 * scene.pixel, 0, 70 * scene.pixel}, 1e-12));
    scene.move({123, 456});
    EXPECT_EQ(scene.now().shift, glm::dvec3(0.0));
}

TEST(Translating, PutsThePivotUnderTheCursor) {
    // Grabbed upon the pivot, from an oblique camera: it stays under the cursor as far as the constraint lets
    // it.
    for (const bool orthographic : {false, true}) {
        Camera camera = camera_from(Side::front);
        orbit(camera, Orbiting::turntable, {-80, 90}, screen);
        camera.orthographic = orthographic;
        const glm::dvec3 pivot{0.3, 0.2, -0.1};
        const glm::dvec2 start = project(camera, screen, pivot)->pixel;
        for (int axis = 0; axis < 3; ++axis) {
            TransformDrag drag =
                begin_transform(TransformKind::translate, pivot, {1, 0, 0, 0}, start, camera, screen);
            drag.constraint = {Constraint::Kind::plane, axis, false};
            follow_cursor(drag, start + glm::dvec2(70, -40), false, camera, screen);
            const glm::dvec3 shift = transform_of(drag).shift;
            EXPECT_EQ(shift[axis], 0);
            EXPECT_TRUE(
                near(project(camera, screen, pivot + shift)->pixel, start + glm::dvec2(70, -40), 1e-8));

            // Towards where the axis runs on the screen, the cursor is on the axis.
            glm::dvec3 along(0.0);
            along[axis] = 0.4;
            const glm::dvec2 goal = project(camera, screen, pivot + along)->pixel;
            drag.constraint.kind = Constraint::Kind::axis;
            follow_cursor(drag, goal, false, camera, screen);
            EXPECT_TRUE(near(transform_of(drag).shift, along, 1e-9));
        }
    }
}

TEST(Translating, AlongTheHandlesOwnAxis) {
    Scene scene(TransformKind::translate, middle, quarter_about_z);
    scene.constrain(1, false, true); // own y is -x of the world
    scene.move({300, 250});
    const glm::dvec3 shift = scene.now().shift;
    EXPECT_LT(shift.x, -90 * scene.pixel);
    EXPECT_NEAR(shift.y, 0, 1e-12);
    EXPECT_NEAR(shift.z, 0, 1e-12);
}

TEST(Translating, NeverFlipsBeyondTheVanishingPoint) {
    Camera camera = camera_from(Side::front);
    orbit(camera, Orbiting::turntable, {-100, 20}, screen);
    TransformDrag drag =
        begin_transform(TransformKind::translate, {0, 0, 0}, {1, 0, 0, 0}, middle, camera, screen);
    drag.constraint = {Constraint::Kind::axis, 1, false}; // y runs away from the eye
    const glm::dvec2 away = project(camera, screen, {0, 0.1, 0})->pixel - middle;
    double before = 0;
    for (int i = 1; i < 3000; ++i) {
        follow_cursor(drag, middle + static_cast<double>(i) * glm::normalize(away), false, camera, screen);
        const double shift = transform_of(drag).shift.y;
        EXPECT_GE(shift, before);
        before = shift;
    }
    EXPECT_TRUE(std::isfinite(before));
    drag.constraint = {Constraint::Kind::plane, 2, false}; // and the horizon of the ground
    follow_cursor(drag, middle + glm::dvec2(0, -5000), false, camera, screen);
    EXPECT_GT(glm::dot(transform_of(drag).shift, glm::dvec3(0, 1, 0)), 10);
    EXPECT_TRUE(std::isfinite(glm::length(transform_of(drag).shift)));
}

// A few pixels more and the cursor points at the sky: the handle is not to be gone by then.
TEST(Translating, GoesNoFartherThanTwentyTimesTheHandNearTheHorizon) {
    for (const double height : {10.0, 20.0, 60.0}) {
        Camera camera = camera_from(Side::front);
        orbit(camera, Orbiting::turntable, {0, height}, screen);
        TransformDrag drag =
            begin_transform(TransformKind::translate, {0, 0, 0}, {1, 0, 0, 0}, middle, camera, screen);
        drag.constraint = {Constraint::Kind::plane, 2, false};
        const double pixel = pixel_size_at(camera, screen, drag.pivot);
        double before = 0;
        for (int way = 1; way < 400; ++way) {
            follow_cursor(drag, middle - glm::dvec2(0, way), false, camera, screen);
            const glm::dvec3 shift = transform_of(drag).shift;
            EXPECT_LE(glm::length(shift), 20.001 * way * pixel);
            EXPECT_GE(shift.y, before) << "nor ever back";
            before = shift.y;
        }
    }
}

TEST(Translating, AlongAnAxisSeenEndOnFollowsTheHandUpwards) {
    Scene scene(TransformKind::translate, middle);
    scene.constrain(1); // away from the eye
    scene.move(middle + glm::dvec2(30, -50));
    EXPECT_TRUE(near(scene.now().shift, {0, 50 * scene.pixel, 0}, 1e-12));
    scene.constrain(2, true); // the ground from its edge
    scene.move(middle + glm::dvec2(30, -50));
    EXPECT_TRUE(near(scene.now().shift, {30 * scene.pixel, 0, 0}, 1e-12));
}

TEST(Rotating, FollowsTheCursorRoundThePivot) {
    Scene scene(TransformKind::rotate);
    scene.move({400, 200}); // from the right to above
    EXPECT_NEAR(scene.now().angle, pi / 2, 1e-12);
    EXPECT_TRUE(near(scene.now().axis, {0, -1, 0}, 1e-12)) << "towards the eye";
    EXPECT_TRUE(near(transformed(scene.now(), {1, 0, 0}), {0, 0, 1}, 1e-12)) << "what was right is above";
}

TEST(Rotating, CountsWholeTurns) {
    Scene scene(TransformKind::rotate);
    scene.round(2);
    EXPECT_NEAR(scene.now().angle, 4 * pi, 1e-9);
    scene.round(-3);
    EXPECT_NEAR(scene.now().angle, -2 * pi, 1e-9);
    scene.round(0.125);
    EXPECT_NEAR(scene.now().angle, -1.75 * pi, 1e-9);
}

TEST(Rotating, AboutAnAxisGoesWithTheHandFromBothSides) {
    for (const Side side : {Side::front, Side::back}) {
        Scene scene(TransformKind::rotate);
        scene.camera = camera_from(side);
        scene.drag =
            begin_transform(TransformKind::rotate, {0, 0, 0}, {1, 0, 0, 0}, {500, 300}, scene.camera, screen);
        scene.constrain(1);
        scene.move({400, 200});
        EXPECT_NEAR(std::abs(scene.now().angle), pi / 2, 1e-12);
        const glm::dvec3 right = test::right_of(scene.camera);
        EXPECT_TRUE(near(transformed(scene.now(), right), {0, 0, 1}, 1e-12)) << "what was right is above";
    }
}

TEST(Rotating, AboutAnAxisInTheScreenGoesWithTheHandAcross) {
    Scene scene(TransformKind::rotate, {420, 310});
    scene.constrain(2);
    scene.move({465, 210}); // 45 to the right; up and down does nothing
    EXPECT_NEAR(scene.now().angle, 0.5, 1e-12);
    const glm::dvec3 front = transformed(scene.now(), {0, -1, 0});
    EXPECT_GT(front.x, 0) << "what faces the eye goes to the right";
    scene.constrain(0);
    scene.drag.turned = 0;
    scene.move({465, 255}); // 45 down
    EXPECT_NEAR(scene.now().angle, 0.5, 1e-12);
    EXPECT_LT(transformed(scene.now(), {0, -1, 0}).z, 0);
}

TEST(Rotating, AcrossThePivotDoesNotJump) {
    Scene scene(TransformKind::rotate);
    scene.move({401, 300.5}); // upon it there is no angle
    EXPECT_EQ(scene.now().angle, 0);
    scene.move({500, 300});
    EXPECT_NEAR(scene.now().angle, 0, 1e-12);
    scene.move(middle);
    scene.move({400, 200});
    EXPECT_NEAR(scene.now().angle, pi / 2, 1e-12);
}

TEST(Scaling, IsTheRatioOfTheDistancesFromThePivot) {
    Scene scene(TransformKind::scale);
    scene.move({400, 450});
    EXPECT_TRUE(near(scene.now().scale, {1.5, 1.5, 1.5}, 1e-12));
    scene.constrain(1);
    EXPECT_TRUE(near(scene.now().scale, {1, 1.5, 1}, 1e-12));
    scene.constrain(1, true);
    EXPECT_TRUE(near(scene.now().scale, {1.5, 1, 1.5}, 1e-12));
    scene.move(middle);
    EXPECT_TRUE(near(scene.now().scale, {0.01, 1, 0.01}, 1e-12)) << "never to nothing";
}

TEST(Scaling, AlongTheHandlesOwnAxes) {
    Scene scene(TransformKind::scale, {500, 300}, quarter_about_z);
    scene.constrain(0, false, true);
    scene.move({600, 300});
    EXPECT_TRUE(near(transformed(scene.now(), {1, 1, 1}), {1, 2, 1}, 1e-12));
}

TEST(Scaling, BegunUponThePivotStaysCalm) {
    Scene scene(TransformKind::scale, middle);
    EXPECT_EQ(scene.now().scale, glm::dvec3(1.0));
    scene.move({405, 300});
    EXPECT_NEAR(scene.now().scale.x, 1.5, 1e-9);
}

TEST(TransformDrag, ShiftTakesATenthOfTheWay) {
    Scene scene(TransformKind::translate);
    scene.move({530, 300});
    scene.move({630, 200}, true);
    EXPECT_TRUE(near(scene.now().shift, {40 * scene.pixel, 0, 10 * scene.pixel}, 1e-12));
    scene.move({640, 200});
    EXPECT_TRUE(near(scene.now().shift, {50 * scene.pixel, 0, 10 * scene.pixel}, 1e-12));
    Scene turn(TransformKind::rotate);
    turn.move({400, 200}, true);
    EXPECT_NEAR(turn.now().angle, pi / 20, 1e-12);
}

TEST(TransformDrag, CtrlSnapsToWholeSteps) {
    Scene turn(TransformKind::rotate);
    turn.drag.snap = true;
    turn.move({500, 281});
    EXPECT_NEAR(turn.now().angle, 10 * pi / 180, 1e-12);
    Scene size(TransformKind::scale);
    size.drag.snap = true;
    size.move({527, 300});
    EXPECT_NEAR(size.now().scale.x, 1.3, 1e-12);
    size.move(middle);
    EXPECT_GT(size.now().scale.x, 0);
    Scene shift(TransformKind::translate);
    shift.drag.snap = true;
    EXPECT_NEAR(shift.drag.grid, 0.1, 1e-12) << "20 pixels are 0.103";
    shift.move({527, 262});
    EXPECT_TRUE(near(shift.now().shift, {0.1, 0, 0.2}, 1e-12));
    shift.constrain(0);
    EXPECT_TRUE(near(shift.now().shift, {0.1, 0, 0}, 1e-12));
}

TEST(TransformDrag, TypedNumbersOverrideTheCursor) {
    Scene turn(TransformKind::rotate);
    turn.move({412, 212});
    press_axis(turn.drag, 0, false);
    turn.type("45");
    EXPECT_NEAR(turn.now().angle, pi / 4, 1e-15);
    EXPECT_EQ(turn.now().axis, glm::dvec3(1, 0, 0));
    turn.type("-");
    EXPECT_NEAR(turn.now().angle, -pi / 4, 1e-15);
    turn.type("-.5");
    EXPECT_NEAR(turn.now().angle, 45.5 * pi / 180, 1e-15);
    turn.type("\b\b\b0");
    EXPECT_NEAR(turn.now().angle, 40 * pi / 180, 1e-15);
    turn.type("\b\b\b");
    EXPECT_NEAR(turn.now().angle, turn.drag.turned, 1e-15) << "nothing typed: the cursor again";
    EXPECT_FALSE(type_character(turn.drag, 'x'));
    EXPECT_FALSE(type_character(turn.drag, ' '));

    Scene shift(TransformKind::translate);
    shift.move({412, 212});
    shift.type("2,5");
    EXPECT_EQ(shift.now().shift, glm::dvec3(2.5, 0, 0)) << "free: along x";
    shift.constrain(2);
    EXPECT_EQ(shift.now().shift, glm::dvec3(0, 0, 2.5));
    shift.constrain(0, true);
    EXPECT_EQ(shift.now().shift, glm::dvec3(0, 2.5, 0));

    Scene size(TransformKind::scale);
    size.move({412, 212});
    size.type("-");
    EXPECT_EQ(size.now().scale, glm::dvec3(1.0)) << "no number yet";
    size.type("-2");
    EXPECT_EQ(size.now().scale, glm::dvec3(2.0));
    size.type("\b0");
    EXPECT_GT(size.now().scale.x, 0);
}

TEST(TransformDrag, TabGoesToTheNextLength) {
    Scene scene(TransformKind::translate);
    scene.type("1");
    next_field(scene.drag, false);
    EXPECT_EQ(amount_text(scene.drag), "G  X [1]  Y []  Z 0.000") << "where the next digit goes is seen";
    scene.type("2");
    next_field(scene.drag, false);
    scene.type("-3");
    EXPECT_EQ(scene.now().shift, glm::dvec3(1, 2, -3));
    next_field(scene.drag, false);
    scene.type("5");
    EXPECT_EQ(scene.now().shift, glm::dvec3(15, 2, -3)) << "round again";
    next_field(scene.drag, true);
    scene.type("\b\b4");
    EXPECT_EQ(scene.now().shift, glm::dvec3(15, 2, 4));
    scene.constrain(1, true); // x and z are left
    EXPECT_EQ(scene.now().shift, glm::dvec3(15, 0, 2)) << "in the order of what is left";
    scene.constrain(2);
    EXPECT_EQ(scene.now().shift, glm::dvec3(0, 0, 15));
    next_field(scene.drag, false);
    scene.type("7");
    EXPECT_EQ(scene.now().shift, glm::dvec3(7, 0, 15)) << "free again";
    EXPECT_EQ(amount_text(scene.drag), "G  X [7]  Y 0.000  Z [15]");
    press_axis(scene.drag, 2, false);
    EXPECT_EQ(amount_text(scene.drag), "G  Z [15]  along world Z") << "its own again";
    scene.type("\b\b");
    next_field(scene.drag, false);
    EXPECT_EQ(scene.drag.constraint.kind, Constraint::Kind::axis) << "the cursor drives along it";
    scene.drag.constraint = {};
    scene.type("7");
    scene.drag.own_first = true;
    press_axis(scene.drag, 1, false);
    next_field(scene.drag, true);
    EXPECT_EQ(amount_text(scene.drag), "G  X []  Y [7]  Z 0.000  along own axes");

    Scene turn(TransformKind::rotate);
    turn.type("9");
    next_field(turn.drag, false);
    turn.type("0");
    EXPECT_NEAR(turn.now().angle, pi / 2, 1e-15) << "a turn has one number";
}

TEST(TransformDrag, OwnAxesComeFirstWhereTheyAreAskedFor) {
    Scene scene(TransformKind::translate);
    scene.drag.own_first = true;
    press_axis(scene.drag, 1, false);
    EXPECT_EQ(scene.drag.constraint, (Constraint{Constraint::Kind::axis, 1, true}));
    press_axis(scene.drag, 1, false);
    EXPECT_EQ(scene.drag.constraint, (Constraint{Constraint::Kind::axis, 1, false}));
    press_axis(scene.drag, 1, false);
    EXPECT_EQ(scene.drag.constraint, Constraint{});
}

TEST(TransformDrag, AnyLengthOfTypingIsANumber) {
    Scene scene(TransformKind::translate);
    for (int i = 0; i < 400; ++i) scene.type("9");
    EXPECT_TRUE(std::isfinite(scene.now().shift.x));
    for (int i = 0; i < 400; ++i) scene.type("\b");
    EXPECT_TRUE(scene.drag.typed[0].empty());
    scene.type("1.2.3");
    EXPECT_EQ(scene.now().shift.x, 1.23) << "the second point is left out";
}

TEST(TransformDrag, SumsAreNumbersAsFarAsTheyAreTyped) {
    Scene scene(TransformKind::translate);
    scene.type("10");
    scene.type("/");
    EXPECT_EQ(scene.now().shift.x, 10);
    scene.type("4");
    EXPECT_EQ(scene.now().shift.x, 2.5);
    scene.type("-1,5");
    EXPECT_EQ(scene.now().shift.x, 1) << "a minus behind an operator is one";
    scene.type("**2");
    EXPECT_EQ(scene.now().shift.x, -0.5) << "the second star is left out";
    for (int i = 0; i < 20; ++i) scene.type("\b");
    scene.type("*3-");
    EXPECT_EQ(scene.now().shift.x, -3) << "with no number before it a star is none";
    scene.type("/0");
    EXPECT_TRUE(std::isfinite(scene.now().shift.x));
}

TEST(TransformDrag, AxisKeysGoThroughWorldOwnAndFree) {
    Scene scene(TransformKind::translate);
    const auto kind = [&] { return scene.drag.constraint; };
    press_axis(scene.drag, 1, false);
    EXPECT_EQ(kind(), (Constraint{Constraint::Kind::axis, 1, false}));
    press_axis(scene.drag, 1, false);
    EXPECT_EQ(kind(), (Constraint{Constraint::Kind::axis, 1, true}));
    press_axis(scene.drag, 1, false);
    EXPECT_EQ(kind(), Constraint{});
    press_axis(scene.drag, 0, false);
    press_axis(scene.drag, 2, false);
    EXPECT_EQ(kind(), (Constraint{Constraint::Kind::axis, 2, false}));
    press_axis(scene.drag, 2, true);
    EXPECT_EQ(kind(), (Constraint{Constraint::Kind::plane, 2, false}));
    press_axis(scene.drag, 2, true);
    EXPECT_EQ(kind(), (Constraint{Constraint::Kind::plane, 2, true}));
    press_axis(scene.drag, 2, true);
    EXPECT_EQ(kind(), Constraint{});
}

TEST(TransformDrag, ConstrainingKeepsTheTurnThatWasSeen) {
    Scene scene(TransformKind::rotate);
    scene.move({400, 200});
    press_axis(scene.drag, 1, false); // away from the eye
    EXPECT_TRUE(near(transformed(scene.now(), {1, 0, 0}), {0, 0, 1}, 1e-12));
    press_axis(scene.drag, 1, false);
    press_axis(scene.drag, 1, false);
    EXPECT_TRUE(near(transformed(scene.now(), {1, 0, 0}), {0, 0, 1}, 1e-12));
}

TEST(TransformDrag, StaysWhereItIsWhileTheCameraMoves) {
    for (const TransformKind kind : {TransformKind::translate, TransformKind::rotate, TransformKind::scale})
        for (const int axis : {-1, 0, 1, 2}) {
            Scene scene(kind);
            if (axis >= 0) scene.constrain(axis);
            scene.move({530, 220});
            const Transform before = scene.now();
            for (int i = 0; i < 30; ++i) {
                orbit(scene.camera, Orbiting::turntable, {9, 7}, screen);
                hold_transform(scene.drag, {530.0 + 9 * i, 220.0 + 7 * i}, scene.camera, screen);
                const Transform now = scene.now();
                EXPECT_TRUE(near(now.shift, before.shift, 1e-12));
                EXPECT_EQ(now.angle, before.angle);
                EXPECT_EQ(now.axis, before.axis);
                EXPECT_TRUE(near(now.scale, before.scale, 1e-12));
            }
            // And without being told: the next motion counts under the new camera only.
            const glm::dvec2 hand = scene.drag.hand;
            zoom(scene.camera, 2, {0, 0}, screen);
            scene.move(hand);
            EXPECT_TRUE(near(transformed(scene.now(), {1, 1, 1}), transformed(before, {1, 1, 1}), 1e-9));
            scene.move(hand + glm::dvec2(0.01, 0));
            EXPECT_TRUE(near(transformed(scene.now(), {1, 1, 1}), transformed(before, {1, 1, 1}), 1e-2));
        }
}

TEST(TransformDrag, GoesOnFromWhereItWas) {
    Scene scene(TransformKind::translate);
    scene.move({540, 300});
    look_at_side(scene.camera, Side::right);
    hold_transform(scene.drag, {100, 100}, scene.camera, screen);
    scene.move({130, 100});
    EXPECT_TRUE(near(scene.now().shift, {40 * scene.pixel, 30 * scene.pixel, 0}, 1e-12));
    Scene size(TransformKind::scale);
    size.move({600, 300});
    look_at_side(size.camera, Side::right);
    hold_transform(size.drag, {400, 200}, size.camera, screen);
    size.move({400, 150});
    EXPECT_NEAR(size.now().scale.x, 3, 1e-12);
}

TEST(TransformDrag, HasARoundGridThatSuitsTheView) {
    for (const double distance : {0.001, 0.02, 1.0, 7.0, 3e6}) {
        const Camera camera = camera_from(Side::front, distance);
        const TransformDrag drag =
            begin_transform(TransformKind::translate, {0, 0, 0}, {1, 0, 0, 0}, middle, camera, screen);
        const double pixels = drag.grid / pixel_size_at(camera, screen, {0, 0, 0});
        EXPECT_GT(pixels, 10);
        EXPECT_LT(pixels, 40);
        const double digits = drag.grid / std::pow(10, std::floor(std::log10(drag.grid * 1.0001)));
        EXPECT_NEAR(digits * (digits - 1) * (digits - 2) * (digits - 5), 0, 1e-6) << drag.grid;
    }
}

TEST(TransformDrag, WithItsPivotBehindTheEyeIsStillFinite) {
    for (const TransformKind kind : {TransformKind::translate, TransformKind::rotate, TransformKind::scale}) {
        TransformDrag drag =
            begin_transform(kind, {0, -9, 0}, {1, 0, 0, 0}, {450, 300}, camera_from(Side::front), screen);
        follow_cursor(drag, {470, 210}, false, drag.camera, screen);
        const glm::dvec3 p = transformed(transform_of(drag), {1, 1, 1});
        EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    }
}

TEST(AmountText, SaysWhatWasDone) {
    Scene turn(TransformKind::rotate);
    turn.move({400, 200});
    EXPECT_EQ(amount_text(turn.drag), "R  90.0°");
    turn.constrain(0, false, true);
    turn.type("45");
    EXPECT_EQ(amount_text(turn.drag), "R  [45]°  about own X");
    Scene size(TransformKind::scale);
    size.move({530, 300});
    EXPECT_EQ(amount_text(size.drag), "S  × 1.30");
    size.constrain(2, true);
    EXPECT_EQ(amount_text(size.drag), "S  × 1.30  in world XY");
    size.type("0");
    EXPECT_EQ(amount_text(size.drag), "S  × [0] is 0.01  in world XY");
    Scene wound(TransformKind::rotate);
    wound.type("99999");
    EXPECT_EQ(amount_text(wound.drag), "R  [99999] is 7119.0°")
        << "twenty turns, and what is left of the others";
    size.type(".5");
    EXPECT_EQ(amount_text(size.drag), "S  × [0.5]  in world XY");
    Scene shift(TransformKind::translate);
    shift.drag.snap = true;
    shift.move({600, 300});
    shift.constrain(0);
    EXPECT_EQ(amount_text(shift.drag), "G  X 0.500  along world X");
    shift.constrain(1, true);
    EXPECT_EQ(amount_text(shift.drag), "G  X 0.500  Z 0.000  in world XZ");
    shift.drag.constraint = {};
    EXPECT_EQ(amount_text(shift.drag), "G  X 0.500  Y 0.000  Z 0.000");
    shift.type("2");
    EXPECT_EQ(amount_text(shift.drag), "G  X [2]  Y 0.000  Z 0.000");
    shift.constrain(0, true);
    EXPECT_EQ(amount_text(shift.drag), "G  Y [2]  Z 0.000  in world YZ");
}

TEST(Scaling, TabGoesToTheFactorOfTheNextAxis) {
    Scene scene(TransformKind::scale);
    const auto type = [&](std::string_view text) {
        for (const char c : text) type_character(scene.drag, c);
    };
    scene.constrain(0);
    type("1.5");
    next_field(scene.drag, false);
    EXPECT_TRUE(near(scene.now().scale, {1.5, 1, 1}, 1e-12));
    type("2");
    EXPECT_TRUE(near(scene.now().scale, {1.5, 2, 1}, 1e-12));
    EXPECT_EQ(amount_text(scene.drag), "S  ×  X [1.5]  Y [2]  Z 1.00");
    next_field(scene.drag, false);
    type("0");
    EXPECT_TRUE(near(scene.now().scale, {1.5, 2, 0.01}, 1e-12)) << "never to nothing";
    next_field(scene.drag, true);
    type("\b");
    EXPECT_TRUE(near(scene.now().scale, {1.5, 1, 0.01}, 1e-12)) << "what is not typed stays as large";
    press_axis(scene.drag, 2, false);
    EXPECT_TRUE(near(scene.now().scale, {1, 1, 0.01}, 1e-12)) << "each axis keeps its own";
}

TEST(AmountText, NothingIsNeverNegative) {
    Scene shift(TransformKind::translate);
    shift.move({499.99, 300.01});
    EXPECT_EQ(amount_text(shift.drag), "G  X 0.000  Y 0.000  Z 0.000");
    shift.move({300, 300});
    EXPECT_EQ(amount_text(shift.drag).find("-0.0"), std::string::npos);
    EXPECT_NE(amount_text(shift.drag).find("X -"), std::string::npos);
    Scene turn(TransformKind::rotate);
    turn.move({499.99, 300.01});
    EXPECT_EQ(amount_text(turn.drag), "R  0.0°");
}

} // namespace
} // namespace knead
