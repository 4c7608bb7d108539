// Point handles, falloffs and free rotations on whole clouds.

#include "edit/editing.h"
#include "edit/seams.h"

#include <functional>
#include <initializer_list>

namespace knead {
namespace {

using namespace knead::test;

// How far the plane rises at this distance from its middle, over how far the handle there was lifted.
struct Profile {
    std::vector<float> shape, rest;
    Vec3d middle; // of the handle, about the cloud's origin as they are

    double at_distance(double distance) const {
        double sum = 0;
        std::size_t count = 0;
        for (std::size_t i = 0; i < rest.size(); i += 3) {
            const double way = std::hypot(rest[i] - middle.x(), rest[i + 1] - middle.y());
            if (std::abs(way - distance) > 0.01) continue;
            sum += shape[i + 2] - rest[i + 2];
            ++count;
        }
        return sum / static_cast<double>(count) / 0.2;
    }
};

Profile lifted(std::uint64_t samples, const std::string& keys, const std::string& radius) {
    Settings settings;
    settings.samples = samples;
    Desk desk(made(Shape::plane, 20'000), settings);
    desk.play(
        R"({"op":"handle","name":"around","role":"roi","region":{"sphere":{"center":[0.5,0.5,0],"radius":0.4}}})"
        "\n"
        R"({"op":"handle","name":"top","role":"moving","region":{"sphere":{"center":[0.5,0.5,0],"radius":)" +
        radius + "}}" + keys + "}\n" + drag(R"({"translate":[0,0,0.2]})") + settle(100));
    EXPECT_LT(desk.handle_error(), 1e-6);
    const PointCloud& cloud = desk.document().cloud();
    return {desk.shape(), cloud.positions, Vec3d(0.5, 0.5, 0) - cloud.origin};
}

// Frames of a drag that turns about an axis, a step more each, up to `last`; degrees.
std::string turns(char axis, int step, int last) {
    std::string frames;
    for (int degrees = step; degrees <= last; degrees += step)
        frames += (frames.empty() ? "" : ",") + turn(axis, degrees);
    return frames;
}

// Of two shapes of one cloud.
double rms_between(const std::vector<float>& a, const std::vector<float>& b) {
    double square = 0;
    for (std::size_t i = 0; i < a.size(); ++i) square += std::pow(double{a[i]} - double{b[i]}, 2);
    return std::sqrt(3 * square / static_cast<double>(a.size()));
}

// What `pose` makes of a shape is, with fewer samples, within so much of the diagonal (RMS) of
// what it makes of it with the first number of them.
void expect_alike(Shape shape, std::size_t points, std::initializer_list<std::uint64_t> samples, double most,
                  const std::function<void(Desk&)>& pose) {
    std::vector<float> with_most;
    for (const std::uint64_t count : samples) {
        Settings settings;
        settings.samples = count;
        Desk desk(made(shape, points), settings);
        pose(desk);
        const std::vector<float> posed = desk.shape();
        if (with_most.empty()) with_most = posed;
        EXPECT_LT(rms_between(posed, with_most) / desk.diagonal(), most) << count << " samples";
    }
}

TEST(HandleKinds, ASinglePointDrawsNoSpike) {
    const Profile coarse = lifted(300, "", "0.006");
    const Profile fine = lifted(3000, "", "0.006");
    // A spike would have lost most of its height here, the more the more samples there are.
    EXPECT_GT(fine.at_distance(0.03), 0.8);
    EXPECT_NEAR(fine.at_distance(0.03), coarse.at_distance(0.03), 0.1);
    EXPECT_NEAR(fine.at_distance(0.15), coarse.at_distance(0.15), 0.05);
}

// One edge of the plane.
const std::string edge = R"({"op":"handle","name":"edge","role":"fixed",)"
                         R"("region":{"box":{"min":[-1,-1,-1],"max":[0.05,2,1]}}})"
                         "\n";

// A point that says how it turns turns what is around it, and not by chance the less the more samples there
// are: a turn that is given at one place is as good as nowhere given.
TEST(HandleKinds, ThePointsTurnCountsAlikeWithAnyNumberOfSamples) {
    expect_alike(Shape::plane, 20'000, {5000, 2000, 500}, 0.004, [](Desk& desk) {
        desk.play(edge +
                  R"({"op":"handle","name":"top","role":"moving",)"
                  R"("region":{"sphere":{"center":[0.5,0.5,0],"radius":0.006}}})"
                  "\n"
                  R"({"op":"drag","handle":"top","pivot":[0.5,0.5,0],"frames":[)" +
                  turns('y', 15, 60) + "]}\n" + settle(200));
        // The free edge goes along.
        const Vec3d middle = desk.document().cloud().origin;
        EXPECT_GT(farthest(
                      desk, [&](const Vec3d& p) { return (p + middle).x() > 0.95; }, stays),
                  0.2);
    });
}

// Several points far apart are as many single points, and so is one beside a large part of the same handle.
TEST(HandleKinds, PointsOfOneHandleDrawNoSpikesEither) {
    const auto lifted_by = [](const std::string& region) {
        Settings settings;
        settings.samples = 3000;
        Desk desk(made(Shape::plane, 20'000), settings);
        desk.play(edge + R"({"op":"handle","name":"top","role":"moving",)" + region + "}\n" +
                  drag(R"({"translate":[0,0,0.2]})") + settle(100));
        const PointCloud& cloud = desk.document().cloud();
        return Profile{desk.shape(), cloud.positions, Vec3d(0.75, 0.5, 0) - cloud.origin}.at_distance(0.03);
    };
    const auto nearest = [](double x, double y) {
        const PointCloud plane = made(Shape::plane, 20'000);
        Index best = 0;
        const auto way = [&](Index i) { return (plane.file_position(i) - Vec3d(x, y, 0)).norm(); };
        for (Index i = 0; i < plane.size(); ++i)
            if (way(i) < way(best)) best = i;
        return std::to_string(best);
    };
    const std::string point = nearest(0.75, 0.5);
    const double alone = lifted_by(R"("points":[)" + point + "]");
    const double with_others =
        lifted_by(R"("points":[)" + point + "," + nearest(0.3, 0.2) + "," + nearest(0.3, 0.8) + "]");
    EXPECT_GT(alone, 0.8);
    EXPECT_GT(with_others, alone - 0.02);
}

// Nor does a line at its ends, which a surface cannot carry either.
TEST(HandleKinds, ALineDrawsNoSpikesAtItsEnds) {
    for (const std::uint64_t samples : {1000U, 5000U}) {
        Settings settings;
        settings.samples = samples;
        Desk desk(made(Shape::plane, 20'000), settings);
        desk.play(edge +
                  R"({"op":"handle","name":"line","role":"moving",)"
                  R"("region":{"box":{"min":[0.49,0.3,-1],"max":[0.51,0.7,1]}}})"
                  "\n"
                  R"({"op":"drag","handle":"line","pivot":[0.5,0.5,0],"frames":[)" +
                  turns('x', 10, 40) + "]}\n" + settle(200));
        EXPECT_LT(widest_seam(desk), samples == 1000 ? 0.16 : 0.11) << samples;
    }
}

TEST(HandleKinds, AFalloffCarriesWhatIsAroundAndEndsThere) {
    const Profile without = lifted(1000, "", "0.1");
    const Profile with = lifted(1000, R"(,"falloff":0.15)", "0.1");
    EXPECT_GT(with.at_distance(0.14), without.at_distance(0.14) + 0.1);
    EXPECT_GT(with.at_distance(0.14), 0.85);
    EXPECT_LT(with.at_distance(0.38), 0.3); // it is the surface that falls off from there
}

TEST(HandleKinds, FreeRotationFollowsThePositionsOnly) {
    std::vector<std::vector<float>> shapes;
    for (const char* rotation : {"held", "free"}) {
        Desk desk(bar());
        desk.play(foot + R"({"op":"handle","name":"top","role":"moving","rotation":")" + rotation +
                  R"(","region":{"halfspace":{"point":[0,0,2],"normal":[0,0,1]}}})"
                  "\n" +
                  drag(turn('y', 60)) + settle(30));
        // The points of the handle take its pose in both cases.
        EXPECT_LT(desk.handle_error(), 1e-6);
        EXPECT_TRUE(all_finite(desk.shape()));
        shapes.push_back(desk.shape());
    }
    // And what is between them goes another way where the handle does not turn it.
    double apart = 0;
    for (std::size_t i = 0; i < shapes[0].size() / 3; ++i)
        apart = std::max(apart, (at(shapes[0], i) - at(shapes[1], i)).norm());
    EXPECT_GT(apart, 0.01);
}

// A sheet that hangs on four pegs of a point each, all of which go round one axis: nothing but the pegs'
// freedom to turn decides whether it swings as a board does.
TEST(HandleKinds, PegsLetTheSheetSwing) {
    Desk desk(made(Shape::plane, 2000), {});
    const auto peg = [](const std::string& name, const std::string& role, const std::string& place) {
        return R"({"op":"handle","rotation":"free","name":")" + name + R"(","role":")" + role +
               R"(","region":{"sphere":{"center":)" + place + R"(,"radius":0.015}}})" + "\n";
    };
    desk.play(peg("a", "moving", "[0.1,0.1,0]") + peg("b", "moving", "[0.1,0.9,0]") +
              peg("c", "moving", "[0.9,0.1,0]") + peg("d", "moving", "[0.9,0.9,0]"));
    for (const char* handle : {"a", "b", "c", "d"}) desk.play(drag(turn('y', 40), handle));
    desk.play(settle(300));
    const Vec3d pivot = Vec3d(0, 0, 2.5) - desk.document().cloud().origin;
    const Quatd swing(Eigen::AngleAxisd(40 * std::numbers::pi / 180, Vec3d::UnitY()));
    const auto swung = [&](const Vec3d& p) -> Vec3d { return pivot + swing * (p - pivot); };
    EXPECT_LT(farthest(desk, every, swung) / desk.diagonal(), 1e-4); // 2 % when the falloff held them level
    const std::vector<float> normals = desk.normals();               // those of the pegs' own points, too
    for (std::size_t i = 0; i < desk.document().cloud().size(); ++i)
        ASSERT_LT((at(normals, i) - swing * Vec3d::UnitZ()).norm(), 1e-3) << i;
}

// A peg of a point carries half of the sheet along. That turns as a whole: what the sample at the peg does
// alone goes by how far off its neighbours are, and with 200 of them put it 12 % off.
TEST(HandleKinds, WhatAPegCarriesAlongTurnsAlikeWithAnyNumberOfSamples) {
    expect_alike(Shape::plane, 4000, {4000, 1000, 200}, 2e-3, [](Desk& desk) {
        desk.play(
            R"({"op":"handle","name":"edge","role":"fixed","region":{"box":{"min":[-1,-1,-1],"max":[0.06,2,1]}}})"
            "\n"
            R"({"op":"handle","name":"peg","role":"moving","rotation":"free","falloff":0.6,)"
            R"("region":{"sphere":{"center":[0.95,0.5,0],"radius":0.015}}})"
            "\n" +
            drag(R"({"translate":[-0.1,0,0.15]},{"translate":[-0.2,0,0.3]})", "peg") + settle(1000));
        EXPECT_LT(desk.handle_error(), 1e-6);
    });
}

// A line across one side of a bar leaves rotation free, pulls what is around it, and goes round an axis
// through it.
TEST(HandleKinds, AFreeLineWithAFalloffTearsNothing) {
    expect_alike(Shape::bar, 6000, {6000, 1000, 300}, 4e-3, [](Desk& desk) {
        desk.play(foot +
                  R"({"op":"handle","name":"top","role":"moving","rotation":"free","falloff":0.6,)"
                  R"("region":{"box":{"min":[0.4999,-1,1.46],"max":[1,1,1.54]}}})"
                  "\n"
                  R"({"op":"drag","handle":"top","pivot":[0.5,0,1.5],"frames":[)" +
                  turns('x', 4, 40) + "]}\n" + settle(1000));
        EXPECT_LT(widest_seam(desk), 0.5);
    });
}

// A cap of a sphere leaves rotation free and is turned sideways: at its border the surface turns as it wants,
// on each side in another way, however few samples tell so.
TEST(HandleKinds, AFreeAreaBendsAtItsBorderWithFewSamples) {
    expect_alike(Shape::sphere, 8000, {8000, 1000, 200}, 1.5e-3, [](Desk& desk) {
        const double lowest = bounds_of(desk.document().cloud()).lowest.z();
        const auto beyond = [&](double share, const char* side) { // of the diameter, from below
            const double z = lowest * (1 - 2 * share);
            return R"("region":{"halfspace":{"point":[0,0,)" + std::to_string(z) + R"(],"normal":[0,0,)" +
                   side + "]}}}\n";
        };
        desk.play(R"({"op":"handle","name":"rest","role":"fixed",)" + beyond(0.2, "-1") +
                  R"({"op":"handle","name":"top","role":"moving","rotation":"free",)" + beyond(0.75, "1") +
                  R"({"op":"drag","handle":"top","pivot":[0,0,0],"frames":[)" + turns('x', 5, 40) + "]}\n" +
                  settle(1000));
    });
}

// The point of a peg is not torn off what is around it, however few samples there are.
TEST(HandleKinds, AFreePointIsPartOfTheSurface) {
    for (const std::uint64_t samples : {60U, 100U, 300U}) {
        Settings settings;
        settings.samples = samples;
        Desk desk(made(Shape::sphere, 10'000), settings);
        const PointCloud& cloud = desk.document().cloud();
        std::size_t tip = 0;
        for (std::size_t i = 0; i < cloud.size(); ++i)
            if (cloud.positions[3 * i + 2] > cloud.positions[3 * tip + 2]) tip = i;
        desk.play(R"({"op":"handle","name":"rest","role":"fixed","region":{"halfspace":{"point":[0,0,0],)"
                  R"("normal":[0,0,-1]}}})"
                  "\n"
                  R"({"op":"handle","name":"top","role":"moving","rotation":"free","points":[)" +
                  std::to_string(tip) + "]}\n" + drag(R"({"translate":[0.3,0,0.4]})") + settle(300));
        const std::vector<float> shape = desk.shape();
        double nearest = 1e9;
        for (std::size_t i = 0; i < cloud.size(); ++i)
            if (i != tip) nearest = std::min(nearest, (at(shape, i) - at(shape, tip)).norm());
        EXPECT_LT(nearest / desk.diagonal(), 0.029) << samples; // it was up to .04
    }
}

// A peg that also holds strips of other parts, which lie over its border: only its samples in the surface say
// how what it pulls there turns. (One in a strip may even have no link to anything.)
TEST(HandleKinds, AFreePegTurnsWithWhatItHoldsInThatPart) {
    constexpr double spacing = 1.0 / 150;
    const PointCloud sheet = made(Shape::plane, 22'500);
    std::vector<float> positions;
    std::string held;
    const auto add = [&](const Vec3d& place, bool is_held) {
        if (is_held) held += (held.empty() ? "" : ",") + std::to_string(positions.size() / 3);
        for (const double each : place) positions.push_back(static_cast<float>(each));
    };
    for (std::size_t i = 0; i < sheet.size(); ++i) {
        const Vec3d place = sheet.file_position(i);
        add(place, std::hypot(place.x() - 0.5, place.y() - 0.5) < 0.15);
    }
    for (int strip = 0; strip < 12; ++strip)
        for (int k = 0; k < 72; ++k) {
            const double angle = 0.3 + strip * std::numbers::pi / 6;
            const double r = 0.15 + (k / 4 - 3) * spacing, aside = (k % 4 - 1.5) * spacing;
            add({0.5 + r * std::cos(angle) - aside * std::sin(angle),
                 0.5 + r * std::sin(angle) + aside * std::cos(angle), 2.3 * spacing},
                k < 16);
        }
    for (const std::uint64_t samples : {400U, 700U}) {
        Settings settings;
        settings.samples = samples;
        Desk desk(make_cloud(positions), settings);
        desk.play(
            R"({"op":"handle","name":"edge","role":"fixed","region":{"box":{"min":[-1,-1,-1],)"
            R"("max":[0.03,2,1]}}})"
            "\n"
            R"({"op":"handle","name":"peg","role":"moving","rotation":"free","falloff":0.3,"points":[)" +
            held + "]}\n" + drag(R"({"translate":[0,0,0.1]})", "peg"));
        const SampleRest& rest = desk.pipeline().system().rest;
        Workers workers(1);
        const Components parts = find_components(rest.graph, workers);
        EXPECT_GT(parts.size.size(), 12U);
        std::size_t turners = 0;
        for (const SoftHold& hold : rest.pulled) {
            if (hold.turner == no_index) continue;
            EXPECT_EQ(parts.component[hold.turner], parts.component[hold.sample]) << samples;
            ++turners;
        }
        EXPECT_GT(turners, 50U);
    }
}

// A sheet that is folded over a line, which is many points wide between two samples on it.
TEST(HandleKinds, AFreeLineIsAHingeWithoutASeam) {
    for (const std::uint64_t samples : {60U, 200U, 1000U}) {
        double bowed[2] = {0, 0};
        for (const bool free : {false, true}) {
            Settings settings;
            settings.samples = samples;
            Desk desk(made(Shape::plane, 10'000), settings);
            const auto strip = [](const char* name, const char* keys, const char* from, const char* to) {
                return std::string(R"({"op":"handle","name":")") + name + R"(",)" + keys +
                       R"("region":{"box":{"min":[)" + from + R"(,-1,-1],"max":[)" + to + ",2,1]}}}\n";
            };
            desk.play(strip("left", R"("role":"fixed",)", "-1", "0.1") +
                      strip("line", free ? R"("role":"fixed","rotation":"free",)" : R"("role":"fixed",)",
                            "0.49", "0.51") +
                      strip("top", R"("role":"moving",)", "0.9", "2"));
            desk.play(R"({"op":"drag","handle":"top","pivot":[0.5,0.5,0],"frames":[)" + turns('y', 10, 80) +
                      "]}\n" + settle(200));
            EXPECT_LT(widest_seam(desk), 0.35) << samples; // of a free line with 60 samples it was 1.6
            // Settled, it stays as it is while the hand holds still.
            desk.play(settle(1000));
            const std::vector<float> settled = desk.shape();
            desk.play(R"({"op":"drag","handle":"top","pivot":[0.5,0.5,0],"frames":[)" + turn('y', 80) +
                      "]}\n");
            const std::vector<float> held = desk.shape();
            for (std::size_t i = 0; i < held.size(); ++i) ASSERT_NEAR(held[i], settled[i], 1e-5) << samples;
            const auto on_the_left = [&](const Vec3d& p) {
                return p.x() < 0.5 - desk.document().cloud().origin.x();
            };
            bowed[free] = farthest(desk, on_the_left, stays);
        }
        EXPECT_GT(bowed[true], 4 * bowed[false]) << samples; // the fold goes on beyond what leaves it free
    }
}

// The start of a frame alone: behind a hinge the bar turns along, by however many samples.
TEST(HandleKinds, ATurnPassesAFreeHandleAtAFramesStart) {
    std::vector<float> shapes[2];
    double diagonal = 0;
    for (const bool every : {false, true}) {
        Settings settings;
        settings.iterations = 0;
        settings.samples = every ? std::nullopt : std::optional<std::uint64_t>(200);
        Desk desk(made(Shape::bar, 8000), settings);
        desk.play(
            R"({"op":"handle","name":"f","role":"fixed","region":{"box":{"min":[-1,-1,-9],"max":[1,1,-2.2]}}})"
            "\n"
            R"({"op":"handle","name":"h","role":"fixed","rotation":"free",)"
            R"("region":{"box":{"min":[-1,-1,-0.4],"max":[1,1,0.4]}}})"
            "\n"
            R"({"op":"handle","name":"m","role":"moving","region":{"box":{"min":[-1,-1,2.2],"max":[1,1,9]}}})"
            "\n"
            R"({"op":"drag","handle":"m","pivot":[0,0,0],"frames":[)" +
            turns('z', 10, 90) + "]}\n");
        shapes[every] = desk.shape();
        diagonal = desk.document().bounds().diagonal();
    }
    EXPECT_LT(rms_between(shapes[0], shapes[1]) / diagonal, 0.005); // with the hinge in the way 0.015
}

// A free handle holds a strip of a sheet and all of a crumb above it but the twin of one of its points, which
// what the handle holds there takes along.
TEST(HandleKinds, AFreeHandleTakesAlongWhatIsInsideOfItInEveryPart) {
    std::vector<float> positions;
    const PointCloud sheet = made(Shape::plane, 10'000);
    const auto add = [&](const Vec3d& p) {
        for (int axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>(p[axis]));
    };
    for (std::size_t i = 0; i < sheet.size(); ++i) add(at(sheet.positions, i) + sheet.origin);
    std::string points;
    const auto hold = [&](std::size_t i) { points += (points.empty() ? "" : ",") + std::to_string(i); };
    for (std::size_t i = 0; i < sheet.size(); ++i)
        if (std::abs(at(positions, i).x() - 0.5) < 0.05) hold(i);
    const std::size_t crumb = sheet.size();
    for (int i = 0; i < 25; ++i) {
        hold(crumb + static_cast<std::size_t>(i));
        add({0.5 + 0.01 * (i % 5), 0.5 + 0.01 * (i / 5), 0.06});
    }
    add({0.52, 0.52, 0.06}); // in the middle of the crumb
    Settings settings;
    settings.samples = 40;
    Desk desk(make_cloud(positions), settings);
    desk.play(R"({"op":"handle","name":"top","role":"moving","rotation":"free","points":[)" + points +
              "]}\n" + drag(R"({"translate":[0,0,0.25]})") + settle(20));
    const std::vector<float> shape = desk.shape();
    const std::vector<float>& rest = desk.document().cloud().positions;
    for (const std::size_t i : {crumb + 12, crumb + 25})
        EXPECT_NEAR(shape[3 * i + 2] - rest[3 * i + 2], 0.25, 1e-5) << i - crumb;
}

TEST(HandleKinds, AFixedPegOfOnePointKeepsItsBits) {
    for (const std::uint64_t samples : {60U, 700U}) {
        Settings settings;
        settings.samples = samples;
        Desk desk(bar(), settings);
        const std::vector<float> rest = desk.shape();
        desk.play(R"({"op":"handle","name":"top","role":"moving","region":{"halfspace":{"point":[0,0,2],)"
                  R"("normal":[0,0,1]}}})"
                  "\n");
        std::vector<std::size_t> pegs;
        for (const std::size_t point : {7U, 101U, 250U, 333U}) {
            if (rest[3 * point + 2] > 1) continue;
            pegs.push_back(point);
            desk.play(R"({"op":"handle","name":"peg)" + std::to_string(point) +
                      R"(","role":"fixed","rotation":"free","points":[)" + std::to_string(point) + "]}\n");
        }
        desk.play(drag(turn('x', 25) + "," + turn('y', 35)) + settle(20));
        const std::vector<float> shape = desk.shape();
        ASSERT_FALSE(pegs.empty());
        for (const std::size_t point : pegs)
            for (std::size_t axis = 0; axis < 3; ++axis)
                EXPECT_EQ(shape[3 * point + axis], rest[3 * point + axis]) << point;
    }
}

// A place is one whether the file has it once or twice.
TEST(HandleKinds, APegOfTwinsTurnsWithItsSurroundings) {
    std::vector<std::vector<float>> shapes;
    for (const char* points : {"[1000]", "[1000,2000]"}) {
        std::vector<float> positions = made(Shape::plane, 2000).positions;
        const std::vector<float> twice(positions.begin() + 3000, positions.begin() + 3003);
        positions.insert(positions.end(), twice.begin(),
                         twice.end()); // point 2000 lies where point 1000 does
        Desk desk(make_cloud(positions));
        desk.play(R"({"op":"handle","name":"rim","role":"fixed","region":{"halfspace":{"point":[-0.4,0,0],)"
                  R"("normal":[-1,0,0]}}})"
                  "\n"
                  R"({"op":"handle","name":"peg","role":"moving","rotation":"free","points":)" +
                  std::string(points) + "}\n" + drag(turn('y', 90), "peg") + settle(5));
        shapes.push_back(desk.shape());
    }
    double apart = 0;
    for (std::size_t i = 0; i < shapes[0].size() / 3; ++i)
        apart = std::max(apart, (at(shapes[0], i) - at(shapes[1], i)).norm());
    EXPECT_LT(apart, 1e-6);
}

TEST(HandleKinds, APegLeavesWhatOthersHoldInItsPlace) {
    std::vector<float> positions = bar(700).positions;
    const std::vector<float> twice(positions.begin() + 21, positions.begin() + 24);
    positions.insert(positions.end(), twice.begin(), twice.end()); // point 700 lies where point 7 does
    Desk desk(make_cloud(positions));
    const std::vector<float> rest = desk.shape();
    desk.play(R"({"op":"handle","name":"held","role":"fixed","points":[7,8,9,10]})"
              "\n"
              R"({"op":"handle","name":"peg","role":"moving","rotation":"free","points":[700]})"
              "\n"
              R"({"op":"drag","handle":"peg","frames":[{"translate":[0,0.1,0]}]})"
              "\n" +
              settle(5));
    const std::vector<float> shape = desk.shape();
    EXPECT_EQ(at(shape, 7), at(rest, 7));
    EXPECT_NEAR((at(shape, 700) - at(rest, 700)).y(), 0.1, 1e-6);
    EXPECT_LT(desk.handle_error(), 1e-6);
}

} // namespace
} // namespace knead
