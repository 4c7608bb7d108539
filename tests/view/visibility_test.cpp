#include "shapes/shapes.h"
#include "view/screen_region.h"
#include "view/viewing.h"
#include "view/visibility.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace knead {
namespace {

using test::camera_from;
using test::pi;
using test::screen;

const ScreenBox everything{{-1e9, -1e9}, {1e9, 1e9}};

std::vector<float> shape(Shape which, std::size_t points) {
    Workers workers(2);
    SilentProgress progress;
    ShapeOptions options;
    options.points = points;
    return make_shape(which, options, workers, progress).positions;
}

// Points of no order at all: neighbours as near as chance has it.
std::vector<float> random_sphere(std::size_t points) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0, 1);
    std::vector<float> positions;
    for (std::size_t i = 0; i < points; ++i) {
        const double x = normal(random);
        const double y = normal(random);
        const glm::dvec3 p = glm::normalize(glm::dvec3(x, y, normal(random)));
        for (int c = 0; c < 3; ++c) positions.push_back(static_cast<float>(p[c]));
    }
    return positions;
}

std::vector<std::uint8_t> visible(const Camera& camera, const std::vector<float>& positions, double spacing,
                                  bool through = false) {
    Workers workers(2);
    std::vector<std::uint8_t> inside(positions.size() / 3);
    points_in_region(camera, screen, positions, {}, everything, inside, workers);
    if (through) return inside;
    const VisibleSurface surface = visible_surface(camera, screen, positions, {}, spacing, workers);
    keep_visible(camera, screen, positions, surface, inside, workers);
    return inside;
}

glm::dvec3 at(const std::vector<float>& positions, std::size_t i) {
    return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
}

TEST(Visible, OfASphereIsTheFrontHalf) {
    for (const bool orthographic : {false, true})
        for (const double distance : {5.0, 9.0, 40.0}) {
            Camera camera = camera_from(Side::front, distance);
            camera.orthographic = orthographic;
            orbit(camera, Orbiting::turntable, {211, 87}, screen);
            for (const auto& positions : {shape(Shape::sphere, 100000), random_sphere(100000)}) {
                const double spacing = std::sqrt(4 * pi / 100000);
                const std::vector<std::uint8_t> inside = visible(camera, positions, spacing);
                const glm::dvec3 eye = eye_of(camera);
                for (std::size_t i = 0; i < inside.size(); ++i) {
                    const glm::dvec3 p = at(positions, i);
                    const glm::dvec3 to_eye =
                        orthographic ? camera.orientation * glm::dvec3(0, 0, 1) : glm::normalize(eye - p);
                    // A cell is three spacings, or two pixels where that is more.
                    const double cell = std::max(3 * spacing, 2 * pixel_size_at(camera, screen, {0, 0, 0}));
                    // Distance on the screen from the silhouette, in the sphere's radius.
                    const double rim = 1 - std::sqrt(std::max(0.0, 1 - std::pow(glm::dot(to_eye, p), 2)));
                    if (rim < 1.5 * cell) continue;
                    ASSERT_EQ(inside[i] != 0, glm::dot(to_eye, p) > 0)
                        << "facing " << glm::dot(to_eye, p) << " from " << distance;
                }
                const std::vector<std::uint8_t> all = visible(camera, positions, spacing, true);
                EXPECT_EQ(std::ranges::count(all, 1), 100000);
            }
        }
}

TEST(Visible, OfATiltedPlaneIsAll) {
    std::mt19937 random(8);
    std::uniform_real_distribution<float> uniform(-0.5F, 0.5F);
    std::vector<float> scattered;
    for (int i = 0; i < 60000; ++i) {
        scattered.push_back(uniform(random));
        scattered.push_back(uniform(random));
        scattered.push_back(0);
    }
    const auto even = shape(Shape::plane, 60000);
    for (const bool orthographic : {false, true})
        for (const auto& positions : {even, scattered})
            for (const double tilt : {0.0, 20.0, 45.0, 60.0, 75.0, 80.0})
                for (const double turn : {0.0, 30.0, 45.0}) {
                    Camera camera = camera_from(Side::top, 3);
                    camera.orthographic = orthographic;
                    orbit(camera, Orbiting::turntable, {turn / 180 * 600, -tilt / 180 * 600}, screen);
                    const std::vector<std::uint8_t> inside =
                        visible(camera, positions, 1 / std::sqrt(60000.0));
                    // From 80° on the acute corners of a turned square are narrower than a cell.
                    EXPECT_GE(std::ranges::count(inside, 1), tilt < 80 ? 60000 : 59980)
                        << tilt << "°, turned " << turn << "°" << (orthographic ? ", orthographic" : "");
                }
}

TEST(Visible, HidesAWallBehindADisc) {
    // A disc of radius 0.5 at y = -1 before a wall at y = 0.
    std::vector<float> positions;
    std::mt19937 random(2);
    std::uniform_real_distribution<float> uniform(-1, 1);
    for (int i = 0; i < 100000; ++i) {
        const float x = uniform(random);
        const float z = uniform(random);
        const bool disc = x * x + z * z < 0.25F && i % 2 == 0;
        for (const float v : {x, disc ? -1.0F : 0.0F, z}) positions.push_back(v);
    }
    Camera camera = camera_from(Side::front, 6);
    camera.orthographic = true;
    const double spacing = std::sqrt(4 / 50000.0);
    const std::vector<std::uint8_t> inside = visible(camera, positions, spacing);
    for (std::size_t i = 0; i < inside.size(); ++i) {
        const glm::dvec3 p = at(positions, i);
        const double radius = std::hypot(p.x, p.z);
        if (p.y < -0.5) {
            ASSERT_TRUE(inside[i]);
        } else if (std::abs(radius - 0.5) > 2 * 3 * spacing) {
            ASSERT_EQ(inside[i] != 0, radius > 0.5) << radius;
        }
    }
}

TEST(Visible, IgnoresHiddenPointsAndThoseOutsideTheViewport) {
    const auto positions = shape(Shape::sphere, 20000);
    std::vector<std::uint8_t> hidden(20000);
    for (std::size_t i = 0; i < 20000; ++i) hidden[i] = positions[3 * i + 1] < 0 ? 1 : 0; // the front half
    Workers workers(2);
    const double spacing = std::sqrt(4 * pi / 20000);
    Camera camera = camera_from(Side::front, 6);
    std::vector<std::uint8_t> inside(20000);
    points_in_region(camera, screen, positions, hidden, everything, inside, workers);
    const auto shown = std::ranges::count(inside, 1);
    const VisibleSurface surface = visible_surface(camera, screen, positions, hidden, spacing, workers);
    keep_visible(camera, screen, positions, surface, inside, workers);
    EXPECT_EQ(std::ranges::count(inside, 1), shown) << "the back half is seen from inside";
    camera.pivot = {100, 0, 0};
    points_in_region(camera, screen, positions, {}, everything, inside, workers);
    keep_visible(camera, screen, positions, visible_surface(camera, screen, positions, {}, spacing, workers),
                 inside, workers);
    EXPECT_EQ(std::ranges::count(inside, 1), 0);
}

TEST(Visible, DoesNotDependOnTheThreads) {
    const auto positions = random_sphere(50000);
    const Camera camera = camera_from(Side::front, 6);
    Workers one(1);
    Workers three(3);
    const VisibleSurface a = visible_surface(camera, screen, positions, {}, 0.015, one);
    const VisibleSurface b = visible_surface(camera, screen, positions, {}, 0.015, three);
    EXPECT_EQ(a.depth, b.depth);
    EXPECT_EQ(a.limit, b.limit);
}

} // namespace
} // namespace knead
