#include "view/gizmo.h"

#include "view/viewing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace knead {
namespace {

using test::camera_from;
using test::near;
using test::pi;
using test::screen;

constexpr glm::dvec2 middle{400, 300};

GizmoPart along(TransformKind kind, int axis) {
    return {kind, {Constraint::Kind::axis, axis, false}};
}
GizmoPart across(int axis) {
    return {TransformKind::translate, {Constraint::Kind::plane, axis, false}};
}

Camera oblique() {
    Camera camera = camera_from(Side::front, 7);
    orbit(camera, Orbiting::turntable, {-130, 110}, screen);
    return camera;
}

bool has(const std::vector<GizmoShape>& shapes, const GizmoPart& part) {
    return std::ranges::any_of(shapes, [&](const GizmoShape& shape) { return shape.part == part; });
}

// Of the screen, in sizes of the gizmo along its axes.
glm::dvec2 pixel_at(const Gizmo& gizmo, const Camera& camera, const glm::dvec3& place) {
    const double unit = gizmo.size * pixel_size_at(camera, screen, gizmo.center);
    return project(camera, screen, gizmo.center + unit * (gizmo.axes * place))->pixel;
}

TEST(Gizmo, HasConstantSizeOnTheScreen) {
    for (const double distance : {0.01, 5.0, 1e6})
        for (const bool orthographic : {false, true}) {
            Camera camera = camera_from(Side::front, distance);
            camera.orthographic = orthographic;
            double longest = 0;
            for (const GizmoShape& shape : gizmo_shapes({}, camera, screen))
                if (shape.part == along(TransformKind::translate, 0))
                    for (const glm::dvec2& p : shape.outline)
                        longest = std::max(longest, glm::length(p - middle));
            EXPECT_NEAR(longest, 90, 1e-6);
        }
}

TEST(Gizmo, EveryPartIsUnderTheCursorWhereItIsDrawn) {
    Gizmo gizmo;
    gizmo.center = {0.2, -0.3, 0.4};
    // Planes and rings may be covered by a nearer part, but not from everywhere.
    std::array<int, 3> planes{};
    std::array<int, 3> rings{};
    for (const bool orthographic : {false, true})
        for (const double turn : {-60.0, -130.0, -200.0, 330.0}) {
            Camera camera = camera_from(Side::front, 7);
            orbit(camera, Orbiting::turntable, {turn, 110}, screen);
            camera.orthographic = orthographic;
            const auto under = [&](glm::dvec2 pixel) {
                return gizmo_part_under(gizmo, camera, screen, pixel, {3, 3});
            };
            for (int i = 0; i < 3; ++i) {
                glm::dvec3 axis(0.0);
                axis[i] = 1;
                EXPECT_EQ(under(pixel_at(gizmo, camera, 0.95 * axis)), along(TransformKind::translate, i));
                EXPECT_EQ(under(pixel_at(gizmo, camera, 1.14 * axis)), along(TransformKind::scale, i));
                const auto slot = static_cast<std::size_t>(i);
                planes.at(slot) += under(pixel_at(gizmo, camera, 0.31 * (1.0 - axis))) == across(i);
                const glm::dvec3 diagonal = 0.7 * std::sqrt(0.5) * (1.0 - axis);
                rings.at(slot) +=
                    under(pixel_at(gizmo, camera, diagonal)) == along(TransformKind::rotate, i) ||
                    under(pixel_at(gizmo, camera, -diagonal)) == along(TransformKind::rotate, i);
            }
            const glm::dvec2 center = project(camera, screen, gizmo.center)->pixel;
            EXPECT_EQ(under(center), (GizmoPart{TransformKind::translate, {}}));
            EXPECT_EQ(under(center + 117.0 * glm::dvec2(std::cos(0.3), std::sin(0.3))),
                      (GizmoPart{TransformKind::rotate, {}}));
            EXPECT_FALSE(under(center + glm::dvec2(135, 0)));
        }
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_GE(planes.at(i), 4) << "of 8 views";
        EXPECT_GE(rings.at(i), 4) << "of 8 views";
    }
}

TEST(Gizmo, LeavesOutWhatIsSeenEndOn) {
    const auto shapes = gizmo_shapes({}, camera_from(Side::front), screen);
    EXPECT_FALSE(has(shapes, along(TransformKind::translate, 1)));
    EXPECT_FALSE(has(shapes, along(TransformKind::scale, 1)));
    EXPECT_TRUE(has(shapes, along(TransformKind::translate, 0)));
    EXPECT_TRUE(has(shapes, along(TransformKind::translate, 2)));
    EXPECT_FALSE(has(shapes, across(0)));
    EXPECT_TRUE(has(shapes, across(1)));
    for (int i = 0; i < 3; ++i)
        EXPECT_TRUE(has(shapes, along(TransformKind::rotate, i))) << "a roller at least";
}

TEST(Gizmo, ShowsOnlyWhatIsAskedFor) {
    Gizmo gizmo;
    gizmo.translate = gizmo.rotate = false;
    std::set<TransformKind> kinds;
    for (const GizmoShape& shape : gizmo_shapes(gizmo, oblique(), screen)) kinds.insert(shape.part.kind);
    EXPECT_EQ(kinds, std::set{TransformKind::scale});
    EXPECT_EQ(gizmo_part_under(gizmo, oblique(), screen, middle), (GizmoPart{TransformKind::scale, {}}));
    gizmo.scale = false;
    EXPECT_TRUE(gizmo_shapes(gizmo, oblique(), screen).empty());
}

TEST(Gizmo, BehindTheEyeThereIsNone) {
    Gizmo gizmo;
    gizmo.center = {0, -9, 0};
    EXPECT_TRUE(gizmo_shapes(gizmo, camera_from(Side::front), screen).empty());
    EXPECT_FALSE(gizmo_part_under(gizmo, camera_from(Side::front), screen, middle));
}

TEST(Gizmo, RingsPartWhereTheyTurnAway) {
    const Camera camera = oblique();
    const Gizmo gizmo;
    for (int i = 0; i < 3; ++i) {
        double nearer = 0;
        double farther = 0;
        for (const GizmoShape& shape : gizmo_shapes(gizmo, camera, screen))
            if (shape.part == along(TransformKind::rotate, i))
                (shape.behind ? farther : nearer) = shape.depth;
        EXPECT_GT(nearer, 0);
        EXPECT_GT(farther, nearer);
    }
}

TEST(Gizmo, RingsSeenAsLinesAreFaintForTheyLieOnArrows) {
    for (const GizmoShape& shape : gizmo_shapes({}, camera_from(Side::front), screen)) {
        const bool is_line =
            shape.part == along(TransformKind::rotate, 0) || shape.part == along(TransformKind::rotate, 2);
        EXPECT_EQ(shape.behind, is_line);
    }
}

TEST(Gizmo, ComesFarthestFirstWithRingsUnderArrows) {
    const auto shapes = gizmo_shapes({}, oblique(), screen);
    const auto is_ring = [](const GizmoShape& shape) { return shape.part.kind == TransformKind::rotate; };
    const auto rings_end = std::ranges::find_if_not(shapes, is_ring);
    EXPECT_TRUE(std::none_of(rings_end, shapes.end(), is_ring));
    EXPECT_TRUE(
        std::ranges::is_sorted(shapes.begin(), rings_end, std::ranges::greater(), &GizmoShape::depth));
    EXPECT_TRUE(std::ranges::is_sorted(rings_end, shapes.end(), std::ranges::greater(), &GizmoShape::depth));
    for (const GizmoShape& shape : shapes) EXPECT_GE(shape.outline.size(), 2U);
}

TEST(Gizmo, TurnsWithTheHandle) {
    Gizmo gizmo;
    gizmo.local = true;
    gizmo.axes = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)));
    const Camera camera = oblique();
    const auto part = gizmo_part_under(gizmo, camera, screen, pixel_at(gizmo, camera, {0, 0, 0.9}), {3, 3});
    EXPECT_EQ(part, (GizmoPart{TransformKind::translate, {Constraint::Kind::axis, 2, true}}));
}

} // namespace
} // namespace knead
