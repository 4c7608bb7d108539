#include "view/screen_region.h"

#include "view/viewing.h"
#include "view/visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace knead {
namespace {

using test::camera_from;
using test::screen;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

std::vector<float> random_cloud(std::size_t count, double size = 2) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(static_cast<float>(-size), static_cast<float>(size));
    std::vector<float> positions(3 * count);
    for (float& p : positions) p = uniform(random);
    return positions;
}

std::vector<std::uint8_t> selected(const Camera& camera, const std::vector<float>& positions,
                                   const ScreenRegion& region, unsigned threads = 2) {
    Workers workers(threads);
    std::vector<std::uint8_t> inside(positions.size() / 3, 2);
    points_in_region(camera, screen, positions, {}, region, inside, workers);
    return inside;
}

std::vector<std::uint8_t> one_by_one(const Camera& camera, const std::vector<float>& positions,
                                     const ScreenRegion& region) {
    std::vector<std::uint8_t> inside;
    for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
        const auto seen = project(camera, screen, {positions[i], positions[i + 1], positions[i + 2]});
        inside.push_back(seen && contains(region, seen->pixel) ? 1 : 0);
    }
    return inside;
}

std::size_t count_of(const std::vector<std::uint8_t>& inside) {
    return static_cast<std::size_t>(std::ranges::count(inside, std::uint8_t{1}));
}

// A line that wanders over itself again and again.
std::vector<glm::dvec2> scribble(int corners, double step) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal(0, step);
    std::vector<glm::dvec2> line{{400, 300}};
    for (int i = 1; i < corners; ++i) {
        const double x = line.back().x + normal(random);
        line.emplace_back(x, line.back().y + normal(random));
    }
    return line;
}

const std::vector<glm::dvec2> pentagram{{400, 100}, {520, 470}, {205, 240}, {595, 240}, {280, 470}};

TEST(ScreenRegion, ABoxHoldsWhatLiesBetweenItsCorners) {
    const ScreenBox box{{30, 10}, {10, 20}};
    for (const glm::dvec2 in : {glm::dvec2(10, 10), {30, 20}, {20, 15}}) EXPECT_TRUE(contains(box, in));
    for (const glm::dvec2 out : {glm::dvec2(9.99, 15), {30.01, 15}, {20, 9.99}, {20, 20.01}, {nan, 15}})
        EXPECT_FALSE(contains(box, out));
}

TEST(ScreenRegion, APolygonGoesByTheEvenOddRule) {
    const ScreenPolygon star{pentagram};
    EXPECT_TRUE(contains(star, {400, 180}));
    EXPECT_TRUE(contains(star, {240, 250}));
    EXPECT_FALSE(contains(star, {400, 300})) << "the middle is enclosed twice";
    EXPECT_FALSE(contains(star, {100, 100}));
    EXPECT_FALSE(contains(ScreenPolygon{{{0, 0}, {9, 9}}}, {4, 4})) << "two corners enclose nothing";
    EXPECT_FALSE(contains(ScreenPolygon{}, {4, 4}));
    EXPECT_FALSE(contains(ScreenPolygon{{{0, 0}, {9, infinity}, {9, 0}}}, {4, 4}));
}

TEST(ScreenRegion, AStrokeIsAsWideAsItsBrush) {
    const ScreenStroke stroke{{{10, 10}, {30, 10}}, 5};
    EXPECT_TRUE(contains(stroke, {20, 15}));
    EXPECT_FALSE(contains(stroke, {20, 15.01}));
    EXPECT_TRUE(contains(stroke, {5, 10}));
    EXPECT_FALSE(contains(stroke, {6, 6}));
    EXPECT_TRUE(contains(ScreenStroke{{{10, 10}}, 5}, {13, 14}));
    EXPECT_FALSE(contains(ScreenStroke{{}, 5}, {0, 0}));
}

TEST(PointsInRegion, AreThoseWhosePixelsItContains) {
    const std::vector<float> positions = random_cloud(100000);
    const std::vector<ScreenRegion> regions{
        ScreenBox{{310, 205}, {590, 444}},
        ScreenPolygon{pentagram},
        ScreenPolygon{scribble(700, 12)},
        ScreenPolygon{{{100, 100}, {700, 100}, {700, 100.0001}, {100, 100.0001}}}, // a hair
        ScreenPolygon{{{200, 100}, {200, 500}, {600, 500}, {600, 100}}},           // along rows and columns
        ScreenPolygon{{{-1e9, -1e9}, {1e9, -1e9}, {500, 1e9}}},
        ScreenPolygon{{{300, 300}, {300, 300}, {300, 300}}},
        ScreenPolygon{},
        ScreenStroke{scribble(60, 20), 24},
        ScreenStroke{scribble(3, 200), 0.3},
        ScreenStroke{{{333, 222}}, 80},
        ScreenStroke{{}, 80}};
    for (const bool orthographic : {false, true})
        for (const double distance : {7.0, 1.0}) { // the second with points beside and behind the eye
            Camera camera = camera_from(Side::front, distance);
            orbit(camera, Orbiting::trackball, {70, 90}, screen);
            camera.orthographic = orthographic;
            for (std::size_t r = 0; r < regions.size(); ++r)
                EXPECT_TRUE(selected(camera, positions, regions[r]) ==
                            one_by_one(camera, positions, regions[r]))
                    << "region " << r << " from " << distance;
        }
    const Camera camera = camera_from(Side::front, 7);
    EXPECT_GT(count_of(selected(camera, positions, regions[1])), 5000U);
    EXPECT_GT(count_of(selected(camera, positions, regions[2])), 1000U);
    EXPECT_GT(count_of(selected(camera, positions, regions[8])), 1000U);
}

TEST(PointsInRegion, OfPixelsUponTheEdgesAreTheSame) {
    // Seen straight on with a pixel to a tenth, points lie exactly on corners, edges and their continuations.
    Camera camera = camera_from(Side::top);
    camera.orthographic = true;
    camera.distance = 0.05 * 600 / std::tan(0.3);
    std::vector<float> positions;
    for (int x = -200; x <= 200; ++x)
        for (int y = -150; y <= 150; ++y)
            for (const float v : {static_cast<float>(x) / 8, static_cast<float>(y) / 8, 0.0F})
                positions.push_back(v);
    const double scale = 1 / pixel_size_at(camera, screen, camera.pivot);
    const auto at = [&](double x, double y) { return glm::dvec2(400 + x * scale, 300 - y * scale); };
    for (const ScreenRegion& region :
         {ScreenRegion(ScreenPolygon{{at(-10, -10), at(10, -10), at(10, 10), at(-10, 10)}}),
          ScreenRegion(ScreenPolygon{{at(-10, -10), at(10, 10), at(10, -10), at(-10, 10)}}),
          ScreenRegion(ScreenStroke{{at(-10, 0), at(10, 0), at(10, 5)}, 2 * scale}),
          ScreenRegion(ScreenBox{at(-5, -5), at(5, 5)})})
        EXPECT_TRUE(selected(camera, positions, region) == one_by_one(camera, positions, region));
}

TEST(PointsInRegion, AreNeverBehindTheEye) {
    const Camera camera = camera_from(Side::front);
    const std::vector<float> positions{0, 0, 0, 0, -6, 0, 0, -5, 0};
    const std::vector<std::uint8_t> expected{1, 0, 0};
    EXPECT_EQ(selected(camera, positions, ScreenBox{{-1e9, -1e9}, {1e9, 1e9}}), expected);
    EXPECT_EQ(selected(camera, positions, ScreenPolygon{{{0, 0}, {800, 0}, {800, 600}, {0, 600}}}), expected);
    EXPECT_EQ(selected(camera, positions, ScreenStroke{{{400, 300}}, 900}), expected);
}

TEST(PointsInRegion, AreFiniteAndShown) {
    Camera camera = camera_from(Side::front);
    const std::vector<float> positions{0,   0,        0, nan, 0, 0,        0, nan, 0, 0, 0,
                                       nan, infinity, 0, 0,   0, infinity, 0, 0,   0, 0};
    const std::vector<std::uint8_t> hidden{0, 0, 0, 0, 0, 0, 1};
    const std::vector<std::uint8_t> expected{1, 0, 0, 0, 0, 0, 0};
    Workers workers(2);
    for (const bool orthographic : {false, true})
        for (const ScreenRegion& region :
             {ScreenRegion(ScreenBox{{-1e300, -1e300}, {1e300, 1e300}}),
              ScreenRegion(ScreenStroke{{{400, 300}}, 900}),
              ScreenRegion(ScreenPolygon{{{0, 0}, {800, 0}, {800, 600}, {0, 600}}})}) {
            camera.orthographic = orthographic;
            std::vector<std::uint8_t> inside(7, 2);
            points_in_region(camera, screen, positions, hidden, region, inside, workers);
            EXPECT_EQ(inside, expected);
        }
}

TEST(PointsInRegion, OfNothingAreNone) {
    EXPECT_TRUE(selected(camera_from(Side::front), {}, ScreenPolygon{pentagram}).empty());
    Workers workers(1);
    EXPECT_EQ(point_under(camera_from(Side::front), screen, {}, {}, {400, 300}, 10, workers), no_index);
    EXPECT_TRUE(visible_surface(camera_from(Side::front), screen, {}, {}, 0.1, workers).columns > 0);
}

TEST(PointUnder, IsTheNearestToTheEyeWithinTheRadius) {
    const Camera camera = camera_from(Side::front);
    Workers workers(2);
    std::vector<float> positions(3 * 50000, nan);
    const auto put = [&](std::size_t i, float x, float y, float z) {
        positions[3 * i] = x;
        positions[3 * i + 1] = y;
        positions[3 * i + 2] = z;
    };
    put(9, 0, 0, 0);
    put(20000, 0.01F, -1, 0); // nearer, 1.5 pixels aside
    put(40000, 0.01F, -1, 0); // the same again
    put(45000, 0.1F, -2, 0);  // nearer still, but 16 pixels aside
    put(49999, 0, -7, 0);     // behind the eye
    const auto under = [&](double radius, std::span<const std::uint8_t> hidden = {}) {
        return point_under(camera, screen, positions, hidden, {400, 300}, radius, workers);
    };
    EXPECT_EQ(under(6), 20000U);
    EXPECT_EQ(under(1), 9U);
    EXPECT_EQ(under(50), 45000U);
    std::vector<std::uint8_t> hidden(50000, 0);
    hidden[20000] = 1;
    EXPECT_EQ(under(6, hidden), 40000U);
    EXPECT_EQ(point_under(camera, screen, positions, {}, {10, 10}, 6, workers), no_index);
}

} // namespace
} // namespace knead
