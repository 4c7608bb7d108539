// Documents: what each act means, and what is refused.

#include "edit/editing.h"

#include <cstring>

namespace knead {
namespace {

using namespace test;

Vec3d lifted(const Vec3d& p) {
    return p + Vec3d(0.5, 0, 0.25);
}
bool is_top(const Vec3d& p) {
    return p.z() >= 2;
}

// --- Who holds a point

const std::string cap_that_stays =
    R"({"op":"handle","name":"cap","role":"fixed","region":{"halfspace":{"point":[0,0,2.25],"normal":[0,0,1]}}})"
    "\n";

TEST(Document, GivesAPointToTheHandleThatWasDeclaredLast) {
    Desk cap_last(bar());
    cap_last.play(ends + cap_that_stays + drag(lift));
    EXPECT_EQ(farthest(
                  cap_last, [](const Vec3d& p) { return p.z() >= 2.25; }, stays),
              0);
    EXPECT_LT(farthest(
                  cap_last, [](const Vec3d& p) { return p.z() >= 2 && p.z() < 2.25; }, lifted),
              1e-6);

    Desk cap_first(bar());
    cap_first.play(foot + cap_that_stays + top + drag(lift));
    EXPECT_LT(farthest(cap_first, is_top, lifted), 1e-6);
}

// One scan twice over, and the upper end of either one a handle. Which of two points in one place comes first
// in the file says nothing.
TEST(Document, TwinsThatHandlesTookApartRestWhereTheirOwnHandleHasThem) {
    const std::vector<float> one = bar().positions;
    std::vector<float> both = one;
    both.insert(both.end(), one.begin(), one.end());
    const auto n = static_cast<Index>(one.size() / 3);
    const auto handle = [&](const std::string& name, const std::string& role, Index scan) {
        std::string points;
        for (Index i = 0; i < n; ++i)
            if (at(one, i).z() >= 2) points += (points.empty() ? "" : ",") + std::to_string(i + scan * n);
        return R"({"op":"handle","name":")" + name + R"(","role":")" + role + R"(","points":[)" + points +
               "]}\n";
    };
    const auto played = [&](Index stays, Index moves) {
        Desk desk(make_cloud(both));
        desk.play(foot + handle("stays", "fixed", stays) + handle("top", "moving", moves) +
                  drag(turn('y', 60)) + commit + drag(turn('x', 40)));
        return desk.shape();
    };
    const std::vector<float> shape = played(0, 1), swapped = played(1, 0);
    for (std::size_t i = 0; i < n; ++i) {
        EXPECT_EQ(at(shape, i), at(swapped, i + n)) << i;
        EXPECT_EQ(at(shape, i + n), at(swapped, i)) << i;
    }
}

TEST(Document, ANameGivenAgainReplacesTheHandleAndDeclaresItLast) {
    Desk desk(bar());
    std::string cap_that_moves = top;
    cap_that_moves.replace(cap_that_moves.find("[0,0,2]"), 7, "[0,0,2.25]");
    desk.play(ends + cap_that_moves);
    ASSERT_EQ(desk.document().handles().size(), 2U);
    EXPECT_EQ(desk.document().handles()[1].name, "top");
    desk.play(foot);
    EXPECT_EQ(desk.document().handles()[1].name, "foot");
    desk.play(drag(lift));
    EXPECT_LT(farthest(
                  desk, [](const Vec3d& p) { return p.z() >= 2.25; }, lifted),
              1e-6);
    EXPECT_GT(farthest(desk, is_top, lifted), 1e-3);
}

TEST(Document, AHandleThatIsDeclaredAgainOrRenamedKeepsTheNumberByWhichItCame) {
    const auto numbers = [](Desk& desk) {
        std::map<std::string, Index> came;
        for (const Handle& handle : desk.document().handles()) came[handle.name] = handle.came;
        return came;
    };
    Desk desk(bar());
    desk.play(ends + cap_that_stays + foot + R"({"op":"rename","handle":"top","to":"lid"})" + "\n");
    EXPECT_EQ(numbers(desk), (std::map<std::string, Index>{{"foot", 0}, {"lid", 1}, {"cap", 2}}));
    desk.play(R"({"op":"delete","handle":"lid"})" + std::string("\n") + top);
    EXPECT_EQ(numbers(desk), (std::map<std::string, Index>{{"foot", 0}, {"cap", 2}, {"top", 3}}));
    desk.play(R"({"op":"undo"})" + std::string("\n") + R"({"op":"undo"})" + "\n");
    EXPECT_EQ(numbers(desk), (std::map<std::string, Index>{{"foot", 0}, {"lid", 1}, {"cap", 2}}));
}

TEST(Document, AnotherColorAloneKeepsThePlaceOfAHandleAndItsPose) {
    const std::string bottom = R"({"op":"handle","name":"bottom","role":"fixed","points":[[0,9]])";
    Desk desk(bar());
    desk.play(bottom + "}\n" + ends + drag(lift));
    desk.play(bottom + R"(,"color":"#102030"})" + "\n");
    const auto& handles = desk.document().handles();
    ASSERT_EQ(handles.size(), 3U);
    EXPECT_EQ(handles[0].name, "bottom");
    EXPECT_EQ(handles[0].color, 0x102030U);
    EXPECT_TRUE(desk.document().is_posed());
    // Any other change is one of the handles.
    EXPECT_SAYS(refusal(desk, bottom + R"(,"color":"#102031","falloff":1})" + "\n"), "commit");
    EXPECT_SAYS(refusal(desk, bottom + R"(,"color":"#102030"})" + "\n"), "commit"); // none is another
    desk.play("{\"op\":\"undo\"}\n");
    EXPECT_FALSE(desk.document().handles()[0].color.has_value());
    EXPECT_TRUE(desk.document().is_posed());
}

TEST(Document, APivotIsToldWhileAPoseStandsAndGoesAlongThroughACommit) {
    const std::string lid = R"({"op":"handle","name":"top","role":"moving","points":[[90,99]])";
    Desk desk(bar());
    desk.play(R"({"op":"handle","name":"bottom","role":"fixed","points":[[0,9]]})"
              "\n" +
              lid + "}\n" + drag(R"({"translate":[0,0,0.5]})"));
    const auto pivot = [&] { return desk.document().handles()[1].pivot; };
    desk.play(lid + R"(,"pivot":[0.25,0,1]})" + "\n");
    EXPECT_TRUE(desk.document().is_posed());
    EXPECT_EQ(pivot(), Vec3d(0.25, 0, 1)) << "on the rest shape";
    desk.play(R"({"op":"rename","handle":"top","to":"lid"})"
              "\n"
              R"({"op":"commit"})"
              "\n");
    ASSERT_TRUE(pivot());
    EXPECT_LT((*pivot() - Vec3d(0.25, 0, 1.5)).norm(), 1e-12) << "that became another";
    // Of every act, with places as they were: handles, a drag, the pivot, a name, a commit.
    const auto moves = desk.document().pivot_moves();
    ASSERT_EQ(moves.size(), 6U);
    ASSERT_EQ(moves[3].size(), 1U);
    EXPECT_EQ(moves[3][0].handle, "top");
    EXPECT_FALSE(moves[3][0].before);
    const Vec3d there = Vec3d(0.25, 0, 1.5) - desk.document().cloud().origin;
    EXPECT_LT((*moves[3][0].after - there).norm(), 1e-12) << "where the pose had taken it";
    EXPECT_EQ(moves[4].size(), 2U) << "from one name to the other";
    EXPECT_TRUE(moves[5].empty()) << "a commit moves nothing";
    desk.play("{\"op\":\"undo\"}\n");
    EXPECT_EQ(pivot(), Vec3d(0.25, 0, 1));
    desk.play("{\"op\":\"undo\"}\n{\"op\":\"undo\"}\n");
    EXPECT_FALSE(pivot());
    EXPECT_TRUE(desk.document().is_posed());
    desk.play("{\"op\":\"redo\"}\n");
    EXPECT_EQ(pivot(), Vec3d(0.25, 0, 1));
}

std::string region_of_interest(const std::string& name, double from, double to) {
    return R"({"op":"handle","name":")" + name + R"(","role":"roi","region":{"box":{"min":[-9,-9,)" +
           std::to_string(from) + R"(],"max":[9,9,)" + std::to_string(to) + "]}}}\n";
}

TEST(Document, RegionsOfInterestUniteAndWhatIsOutsideKeepsItsBytes) {
    Desk desk(bar());
    desk.play(top + region_of_interest("a", 0, 1) + region_of_interest("b", 0.9, 2.1) + drag(lift) +
              settle(20));
    EXPECT_LT(farthest(desk, is_top, lifted), 1e-6); // a handle beats the region, though outside and earlier
    EXPECT_EQ(farthest(
                  desk, [](const Vec3d& p) { return p.z() < 0; }, stays),
              0);
    EXPECT_GT(farthest(
                  desk, [](const Vec3d& p) { return p.z() > 0 && p.z() < 0.9; }, stays),
              0);
    EXPECT_LT(desk.handle_error(), 1e-6);
}

TEST(Document, RefusesHandlesThatDoNotFitTheCloud) {
    Desk desk(bar());
    EXPECT_SAYS(refusal(desk, R"({"op":"handle","name":"a","role":"fixed","points":[[0,1500]]})"), "s:1: ");
    EXPECT_SAYS(refusal(desk, R"({"op":"handle","name":"a","role":"fixed","points":[1500]})"), "1500");
    EXPECT_SAYS(
        refusal(
            desk,
            R"({"op":"handle","name":"a","role":"roi","region":{"sphere":{"center":[9,9,9],"radius":1}}})"),
        "is empty");
    EXPECT_TRUE(desk.document().handles().empty());
    EXPECT_EQ(refusal(desk, R"({"op":"handle","name":"a","role":"fixed","points":[1499,[0,3],3,2]})"),
              "accepted");
    EXPECT_EQ(*desk.document().handles()[0].points, (std::vector<Index>{0, 1, 2, 3, 1499}));
}

TEST(Document, ResolvesARegionOnTheRestShapeOfItsLine) {
    Desk desk(bar());
    desk.play(ends + drag(R"({"translate":[0,0,3]})") + commit);
    const std::string high = R"({"op":"handle","name":"high","role":"moving","region":)"
                             R"({"halfspace":{"point":[0,0,4.9999],"normal":[0,0,1]}}})";
    desk.play(high);
    const std::size_t held = desk.document().handles()[2].points->size();
    EXPECT_EQ(held, desk.document().handles()[1].points->size()); // just the top, which is there now
    desk.play(undo + undo + undo + undo);                         // the handle, the commit, the drag, the top
    EXPECT_SAYS(refusal(desk, high), "is empty");
}

TEST(Document, PointsThatAreLeftForLaterAreThoseOfTheFrame) {
    if (list_devices().empty()) GTEST_SKIP() << "there is no OpenCL device";
    const auto own_memory = [](const std::string&, Workers& workers, unsigned threads) {
        return UpsamplerChoice{make_opencl_upsampler(0, workers, threads, {.memory = DeviceMemory::own}), {}};
    };
    Desk now(bar(), {}, 2, "", Document::Mode::real, own_memory);
    Desk later(bar(), {}, 2, "", Document::Mode::real, own_memory);
    SilentProgress silent;
    HandlePose pose;
    for (Desk* desk : {&now, &later}) {
        desk->play(ends);
        desk->document().begin_drag("top", {0, 0, 2}, "", silent);
    }
    for (int frame = 1; frame <= 3; ++frame) {
        pose.translate = {0.1 * frame, 0, 0.2};
        now.document().drag_frame(pose, "", silent);
        later.document().drag_frame(pose, "", silent, Document::Points::later);
        EXPECT_EQ(now.document().drawn_frame(), nullptr);
        EXPECT_NE(later.document().drawn_frame(), nullptr);
        if (frame == 2) {
            EXPECT_EQ(later.document().shown(silent).positions, now.document().shown(silent).positions);
            EXPECT_EQ(later.document().drawn_frame(), nullptr) << "the points are there";
        }
    }
    for (Desk* desk : {&now, &later}) desk->document().end_drag();
    EXPECT_EQ(later.document().drawn_frame(), nullptr);
    EXPECT_EQ(later.shape(), now.shape());
    EXPECT_NE(later.shape(), bar().positions);
}

// --- Refusals

TEST(Document, RefusesToDragWhatIsNoMovingHandle) {
    Desk desk(bar());
    EXPECT_SAYS(refusal(desk, drag(lift)), "declare one first");
    desk.play(ends + region_of_interest("around", -3, 3));
    const std::string words = refusal(desk, drag(lift, "ear"));
    EXPECT_SAYS(words, "s:1: \"handle\": there is no handle \"ear\" here");
    for (const char* name : {"\"foot\"", "\"top\"", "\"around\""}) EXPECT_SAYS(words, name);
    EXPECT_SAYS(refusal(desk, drag(lift, "foot")), "not a moving handle");
    EXPECT_SAYS(refusal(desk, drag(lift, "around")), "not a moving handle");
    EXPECT_FALSE(desk.document().is_posed());
}

TEST(Document, WhilePosedRefusesWhatNeedsACommit) {
    Desk desk(bar());
    desk.play(ends + drag(lift));
    const std::vector<float> before = desk.shape();
    const std::string commands[] = {foot,
                                    R"({"op":"delete","handle":"foot"})",
                                    set(R"("samples":100)"),
                                    set(R"("neighbors":8)"),
                                    set(R"("strays":"freeze")"),
                                    set(R"("iterations":5,"samples":"all")")};
    for (const std::string& line : commands) EXPECT_SAYS(refusal(desk, line), R"({"op":"commit"})");
    EXPECT_TRUE(same_bits(desk.shape(), before));
    EXPECT_EQ(desk.document().settings(), Settings{});
    for (const std::string& line :
         {set(R"("iterations":5)"), set(R"("stiffness":0.1)"), set(R"("weights":"paper")"),
          std::string(R"({"op":"rename","handle":"top","to":"hat"})")})
        EXPECT_EQ(refusal(desk, line), "accepted");
    desk.play(commit);
    for (const std::string& line : commands) EXPECT_EQ(refusal(desk, line), "accepted");
}

TEST(Document, KnowsWhatNeedsACommit) {
    Desk desk(bar());
    SetLine strays, stiffness;
    strays.change.strays = Strays::carry;
    stiffness.change.stiffness = 0.1;
    desk.play(ends);
    EXPECT_FALSE(desk.document().needs_commit(strays));
    desk.play(drag(lift));
    EXPECT_TRUE(desk.document().needs_commit(strays));
    EXPECT_FALSE(desk.document().needs_commit(stiffness));
}

TEST(Document, RenamesAndDeletes) {
    Desk desk(bar());
    desk.play(ends + R"({"op":"rename","handle":"top","to":"hat"})");
    EXPECT_SAYS(refusal(desk, drag(lift)), "no handle \"top\"");
    desk.play(drag(lift, "hat"));
    desk.play(R"({"op":"rename","handle":"hat","to":"hat"})");
    EXPECT_SAYS(refusal(desk, R"({"op":"rename","handle":"hat","to":"foot"})"), "already");
    EXPECT_SAYS(refusal(desk, R"({"op":"rename","handle":"top","to":"a"})"), "no handle");
    EXPECT_SAYS(refusal(desk, R"({"op":"delete","handle":"top"})"), "no handle");
    desk.play(commit + R"({"op":"delete","handle":"foot"})");
    ASSERT_EQ(desk.document().handles().size(), 1U);
    EXPECT_EQ(desk.document().handles()[0].name, "hat");
}

TEST(Document, RefusesPosesOfAbsurdSize) {
    for (const char* frame : {R"({"translate":[1e300,0,0]})", R"({"scale":1e200})", R"({"scale":1e15})",
                              R"({"translate":[0,1e14,0]})"}) {
        Desk desk(bar());
        desk.play(ends);
        EXPECT_SAYS(refusal(desk, drag(std::string("{},") + frame)), "frame 1 (from 0)");
        EXPECT_FALSE(desk.document().is_posed());
    }
    Desk desk(bar());
    desk.play(ends + drag(R"({"translate":[0,0,1e6]})") + settle(5)); // far, but not absurd
    EXPECT_TRUE(all_finite(desk.shape()));
}

TEST(Document, RefusesScalesBeyondWhatFloatsHold) {
    std::vector<float> positions = bar().positions;
    for (float& coordinate : positions) coordinate *= 1e25F;
    Desk desk(make_cloud(positions));
    desk.play(R"({"op":"handle","name":"top","role":"moving","region":"all"})");
    EXPECT_EQ(refusal(desk, drag(R"({"scale":1e3})")), "accepted");
    EXPECT_SAYS(refusal(desk, drag(R"({"scale":1e6})")), "frame 0 (from 0)");
}

// --- Poses

TEST(Document, ASecondDragReplacesThePose) {
    Desk desk(bar());
    desk.play(ends + drag(turn('y', 80)) + drag(lift));
    EXPECT_LT(farthest(desk, is_top, lifted), 1e-6);
    EXPECT_EQ(farthest(
                  desk, [](const Vec3d& p) { return p.z() <= -2; }, stays),
              0);
}

TEST(Document, SeveralHandlesKeepTheirPosesThroughTheEdit) {
    Desk desk(bar());
    std::string moving_foot = foot;
    moving_foot.replace(moving_foot.find("fixed"), 5, "moving");
    desk.play(moving_foot + top + drag(lift, "foot") + drag(R"({"translate":[-0.25,0,0]})"));
    EXPECT_LT(farthest(
                  desk, [](const Vec3d& p) { return p.z() <= -2; }, lifted),
              1e-6);
    EXPECT_LT(farthest(desk, is_top, [](const Vec3d& p) { return Vec3d(p - Vec3d(0.25, 0, 0)); }), 1e-6);
    EXPECT_LT(desk.handle_error(), 1e-6);
}

TEST(Document, NoMotionChangesNoBit) {
    for (const std::uint64_t samples : {60U, 300U, 1000U}) {
        Settings settings;
        settings.samples = samples;
        Desk desk(bar(), settings);
        desk.play(ends + drag(R"({},{"rotate":[1,0,0,0]},{"rotate":[-2,0,0,0]},{"scale":1})") + settle(30));
        EXPECT_TRUE(same_bits(desk.shape(), desk.document().cloud().positions)) << samples;
        EXPECT_TRUE(same_bits(desk.normals(), read_normals(desk.document().cloud()))) << samples;
        desk.play(commit + drag("{}"));
        EXPECT_TRUE(same_bits(desk.shape(), desk.document().cloud().positions)) << samples;
    }
}

// A plane has zeros in its file, which the smallest rounding error would show in.
TEST(Document, NoMotionLeavesZerosZero) {
    Desk desk(made(Shape::plane, 900));
    desk.play(
        R"({"op":"handle","name":"a","role":"fixed","region":{"halfspace":{"point":[0.2,0,0],"normal":[-1,0,0]}}}
{"op":"handle","name":"top","role":"moving","region":{"halfspace":{"point":[0.8,0,0],"normal":[1,0,0]}}}
)" + drag("{},{}") +
        settle(10));
    EXPECT_TRUE(same_bits(desk.shape(), desk.document().cloud().positions));
    EXPECT_TRUE(same_bits(desk.normals(), read_normals(desk.document().cloud())));
}

TEST(Document, OneMotionOfAllHandlesMovesEveryPointByIt) {
    Desk desk(bar());
    std::string moving_foot = foot;
    moving_foot.replace(moving_foot.find("fixed"), 5, "moving");
    const std::string motion = turn('y', 30, "[0.1,0,0]") + "," + turn('y', 70, "[1,-2,0.5]");
    desk.play(moving_foot + top + drag(motion, "foot") + drag(motion) + settle(200));
    const Eigen::AngleAxisd rotation(70 * std::numbers::pi / 180, Vec3d::UnitY());
    const Vec3d origin = desk.document().cloud().origin;
    const auto target = [&](const Vec3d& p) -> Vec3d {
        const Vec3d pivot(0, 0, 2.5);
        return pivot + rotation * (p + origin - pivot) + Vec3d(1, -2, 0.5) - origin;
    };
    EXPECT_LT(farthest(desk, every, target), 1e-5 * desk.diagonal());
}

TEST(Document, SettlesUntilNothingMoves) {
    Desk desk(bar());
    desk.play(ends + drag(turn('y', 90, "[1,0,0]")) + settle(5000));
    const std::size_t iterations = desk.document().log().iteration.size();
    EXPECT_LT(iterations, 4000U); // it stopped by itself
    const std::vector<float> before = desk.shape();
    desk.play(settle(50));
    EXPECT_LT(farthest(desk, every,
                       [&, i = std::size_t{0}](const Vec3d&) mutable -> Vec3d { return at(before, i++); }),
              1e-5 * desk.diagonal());
    EXPECT_LT(desk.handle_error(), 1e-5);
}

TEST(Document, SettlingWithNoPoseIsAnActThatChangesNothing) {
    Desk desk(bar());
    desk.play(ends + settle(10));
    EXPECT_FALSE(desk.document().is_posed());
    EXPECT_TRUE(same_bits(desk.shape(), desk.document().cloud().positions));
    desk.play(undo);
    EXPECT_EQ(desk.document().handles().size(), 2U);
}

TEST(Document, TurnsNormalsWithTheirHandle) {
    Desk desk(bar());
    desk.play(ends + drag(turn('y', 90)));
    const std::vector<float> rest = read_normals(desk.document().cloud());
    const std::vector<float> normals = desk.normals();
    const Eigen::AngleAxisd rotation(std::numbers::pi / 2, Vec3d::UnitY());
    for (std::size_t i = 0; i < desk.document().cloud().size(); ++i) {
        EXPECT_NEAR(at(normals, i).norm(), 1, 1e-5);
        if (!is_top(at(desk.document().cloud().positions, i))) continue;
        EXPECT_LT((at(normals, i) - rotation * at(rest, i)).norm(), 1e-5);
    }
}

TEST(Document, ScalesAHandleEvenlyAndAlongAxes) {
    Desk desk(bar());
    desk.play(ends + drag(R"({"scale":1.5})"));
    const Vec3d pivot(0, 0, 2.5);
    EXPECT_LT(farthest(desk, is_top, [&](const Vec3d& p) -> Vec3d { return pivot + 1.5 * (p - pivot); }),
              1e-5);
    // Along axes that are turned by 90° about x, the second axis is z.
    desk.play(drag(R"({"scale":[1,2,1],"axes":[1,1,0,0],"translate":[0,0,1]})") + settle(50));
    const auto stretched = [](const Vec3d& p) { return Vec3d(p.x(), p.y(), 2.5 + 2 * (p.z() - 2.5) + 1); };
    EXPECT_LT(farthest(desk, is_top, stretched), 1e-5);
    EXPECT_LT(desk.handle_error(), 1e-5);
    EXPECT_TRUE(all_finite(desk.shape()));
}

// --- Commit

TEST(Document, CommitKeepsTheShapeAndTheHandlesAndRunsNoStage) {
    Desk desk(bar());
    desk.play(ends + drag(lift) + settle(10));
    const std::vector<float> before = desk.shape();
    const StageSeconds seconds = desk.pipeline().seconds();
    const std::size_t upsamplings = desk.document().log().upsample.size();
    desk.play(commit);
    EXPECT_TRUE(same_bits(desk.shape(), before));
    EXPECT_EQ(desk.document().handles().size(), 2U);
    EXPECT_FALSE(desk.document().is_posed());
    EXPECT_EQ(desk.handle_error(), 0);
    EXPECT_EQ(std::memcmp(&desk.pipeline().seconds(), &seconds, sizeof seconds), 0);
    EXPECT_EQ(desk.document().log().upsample.size(), upsamplings);

    desk.play(drag("{}")); // poses start anew from the shape that was committed
    EXPECT_TRUE(same_bits(desk.shape(), before));
    desk.play(drag(lift));
    EXPECT_LT(farthest(desk, is_top, [](const Vec3d& p) { return lifted(lifted(p)); }), 1e-5);
}

} // namespace
} // namespace knead
