// How the points of a cloud of Gaussian splats turn with the shape.

#include "edit/editing.h"
#include "edit/replay.h"
#include "io/cloud_file.h"
#include "support/scratch_folder.h"

namespace knead::test {
namespace {

// The bar, its points splats that all look the same way.
PointCloud splats(PointCloud cloud = bar()) {
    const std::vector<float> zero(cloud.size(), 0.0F);
    const std::vector<float> one(cloud.size(), 1.0F);
    for (const char* name : {"scale_0", "scale_1", "scale_2", "rot_1", "rot_2", "rot_3"})
        add_attribute(cloud, name, zero);
    add_attribute(cloud, "rot_0", one);
    return cloud;
}

const std::string all = R"({"op":"handle","name":"all","role":"moving","region":"all"})"
                        "\n";

std::vector<float> rotations(Desk& desk) {
    SilentProgress progress;
    return desk.document().rotations(progress);
}

Quatd turn_at(const std::vector<float>& rotations, std::size_t i) {
    const auto part = [&](std::size_t at) { return static_cast<double>(rotations[4 * i + at]); };
    return {part(0), part(1), part(2), part(3)};
}

Quatd about(const Vec3d& axis, double degrees) {
    return Quatd(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis));
}

double farthest_turn(const std::vector<float>& rotations, const Quatd& from) {
    double largest = 0;
    for (std::size_t i = 0; i < rotations.size() / 4; ++i)
        largest = std::max(largest, (turn_at(rotations, i).coeffs() - from.coeffs()).norm());
    return largest;
}

constexpr double rounding = 1e-6; // of four floats and a JSON number of six decimals

TEST(SplatTurns, AreTheHandlesWhereItHoldsAll) {
    Desk desk(splats());
    desk.play(all + drag(turn('x', 70), "all"));
    EXPECT_LT(farthest_turn(rotations(desk), about(Vec3d::UnitX(), 70)), rounding);
}

TEST(SplatTurns, AddUpThroughCommitsAndGoBackWithThem) {
    Desk desk(splats());
    EXPECT_TRUE(rotations(desk).empty());
    desk.play(all + drag(turn('x', 70), "all") + commit);
    const Quatd first = about(Vec3d::UnitX(), 70);
    EXPECT_LT(farthest_turn(rotations(desk), first), rounding);
    desk.play(drag(turn('z', 50), "all"));
    const Quatd both = about(Vec3d::UnitZ(), 50) * first;
    EXPECT_LT(farthest_turn(rotations(desk), both), rounding);
    desk.play(commit);
    EXPECT_LT(farthest_turn(rotations(desk), both), rounding);
    desk.play(undo + undo);
    EXPECT_LT(farthest_turn(rotations(desk), first), rounding);
    desk.play(undo + undo);
    EXPECT_TRUE(rotations(desk).empty());
    desk.play(redo + redo + redo + redo);
    EXPECT_LT(farthest_turn(rotations(desk), both), rounding);
}

TEST(SplatTurns, KeepWholeTurnsApart) {
    Desk desk(splats());
    desk.play(all + drag(turn('x', 100) + "," + turn('x', 200) + "," + turn('x', 300), "all"));
    EXPECT_LT(farthest_turn(rotations(desk), about(Vec3d::UnitX(), 300)), rounding) << "the sign goes on";
}

// The surface's own normals turn with the splats, where nothing is stretched much.
TEST(SplatTurns, FollowABentShape) {
    for (const char* samples : {"\"all\"", "150"}) {
        Desk desk(splats());
        desk.play(set(std::string("\"samples\":") + samples) + ends + drag(turn('x', 60)) + settle(100));
        const std::vector<float> turned = rotations(desk);
        const std::vector<float> normals = desk.normals();
        const std::vector<float> before = read_normals(desk.document().cloud());
        double square = 0;
        for (std::size_t i = 0; i < desk.document().cloud().size(); ++i) {
            const double height = at(desk.document().cloud().positions, i).z();
            const Quatd turn = turn_at(turned, i);
            EXPECT_NEAR(turn.norm(), 1, rounding);
            if (height < -2) {
                EXPECT_EQ(turn.coeffs(), Quatd::Identity().coeffs());
            }
            if (height > 2) {
                EXPECT_LT((turn.coeffs() - about(Vec3d::UnitX(), 60).coeffs()).norm(), rounding);
            }
            square += (turn * at(before, i) - at(normals, i)).squaredNorm();
        }
        const double rms = std::sqrt(square / static_cast<double>(desk.document().cloud().size()));
        EXPECT_LT(rms, 0.12) << samples;
    }
}

// Four pegs of one point each, which only go where half a right angle about y takes them; nothing tells them
// to turn.
TEST(SplatTurns, OfAPegAreThoseOfWhatItHolds) {
    Desk desk(splats(made(Shape::plane, 2000)), {});
    const PointCloud& cloud = desk.document().cloud();
    const Quatd swing = about(Vec3d::UnitY(), 45);
    std::string pegs, drags;
    for (const Vec3d& corner :
         {Vec3d(0.1, 0.1, 0), Vec3d(0.1, 0.9, 0), Vec3d(0.9, 0.1, 0), Vec3d(0.9, 0.9, 0)}) {
        std::size_t nearest = 0;
        for (std::size_t i = 0; i < cloud.size(); ++i)
            if ((cloud.file_position(i) - corner).norm() < (cloud.file_position(nearest) - corner).norm())
                nearest = i;
        const Vec3d way = swing * cloud.file_position(nearest) - cloud.file_position(nearest);
        const std::string point = std::to_string(nearest);
        pegs += R"({"op":"handle","rotation":"free","role":"moving","name":")" + point + R"(","points":[)" +
                point + "]}\n";
        drags += drag(R"({"translate":[)" + std::to_string(way.x()) + "," + std::to_string(way.y()) + "," +
                          std::to_string(way.z()) + "]}",
                      point);
    }
    desk.play(pegs + drags + settle(300));
    EXPECT_LT(farthest_turn(rotations(desk), swing), 1e-3); // settled so far
}

TEST(SplatTurns, ThatWereDroppedAreMadeAgainToTheBit) {
    Desk desk(splats());
    std::string lines = ends;
    for (int edit = 0; edit < 4; ++edit) lines += drag(turn(edit % 2 ? 'x' : 'y', 20)) + commit;
    desk.play(lines);
    std::vector<std::vector<float>> seen;
    for (int edit = 0; edit < 4; ++edit) {
        seen.push_back(rotations(desk));
        desk.play(undo + undo);
    }
    desk.document().keep_at_most({1, 1, 0});
    desk.play(redo + redo + redo + redo + redo + redo + redo + redo);
    for (int edit = 0; edit < 4; ++edit) {
        EXPECT_TRUE(same_bits(rotations(desk), seen[static_cast<std::size_t>(edit)])) << edit;
        desk.play(undo + undo);
    }
}

TEST(SplatTurns, OfACarriedPartAreThoseOfWhatItFollows) {
    const PointCloud whole = bar();
    std::vector<float> points = whole.positions;
    for (int i = 0; i < 20; ++i) // a flake above the top
        points.insert(points.end(), {0.02F * static_cast<float>(i), 0.0F, 4.0F});
    Desk desk(splats(make_cloud(points)));
    desk.play(set(R"("strays":"carry")") + ends + drag(turn('x', 40)));
    const Quatd expected = about(Vec3d::UnitX(), 40);
    const std::vector<float> turned = rotations(desk);
    for (std::size_t i = whole.size(); i < points.size() / 3; ++i)
        EXPECT_LT((turn_at(turned, i).coeffs() - expected.coeffs()).norm(), 1e-5);
}

TEST(SplatTurns, AreSavedByAReplay) {
    const ScratchFolder folder;
    SilentProgress progress;
    (void)write_cloud(folder / "splats.ply", splats(), {}, progress);
    write_text(folder / "s.knead", "{\"knead\":1,\"cloud\":{\"path\":\"splats.ply\"}}\n" + ends +
                                       drag(turn('x', 60)) + commit + drag(turn('z', 20)));
    ReplayOptions options;
    options.out = folder / "out.ply";
    (void)replay(read_session(folder / "s.knead"), options, progress, [](const std::string& /*words*/) {});
    const PointCloud saved = read_cloud(folder / "out.ply", progress);
    const auto part = [&](const char* name, std::size_t i) {
        return value_at(saved.attributes[find_attribute(saved, name).value()], i);
    };
    const Quatd expected = about(Vec3d::UnitZ(), 20) * about(Vec3d::UnitX(), 60);
    const PointCloud rest = splats();
    for (std::size_t i = 0; i < rest.size(); ++i) {
        const Quatd turned(part("rot_0", i), part("rot_1", i), part("rot_2", i), part("rot_3", i));
        const double height = at(rest.positions, i).z();
        if (height > 2) {
            EXPECT_LT((turned.coeffs() - expected.coeffs()).norm(), rounding);
        }
        if (height < -2) {
            EXPECT_EQ(turned.coeffs(), Quatd::Identity().coeffs());
        }
    }
}

TEST(SplatTurns, AreNotKeptForOtherClouds) {
    Desk desk(bar());
    desk.play(all + drag(turn('x', 70), "all") + commit);
    EXPECT_TRUE(rotations(desk).empty());
    Desk with(splats());
    with.play(all + drag(turn('x', 70), "all") + commit);
    EXPECT_EQ(with.document().kept_bytes() - desk.document().kept_bytes(),
              16 * with.document().cloud().size());
}

} // namespace
} // namespace knead::test
