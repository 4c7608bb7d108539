// What becomes of parts that hold no handle: frozen, carried, bridged.

#include "edit/carried_parts.h"
#include "edit/editing.h"

#include <random>

namespace knead {
namespace {

using namespace test;

const std::string carry = set(R"("strays":"carry")");
const std::string bridge = set(R"("strays":"bridge")");

PointCloud with(const PointCloud& cloud, const std::vector<Vec3d>& more) {
    std::vector<float> positions;
    const auto add = [&](const Vec3d& p) {
        for (const double value : p) positions.push_back(static_cast<float>(value));
    };
    for (std::size_t i = 0; i < cloud.size(); ++i) add(cloud.file_position(i));
    for (const Vec3d& p : more) add(p);
    return make_cloud(positions);
}

// A ball of 300 points beside the bar.
std::vector<Vec3d> ball(const Vec3d& middle, double radius = 0.4) {
    const PointCloud sphere = made(Shape::sphere, 300);
    std::vector<Vec3d> points;
    for (std::size_t i = 0; i < sphere.size(); ++i)
        points.push_back(middle + radius * sphere.file_position(i));
    return points;
}

constexpr std::size_t bar_points = 1500;
PointCloud bar_and_ball(const Vec3d& middle) {
    return with(bar(bar_points), ball(middle));
}

// The ball's points, from first to last.
std::vector<Vec3d> ball_of(const std::vector<float>& positions) {
    std::vector<Vec3d> points;
    for (std::size_t i = bar_points; i < positions.size() / 3; ++i) points.push_back(at(positions, i));
    return points;
}

double largest_change_of_distance(const std::vector<Vec3d>& before, const std::vector<Vec3d>& after) {
    double largest = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            largest =
                std::max(largest, std::abs((before[i] - before[j]).norm() - (after[i] - after[j]).norm()));
    return largest;
}

// --- Parts that nothing holds back

// Of the ball, and of the bar's ends.
const std::string of_ball = R"({"op":"handle","name":"ball","role":"moving","region":{"sphere":)"
                            R"({"center":[1.2,0,0.8],"radius":0.2}}})"
                            "\n";
std::string drag_ball() {
    return drag(R"({"translate":[0.1,0,0]})", "ball");
}

TEST(LooseParts, AreThoseWithoutAnythingThatStays) {
    Desk desk(bar_and_ball({1.2, 0, 1.1}));
    desk.play(ends + of_ball + drag_ball() + drag(lift));
    EXPECT_NE(words_about_loose(desk.document(), "ball").find("nothing that stays"), std::string::npos);
    EXPECT_EQ(words_about_loose(desk.document(), "top"), "");
    EXPECT_EQ(words_about_loose(desk.document(), "nobody"), "");
}

TEST(LooseParts, AreNoneWhereTheyAreJoinedOrARegionEndsOnThem) {
    Desk joined(bar_and_ball({0.95, 0, 0.8}));
    joined.play(bridge + ends + R"({"op":"handle","name":"ball","role":"moving","region":{"sphere":)" +
                R"({"center":[1.3,0,0.8],"radius":0.2}}})" + "\n" + drag_ball());
    ASSERT_EQ(joined.pipeline().components().size.size(), 1U);
    EXPECT_EQ(words_about_loose(joined.document(), "ball"), "");
    Desk region(bar_and_ball({1.2, 0, 1.1}));
    region.play(ends + R"({"op":"handle","name":"some","role":"roi","region":{"sphere":)" +
                R"({"center":[1.2,0,0.9],"radius":0.35}}})" + "\n" + of_ball + drag_ball());
    EXPECT_EQ(words_about_loose(region.document(), "ball"), "");
}

TEST(LooseParts, AreNoneWhereNothingStaysAnywhere) {
    // Neither what a region that holds everything leaves out, nor a fixed handle of which others took all.
    Desk desk(made(Shape::bar, 700));
    desk.play(R"({"op":"handle","name":"some","role":"roi","region":"all"})"
              "\n"
              R"({"op":"handle","name":"gone","role":"fixed","points":[9]})"
              "\n"
              R"({"op":"handle","name":"top","role":"moving","points":[[0,99]]})"
              "\n" +
              drag(lift));
    EXPECT_EQ(words_about_loose(desk.document(), "top"), "");
}

// --- Carry

TEST(CarriedParts, MoveRigidlyWithWhatIsNearest) {
    for (const char* samples : {"200", "\"all\""}) {
        Desk desk(bar_and_ball({1.2, 0, 0.8}));
        desk.play(ends + carry + set(std::string(R"("samples":)") + samples) + drag(turn('y', 75)) +
                  settle(10));
        EXPECT_EQ(desk.pipeline().strays().parts, 1U);
        const std::vector<Vec3d> rest = ball_of(desk.document().cloud().positions);
        const std::vector<Vec3d> now = ball_of(desk.shape());
        EXPECT_LT(largest_change_of_distance(rest, now), 1e-6 * desk.diagonal());
        EXPECT_GT((rest[0] - now[0]).norm(), 0.1);
    }
}

TEST(CarriedParts, BesideAHandleDoWhatItDoes) {
    Desk desk(bar_and_ball({1.1, 0, 2.4}));
    desk.play(ends + carry + drag(turn('y', 60, "[0.5,0,0.25]")));
    const Vec3d pivot(0, 0, 2.5);
    const Mat3d turned = Eigen::AngleAxisd(std::numbers::pi / 3, Vec3d::UnitY()).toRotationMatrix();
    const std::vector<float> shape = desk.shape();
    for (std::size_t i = bar_points; i < desk.document().cloud().size(); ++i) {
        const Vec3d file = desk.document().cloud().file_position(i);
        const Vec3d expected = pivot + turned * (file - pivot) + Vec3d(0.5, 0, 0.25);
        EXPECT_LT((at(shape, i) + desk.document().cloud().origin - expected).norm(), 1e-5);
    }
}

TEST(CarriedParts, StayOverTheMiddleOfWhatIsScaledUnderThem) {
    CarriedParts parts;
    parts.first = {0, 1};
    parts.motion = {0};
    parts.weight = {1};
    parts.anchor = {Vec3d(100, 0, 0)};
    const Motion doubling{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
    const Motion motion = carried_motion(parts, 0, {&doubling, 1});
    const Motion shift{{0, 0, 0, 100, 0, 0, 0, 0, 0, 0, 0, 0}};
    for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(motion.map[i], shift.map[i], 1e-4F) << i;
}

TEST(CarriedParts, KeepEveryBitWhereNothingMoves) {
    Desk desk(bar_and_ball({1.2, 0, -2.2}));
    desk.play(ends + carry + drag(turn('y', 0)));
    EXPECT_TRUE(same_bits(desk.shape(), desk.document().cloud().positions));
    desk.play(drag(turn('y', 70)) + settle(5)); // beside the foot
    const std::vector<float> shape = desk.shape();
    EXPECT_EQ(ball_of(shape), ball_of(desk.document().cloud().positions));
}

TEST(CarriedParts, AreCommittedAndGoOnFromThere) {
    Desk desk(bar_and_ball({1.2, 0, 1}));
    desk.play(ends + carry + drag(turn('y', 50)) + settle(5));
    const std::vector<float> posed = desk.shape();
    desk.play(commit);
    EXPECT_TRUE(same_bits(desk.shape(), posed));
    desk.play(drag(turn('y', 50)) + settle(5));
    EXPECT_LT(largest_change_of_distance(ball_of(posed), ball_of(desk.shape())), 1e-6 * desk.diagonal());
    const std::vector<float> second = desk.shape();
    desk.play(undo + undo + undo);
    EXPECT_TRUE(same_bits(desk.shape(), posed));
    desk.play(redo + redo + redo);
    EXPECT_TRUE(same_bits(desk.shape(), second));
}

TEST(CarriedParts, DoNotDependOnTheWorkers) {
    std::vector<std::vector<float>> shapes;
    for (const unsigned threads : {1U, 3U}) {
        Desk desk(bar_and_ball({1.2, 0.3, 0.8}), {}, threads);
        shapes.push_back(desk.play(ends + carry + drag(turn('x', 75)) + settle(3)).shape());
    }
    EXPECT_TRUE(same_bits(shapes[0], shapes[1]));
}

// --- Bridge

PointCloud cut_bar(double half_gap) {
    const PointCloud whole = bar(6000);
    std::vector<Vec3d> left;
    for (std::size_t i = 0; i < whole.size(); ++i)
        if (std::abs(whole.file_position(i).z()) > half_gap) left.push_back(whole.file_position(i));
    return with(make_cloud(std::vector<float>{}), left);
}

// How far the two rims of the cut have come apart, over how far they were.
double gape(Desk& desk, double half_gap) {
    const PointCloud& cloud = desk.document().cloud();
    const std::vector<float> shape = desk.shape();
    Vec3d upper = Vec3d::Zero(), lower = Vec3d::Zero();
    double above = 0, below = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const double z = cloud.file_position(i).z();
        if (std::abs(z) > half_gap + 0.1) continue;
        (z > 0 ? upper : lower) += at(shape, i);
        (z > 0 ? above : below) += 1;
    }
    return (upper / above - lower / below).norm() / (2 * half_gap + 0.1);
}

TEST(Bridged, PartsBendAsOneBody) {
    for (const bool joined : {false, true}) {
        Desk desk(cut_bar(0.12)); // about four spacings
        desk.play(ends + (joined ? bridge : std::string()) + drag(turn('y', 60, "[1,0,0]")) + settle(30));
        EXPECT_EQ(desk.pipeline().components().size.size(), joined ? 1U : 2U);
        EXPECT_EQ(desk.pipeline().strays().parts, 0U);
        if (joined)
            EXPECT_LT(gape(desk, 0.12), 1.3);
        else
            EXPECT_GT(gape(desk, 0.12), 2.0);
    }
}

TEST(Bridged, WhatIsTooFarIsCarried) {
    Desk desk(bar_and_ball({3, 0, 0.8}));
    desk.play(ends + bridge + drag(turn('y', 75)) + settle(5));
    EXPECT_EQ(desk.pipeline().components().size.size(), 2U);
    EXPECT_EQ(desk.pipeline().strays().parts, 1U);
    EXPECT_SAYS(words_about(desk.pipeline().strays()), "too far");
    const std::vector<Vec3d> rest = ball_of(desk.document().cloud().positions);
    const std::vector<Vec3d> now = ball_of(desk.shape());
    EXPECT_LT(largest_change_of_distance(rest, now), 1e-6 * desk.diagonal());
    EXPECT_GT((rest[0] - now[0]).norm(), 0.1);
}

TEST(Bridged, CloudsThatHangTogetherDoAsBefore) {
    std::vector<std::vector<float>> shapes;
    for (const std::string& mode : {std::string(), carry, bridge})
        shapes.push_back(Desk(bar()).play(ends + mode + drag(turn('y', 75)) + settle(5)).shape());
    EXPECT_TRUE(same_bits(shapes[0], shapes[1]));
    EXPECT_TRUE(same_bits(shapes[0], shapes[2]));
}

// --- Outliers

const std::string freeze = set(R"("strays":"freeze")");
const std::vector<Vec3d> dust{{1.5, 0, 0}, {1.7, 0.2, -0.4}, {-1.6, 0, 1}, {1.9, 0, 2.2}};

std::size_t nearest_point(const PointCloud& cloud, const Vec3d& place) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < cloud.size(); ++i)
        if ((cloud.file_position(i) - place).norm() < (cloud.file_position(nearest) - place).norm())
            nearest = i;
    return nearest;
}

// Of the points of the bar, which strays may stand behind, in two shapes of it.
double farthest_apart(Desk& one, Desk& other, std::size_t points = bar_points) {
    const std::vector<float> expected = one.shape(), shape = other.shape();
    const Vec3d between = other.document().cloud().origin - one.document().cloud().origin;
    double farthest = 0;
    for (std::size_t i = 0; i < points; ++i)
        farthest = std::max(farthest, (at(shape, i) + between - at(expected, i)).norm());
    return farthest;
}

TEST(Outlier, HeldOrNotDragsNothing) {
    for (const std::string& mode : {freeze, carry, bridge})
        for (const char* samples : {"200", "\"all\""}) {
            Desk desk(with(bar(bar_points), dust));
            desk.play(foot + mode + set(std::string(R"("samples":)") + samples) +
                      R"({"op":"handle","name":"top","role":"moving","points":[1500,1501]})"
                      "\n" +
                      drag(lift) + settle(5));
            const std::vector<float> shape = desk.shape();
            const std::vector<float>& rest = desk.document().cloud().positions;
            EXPECT_TRUE(std::equal(rest.begin(), rest.begin() + 3 * bar_points, shape.begin()));
            EXPECT_LT(desk.handle_error(), 1e-6);
            EXPECT_EQ((at(shape, 1500) - at(rest, 1500)), Vec3d(0.5, 0, 0.25));
        }
}

TEST(Outlier, HangsOnTheSurfaceAndLeavesItsShape) {
    for (const std::string& mode : {freeze, carry, bridge}) {
        Desk clean(bar(bar_points)), dusty(with(bar(bar_points), dust));
        const std::string lines = mode + set(R"("samples":"all")") + ends + drag(turn('y', 70)) + settle(60);
        clean.play(lines);
        dusty.play(lines);
        EXPECT_LT(farthest_apart(clean, dusty), 0.01 * clean.diagonal());
        const std::vector<float> shape = dusty.shape();
        const std::vector<float>& rest = dusty.document().cloud().positions;
        EXPECT_GT((at(shape, 1503) - at(rest, 1503)).norm(), 0.5); // held by the top, beside it
    }
}

// Nor do few samples, which ask the points between them, take a stray's long link for a wide piece of
// surface.
TEST(Outlier, LeavesTheShapeOfFewSamples) {
    constexpr std::size_t points = 60'000, strays = 1200;
    std::mt19937 random(1);
    std::vector<Vec3d> around;
    for (std::size_t k = 0; k < strays; ++k) {
        const double turned = std::uniform_real_distribution(0.0, 2 * std::numbers::pi)(random);
        const double far = std::uniform_real_distribution(0.7, 2.0)(random);
        const double high = std::uniform_real_distribution(-1.8, 1.8)(random);
        around.emplace_back(far * std::cos(turned), far * std::sin(turned), high);
    }
    const PointCloud cloud = with(bar(points), around);
    Desk many(cloud), few(cloud);
    const std::string bend = ends + drag(turn('y', 70)) + settle(300);
    many.play(set(R"("samples":5000)") + bend);
    few.play(set(R"("samples":200)") + bend);
    EXPECT_LT(farthest_apart(many, few, points), 0.01 * many.diagonal()); // twice as far, otherwise
}

// A bar with a peg of one point in its side, and a stray beside that: swung by its end, about the peg.
TEST(Outlier, OfAPegThatLeavesRotationFreeDoesNotHoldItsTurn) {
    const PointCloud alone = bar(bar_points);
    const std::size_t peg = nearest_point(alone, {0.5, 0, 0});
    const std::string lines = set(R"("samples":"all")") +
                              R"({"op":"handle","name":"peg","role":"fixed","rotation":"free","points":[)" +
                              std::to_string(peg) + "]}\n" + top + drag(turn('y', 40)) + settle(300);
    Desk clean(alone), dusty(with(alone, {alone.file_position(peg) + Vec3d(3, 0, 0)}));
    clean.play(lines);
    dusty.play(lines);
    EXPECT_LT(farthest_apart(clean, dusty), 0.003 * clean.diagonal());
}

// What a falloff pulls at is the surface; the stray keeps its distance from it.
TEST(Outlier, InAFalloffGoesWithTheSurface) {
    const PointCloud alone = bar(bar_points);
    const std::size_t host = nearest_point(alone, {0.5, 0, 1});
    Desk desk(with(alone, {alone.file_position(host) + Vec3d(0.6, 0, 0)}));
    desk.play(foot + set(R"("samples":"all")") +
              R"({"op":"handle","name":"top","role":"moving","falloff":3,"region":{"halfspace":)"
              R"({"point":[0,0,2.2],"normal":[0,0,1]}}})"
              "\n" +
              drag(turn('y', 60)) + settle(100));
    const std::vector<float> shape = desk.shape();
    EXPECT_NEAR((at(shape, bar_points) - at(shape, host)).norm(), 0.6, 0.01);
}

} // namespace
} // namespace knead
