#include "view/middle_along.h"

#include "viewing.h"

#include <vector>

namespace knead::test {
namespace {

constexpr double spacing = 0.05;

void add(std::vector<float>& positions, double x, double y, double z) {
    for (const double c : {x, y, z}) positions.push_back(static_cast<float>(c));
}

// Limbs along z of radius 0.5, hollow or full, about (0, y, 0).
std::vector<float> limb(double y, bool full) {
    std::vector<float> positions;
    for (double z = -1; z <= 1; z += spacing)
        for (double radius = full ? 0.02 : 0.5; radius <= 0.5; radius += spacing)
            for (double angle = 0; angle < 2 * pi; angle += spacing / radius)
                add(positions, radius * std::cos(angle), y + radius * std::sin(angle), z);
    return positions;
}

std::optional<glm::dvec3> middle_at(const Camera& camera, const std::vector<float>& positions,
                                    glm::dvec3 seen, const std::vector<std::uint8_t>& hidden = {}) {
    Workers workers(2);
    const Ray ray = ray_through(camera, screen, project(camera, screen, seen)->pixel);
    return middle_along(ray, camera.orthographic, positions, hidden, spacing, workers);
}

TEST(MiddleAlong, IsInsideOfTheFirstLimb) {
    for (const bool full : {false, true}) {
        std::vector<float> positions = limb(0, full);
        const std::vector<float> behind = limb(3, full); // from the front one looks along y
        positions.insert(positions.end(), behind.begin(), behind.end());
        for (const bool orthographic : {false, true}) {
            Camera camera = camera_from(Side::front);
            camera.orthographic = orthographic;
            const auto middle = middle_at(camera, positions, {0, 0, 0});
            ASSERT_TRUE(middle);
            EXPECT_TRUE(near(*middle, {0, 0, 0}, spacing)) << full << orthographic;
            const auto aside = middle_at(camera, positions, {0.3, 0, 0.5});
            ASSERT_TRUE(aside);
            EXPECT_NEAR(aside->y, 0, spacing) << full << orthographic << " not the middle of the line";
            EXPECT_NEAR(aside->x, 0.3, 0.1 * spacing);
        }
    }
}

TEST(MiddleAlong, IsOnASheetAndNowhereBesideIt) {
    std::vector<float> positions;
    for (double x = -1; x <= 1; x += spacing)
        for (double z = -1; z <= 1; z += spacing) add(positions, x, z, z); // at a slant
    const Camera camera = camera_from(Side::front);
    const auto middle = middle_at(camera, positions, {0.2, 0.3, 0.3});
    ASSERT_TRUE(middle);
    EXPECT_TRUE(near(*middle, {0.2, 0.3, 0.3}, spacing));
    EXPECT_FALSE(middle_at(camera, positions, {1.5, 0, 0}));
    EXPECT_FALSE(middle_at(camera, {}, {0, 0, 0}));
}

TEST(MiddleAlong, HiddenPointsAndThoseBehindTheEyeDoNotCount) {
    std::vector<float> positions = limb(0, false);
    const std::size_t own = positions.size() / 3;
    for (const double y : {-2.0, -8.0}) { // in front, and behind the eye
        const std::vector<float> other = limb(y, false);
        positions.insert(positions.end(), other.begin(), other.end());
    }
    std::vector<std::uint8_t> hidden(positions.size() / 3, 0);
    std::fill(hidden.begin() + static_cast<std::ptrdiff_t>(own),
              hidden.begin() + static_cast<std::ptrdiff_t>(2 * own), std::uint8_t{1});
    const auto middle = middle_at(camera_from(Side::front), positions, {0, 0, 0}, hidden);
    ASSERT_TRUE(middle);
    EXPECT_TRUE(near(*middle, {0, 0, 0}, spacing));
}

} // namespace
} // namespace knead::test
