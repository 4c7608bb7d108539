#include "view/viewing.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace knead {
namespace {

using test::back_of;
using test::camera_from;
using test::near;
using test::pi;
using test::right_of;
using test::screen;
using test::up_of;

glm::dvec3 random_in(std::mt19937& random, double size) {
    std::uniform_real_distribution<double> uniform(-size, size);
    const double x = uniform(random);
    const double y = uniform(random);
    return {x, y, uniform(random)};
}

// In any direction, about any pivot, both ways of seeing, some with a pivot off the middle.
std::vector<Camera> many_cameras(double size) {
    std::mt19937 random(7);
    std::vector<Camera> cameras;
    for (int i = 0; i < 40; ++i) {
        Camera camera;
        camera.pivot = random_in(random, 0.2 * size);
        camera.distance = 2 * size;
        camera.orthographic = i % 2 == 1;
        const glm::dvec3 drag = random_in(random, 1000);
        orbit(camera, i % 3 == 0 ? Orbiting::trackball : Orbiting::turntable, {drag.x, drag.y}, screen);
        if (i % 4 < 2) set_pivot(camera, random_in(random, 0.3 * size));
        cameras.push_back(camera);
    }
    return cameras;
}

TEST(Camera, LooksAtEverySide) {
    struct Expected {
        Side side;
        glm::dvec3 eye, right, up;
    };
    const std::array<Expected, 6> all{{{Side::front, {0, -5, 0}, {1, 0, 0}, {0, 0, 1}},
                                       {Side::back, {0, 5, 0}, {-1, 0, 0}, {0, 0, 1}},
                                       {Side::right, {5, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                       {Side::left, {-5, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                                       {Side::top, {0, 0, 5}, {1, 0, 0}, {0, 1, 0}},
                                       {Side::bottom, {0, 0, -5}, {1, 0, 0}, {0, -1, 0}}}};
    for (const Expected& expected : all) {
        const Camera camera = camera_from(expected.side);
        EXPECT_TRUE(near(eye_of(camera), expected.eye, 1e-12));
        EXPECT_TRUE(near(right_of(camera), expected.right, 1e-12));
        EXPECT_TRUE(near(up_of(camera), expected.up, 1e-12));
    }
}

TEST(Camera, LooksAtEverySideWithYUpwards) {
    struct Expected {
        Side side;
        glm::dvec3 eye, right, up;
    };
    const std::array<Expected, 6> all{{{Side::front, {0, 0, 5}, {1, 0, 0}, {0, 1, 0}},
                                       {Side::back, {0, 0, -5}, {-1, 0, 0}, {0, 1, 0}},
                                       {Side::right, {5, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                       {Side::left, {-5, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                       {Side::top, {0, 5, 0}, {1, 0, 0}, {0, 0, -1}},
                                       {Side::bottom, {0, -5, 0}, {1, 0, 0}, {0, 0, 1}}}};
    for (const Expected& expected : all) {
        Camera camera;
        camera.distance = 5;
        camera.up = UpAxis::y;
        look_at_side(camera, expected.side);
        EXPECT_TRUE(near(eye_of(camera), expected.eye, 1e-12));
        EXPECT_TRUE(near(right_of(camera), expected.right, 1e-12));
        EXPECT_TRUE(near(up_of(camera), expected.up, 1e-12));
    }
}

TEST(Camera, AnotherUpwardAxisKeepsTheSideAndTheLevel) {
    Camera camera = camera_from(Side::front);
    orbit(camera, Orbiting::turntable, {130, 60}, screen);
    const glm::dvec3 from = back_of(camera);
    Camera tipped = camera;
    set_up(tipped, UpAxis::y);
    EXPECT_TRUE(near(back_of(tipped), {from.x, from.z, -from.y}, 1e-12))
        << "z where y was, and y to the back";
    EXPECT_NEAR(right_of(tipped).y, 0, 1e-12);
    for (int i = 0; i < 200; ++i) {
        orbit(tipped, Orbiting::turntable, {7.0 * (i % 9 - 4), 13.0 * (i % 5 - 2)}, screen);
        ASSERT_NEAR(right_of(tipped).y, 0, 1e-12);
        ASSERT_GE(up_of(tipped).y, -1e-12);
    }
    tipped = camera;
    set_up(tipped, UpAxis::y);
    set_up(tipped, UpAxis::z);
    EXPECT_TRUE(near(back_of(tipped), from, 1e-12));
    EXPECT_TRUE(near(up_of(tipped), up_of(camera), 1e-12)) << "and back";
    set_up(tipped, UpAxis::minus_y);
    EXPECT_TRUE(near(back_of(tipped), {from.x, -from.z, from.y}, 1e-12)) << "z where -y was, and y in front";
    EXPECT_LT(up_of(tipped).y, 0);
}

TEST(Camera, FirstViewStandsUpright) {
    const Box3 box{{-1, -2, -3}, {1, 2, 3}};
    const Camera z_up = first_view(box, screen), y_up = first_view(box, screen, UpAxis::y);
    EXPECT_LT(up_of(first_view(box, screen, UpAxis::minus_y)).y, -0.9);
    EXPECT_GT(up_of(z_up).z, 0.9);
    EXPECT_GT(up_of(y_up).y, 0.9);
    EXPECT_EQ(y_up.up, UpAxis::y);
}

TEST(Camera, HalfTheHeightIsAQuarterTurn) {
    for (const Orbiting style : {Orbiting::turntable, Orbiting::trackball}) {
        Camera camera = camera_from(Side::front);
        orbit(camera, style, {-300, 0}, screen); // what is in front goes to the left: seen from the right
        EXPECT_TRUE(near(eye_of(camera), {5, 0, 0}, 1e-12));
        EXPECT_TRUE(near(up_of(camera), {0, 0, 1}, 1e-12));
        camera = camera_from(Side::front);
        orbit(camera, style, {0, 300}, screen); // down: seen from above
        EXPECT_TRUE(near(eye_of(camera), {0, 0, 5}, 1e-12));
        EXPECT_TRUE(near(up_of(camera), {0, 1, 0}, 1e-12));
    }
}

TEST(Camera, ManySmallOrbitsAreOneLargeOne) {
    Camera camera = camera_from(Side::front);
    for (int i = 0; i < 1000; ++i) orbit(camera, Orbiting::turntable, {0.6, 0.1}, screen);
    Camera at_once = camera_from(Side::front);
    orbit(at_once, Orbiting::turntable, {600, 100}, screen);
    EXPECT_TRUE(near(eye_of(camera), eye_of(at_once), 1e-10));
    EXPECT_TRUE(near(up_of(camera), up_of(at_once), 1e-10));
}

TEST(Camera, TurntableStaysLevelAndStopsAtThePoles) {
    Camera camera = camera_from(Side::front);
    orbit(camera, Orbiting::turntable, {130, 0}, screen);
    const glm::dvec3 right = right_of(camera);
    for (int i = 0; i < 50; ++i) { // far over the pole
        orbit(camera, Orbiting::turntable, {0, 11}, screen);
        EXPECT_TRUE(near(right_of(camera), right, 1e-9)) << "the view does not spin round";
        EXPECT_GE(up_of(camera).z, -1e-12);
    }
    EXPECT_TRUE(near(back_of(camera), {0, 0, 1}, 1e-12));
    orbit(camera, Orbiting::turntable, {0, -300}, screen);
    EXPECT_TRUE(near(right_of(camera), right, 1e-9)) << "and comes back where it came from";
    EXPECT_NEAR(back_of(camera).z, 0, 1e-12);
    for (int i = 0; i < 200; ++i) {
        orbit(camera, Orbiting::turntable, {7.0 * (i % 9 - 4), 13.0 * (i % 5 - 2)}, screen);
        ASSERT_NEAR(right_of(camera).z, 0, 1e-12);
        ASSERT_NEAR(glm::length(camera.orientation), 1, 1e-12);
    }
}

TEST(Camera, TurntableLevelsWhatTheTrackballTilted) {
    Camera camera = camera_from(Side::front);
    orbit(camera, Orbiting::trackball, {100, 170}, screen);
    orbit(camera, Orbiting::trackball, {-220, 90}, screen);
    ASSERT_GT(std::abs(right_of(camera).z), 0.05);
    const glm::dvec3 back = back_of(camera);
    orbit(camera, Orbiting::turntable, {0, 0}, screen);
    EXPECT_NEAR(right_of(camera).z, 0, 1e-12);
    EXPECT_TRUE(near(back_of(camera), back, 1e-9)) << "the direction stays";
}

TEST(Camera, TrackballPassesOverThePole) {
    Camera camera = camera_from(Side::front);
    glm::dvec3 before = up_of(camera);
    for (int i = 0; i < 120; ++i) {
        orbit(camera, Orbiting::trackball, {0, 10}, screen);
        EXPECT_NEAR(glm::length(up_of(camera) - before), 2 * std::sin(pi / 120), 1e-9);
        before = up_of(camera);
    }
    EXPECT_TRUE(near(eye_of(camera), {0, -5, 0}, 1e-9)) << "a whole turn";
}

TEST(Camera, PanKeepsThePivotsPlaneUnderTheCursor) {
    for (Camera camera : many_cameras(1)) {
        const glm::dvec3 point = camera.pivot + 0.2 * right_of(camera) - 0.1 * up_of(camera);
        const glm::dvec2 before = project(camera, screen, point)->pixel;
        pan(camera, {37, -81}, screen);
        EXPECT_TRUE(near(project(camera, screen, point)->pixel, before + glm::dvec2(37, -81), 1e-9));
    }
}

TEST(Camera, ZoomKeepsWhatIsUnderTheCursor) {
    for (Camera camera : many_cameras(1)) {
        const double distance = camera.distance;
        const glm::dvec3 point = camera.pivot + 0.2 * right_of(camera) - 0.1 * up_of(camera);
        const glm::dvec2 pixel = project(camera, screen, point)->pixel;
        zoom(camera, 3, pixel, screen);
        EXPECT_NEAR(camera.distance, distance * 0.9 * 0.9 * 0.9, 1e-12);
        EXPECT_TRUE(near(project(camera, screen, point)->pixel, pixel, 1e-9));
        zoom(camera, -3, pixel, screen);
        EXPECT_NEAR(camera.distance, distance, 1e-12);
        EXPECT_TRUE(near(project(camera, screen, point)->pixel, pixel, 1e-9));
    }
}

TEST(Camera, ZoomNeverReachesThePivotNorLosesIt) {
    Camera camera = camera_from(Side::front);
    zoom(camera, 1e6, {400, 300}, screen);
    EXPECT_GT(camera.distance, 0);
    zoom(camera, -1e6, {400, 300}, screen);
    EXPECT_TRUE(std::isfinite(camera.distance));
    EXPECT_TRUE(std::isfinite(camera.pivot.x));
}

TEST(Camera, RaysGoThroughWhatIsProjected) {
    for (const double size : {1e-3, 1.0, 1e6}) {
        std::mt19937 random(3);
        for (const Camera& camera : many_cameras(size)) {
            const glm::dvec3 point = random_in(random, 0.4 * size);
            const std::optional<Projected> seen = project(camera, screen, point);
            ASSERT_TRUE(seen);
            const Ray ray = ray_through(camera, screen, seen->pixel);
            EXPECT_NEAR(glm::length(ray.direction), 1, 1e-12);
            const double along = glm::dot(point - ray.origin, ray.direction);
            EXPECT_TRUE(near(ray.origin + along * ray.direction, point, 1e-9 * size));
            const std::optional<Projected> again =
                project(camera, screen, ray.origin + (along + 0.3 * size) * ray.direction);
            ASSERT_TRUE(again);
            EXPECT_TRUE(near(again->pixel, seen->pixel, 1e-9 * 600));
        }
    }
}

TEST(Camera, MatricesAgreeWithProject) {
    const Box3 box{{-1, -1, -1}, {1, 1, 1}};
    std::mt19937 random(5);
    for (const Camera& camera : many_cameras(1)) {
        const glm::dmat4 matrix = projection_matrix(camera, screen, box) * view_matrix(camera);
        for (int i = 0; i < 10; ++i) {
            const glm::dvec3 point = random_in(random, 1);
            const std::optional<Projected> seen = project(camera, screen, point);
            if (!seen || seen->depth < 0.1) continue;
            const glm::dvec4 clip = matrix * glm::dvec4(point, 1);
            const glm::dvec3 device = glm::dvec3(clip) / clip.w;
            EXPECT_TRUE(near(glm::dvec2((device.x + 1) * 400, (1 - device.y) * 300), seen->pixel, 1e-8));
            EXPECT_LE(std::abs(device.z), 1) << "the box lies between the planes";
        }
    }
}

TEST(Camera, PlanesAreSoundWithTheEyeAnywhere) {
    const Box3 box{{-1, -1, -1}, {1, 1, 1}};
    for (const double distance : {1e-6, 0.01, 0.9, 1.0, 3.0, 1e4})
        for (const bool orthographic : {false, true})
            for (const Box3& seen : {box, Box3{{0, 0, 0}, {0, 0, 0}}, Box3{{-1, -9, -1}, {1, -8, 1}}}) {
                Camera camera = camera_from(Side::front, distance);
                camera.orthographic = orthographic;
                const glm::dmat4 matrix = projection_matrix(camera, screen, seen);
                for (int c = 0; c < 4; ++c)
                    for (int r = 0; r < 4; ++r) EXPECT_TRUE(std::isfinite(matrix[c][r]));
                EXPECT_LT(matrix[2][2], 0);
                // The pivot is drawn, wherever the eye is, if the box holds it.
                const glm::dvec4 clip = matrix * view_matrix(camera) * glm::dvec4(camera.pivot, 1);
                if (seen.lowest.y > -2) {
                    EXPECT_LE(std::abs(clip.z), clip.w * (1 + 1e-9));
                }
            }
}

TEST(Camera, ProjectsNothingBehindTheEye) {
    Camera camera = camera_from(Side::front);
    EXPECT_TRUE(project(camera, screen, {0, -4.9, 0}));
    EXPECT_FALSE(project(camera, screen, {0, -5, 0}));
    EXPECT_FALSE(project(camera, screen, {0.1, -6, 0}));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(project(camera, screen, {nan, 0, 0}));
    camera.orthographic = true;
    EXPECT_TRUE(project(camera, screen, {0.1, -6, 0}));
    EXPECT_FALSE(project(camera, screen, {nan, 0, 0}));
}

TEST(Camera, FramesABoxWithASmallMargin) {
    for (const double size : {1e-3, 1.0, 1e6})
        for (const Viewport viewport : {screen, Viewport{300, 900}})
            for (Camera camera : many_cameras(size)) {
                const glm::dquat direction = camera.orientation;
                const Box3 box{{2 * size, -size, 0}, {3 * size, 0.5 * size, 0.2 * size}};
                frame(camera, box, viewport);
                EXPECT_EQ(camera.orientation, direction);
                double fills = 0;
                for (unsigned i = 0; i < 8; ++i) {
                    const glm::dvec3 corner{i & 1U ? box.highest.x : box.lowest.x,
                                            i & 2U ? box.highest.y : box.lowest.y,
                                            i & 4U ? box.highest.z : box.lowest.z};
                    const glm::dvec2 pixel = project(camera, viewport, corner)->pixel;
                    fills = std::max({fills, std::abs(2 * pixel.x / viewport.width - 1),
                                      std::abs(2 * pixel.y / viewport.height - 1)});
                }
                EXPECT_NEAR(fills, 0.9, 1e-6);
            }
}

TEST(Camera, FramesAPointFromWhereItIs) {
    Camera camera = camera_from(Side::right, 3);
    frame(camera, {{1, 2, 3}, {1, 2, 3}}, screen);
    EXPECT_EQ(camera.pivot, glm::dvec3(1, 2, 3));
    EXPECT_EQ(camera.distance, 3);
    const double infinity = std::numeric_limits<double>::infinity();
    frame(camera, {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}}, screen);
    EXPECT_EQ(camera.pivot, glm::dvec3(1, 2, 3));
}

TEST(Camera, FirstViewIsFromAboveTheFrontRight) {
    const Camera camera = first_view({{-1, -2, -3}, {1, 2, 3}}, screen);
    EXPECT_GT(eye_of(camera).x, 1);
    EXPECT_LT(eye_of(camera).y, -2);
    EXPECT_GT(eye_of(camera).z, 1);
    EXPECT_NEAR(right_of(camera).z, 0, 1e-12);
    EXPECT_GT(first_view({{0, 0, 0}, {0, 0, 0}}, screen).distance, 0);
}

TEST(Camera, ANewPivotMovesNothingThatIsSeen) {
    std::mt19937 random(9);
    for (Camera camera : many_cameras(1)) {
        const glm::dvec3 pivot = random_in(random, 0.3);
        const glm::dvec3 other = random_in(random, 0.3);
        const glm::dvec2 at = project(camera, screen, pivot)->pixel;
        const glm::dvec2 other_at = project(camera, screen, other)->pixel;
        set_pivot(camera, pivot);
        EXPECT_EQ(camera.pivot, pivot);
        EXPECT_TRUE(near(project(camera, screen, other)->pixel, other_at, 1e-9));
        orbit(camera, Orbiting::turntable, {200, -50}, screen);
        EXPECT_TRUE(near(project(camera, screen, pivot)->pixel, at, 1e-9)) << "it turns about that";
    }
}

TEST(Camera, APivotBehindTheEyeComesToTheMiddle) {
    Camera camera = camera_from(Side::front);
    set_pivot(camera, {3, -9, 1});
    EXPECT_TRUE(near(project(camera, screen, {3, -9, 1})->pixel, {400, 300}, 1e-9));
}

TEST(Camera, OrthographicShowsThePivotInTheSameSize) {
    Camera camera = camera_from(Side::front);
    const double size = pixel_size_at(camera, screen, camera.pivot);
    EXPECT_NEAR(size, 2 * 5 * std::tan(0.3) / 600, 1e-15);
    EXPECT_GT(pixel_size_at(camera, screen, {0, 1, 0}), size);
    camera.orthographic = true;
    EXPECT_EQ(pixel_size_at(camera, screen, camera.pivot), size);
    EXPECT_EQ(pixel_size_at(camera, screen, {0, 1, 0}), size);
}

} // namespace
} // namespace knead
