// Whole sessions: the same bytes every time and everywhere, and what a replay reports.

#include "edit/editing.h"
#include "edit/replay.h"
#include "io/cloud_file.h"
#include "support/scratch_folder.h"

namespace knead {
namespace {

using namespace test;

void write_bar(const std::filesystem::path& path, std::size_t points = 3000) {
    SilentProgress progress;
    write_cloud(path, bar(points), {}, progress);
}

// A session file over bar.ply in the folder.
Session session_in(const ScratchFolder& folder, const std::string& lines) {
    if (!std::filesystem::exists(folder / "bar.ply")) write_bar(folder / "bar.ply");
    write_text(folder / "s.knead", "{\"knead\":1,\"cloud\":{\"path\":\"bar.ply\"}}\n" + lines);
    return read_session(folder / "s.knead");
}

struct Told {
    ReplayReport report;
    std::vector<std::string> warnings;
};
// No machine's devices have a say in it, nor in the warnings.
ReplayOptions on_the_reference() {
    ReplayOptions options;
    options.device = "reference";
    return options;
}
Told told(const Session& session, const ReplayOptions& options = on_the_reference()) {
    SilentProgress progress;
    Told result;
    result.report = replay(session, options, progress,
                           [&](const std::string& words) { result.warnings.push_back(words); });
    return result;
}

const std::string wriggle = ends +
                            drag(turn('y', 20) + "," + turn('y', 40) + "," + turn('y', 75, "[0.2,0.1,0]")) +
                            settle(25) + commit + drag(turn('z', 30) + "," + turn('z', 60)) + settle(10);

// --- Determinism

TEST(Replay, GivesTheSameBytesForAnyThreadsAndEveryTime) {
    const ScratchFolder folder;
    const Session session = session_in(folder, wriggle);
    for (const std::string device : {"reference", ""}) {
        std::string first;
        for (const unsigned threads : {1U, 2U, 3U, 2U}) {
            ReplayOptions options;
            options.out = folder / "out.ply";
            options.device = device;
            options.threads = threads;
            told(session, options);
            const std::string bytes = read_text(folder / "out.ply");
            if (first.empty()) first = bytes;
            EXPECT_EQ(bytes, first) << threads << " threads on \"" << device << '"';
        }
    }
}

TEST(Replay, EveryDeviceAgreesWithTheReference) {
    if (list_devices().empty()) GTEST_SKIP() << "there is no OpenCL device";
    Desk reference(bar());
    reference.play(wriggle);
    const std::vector<float> expected = reference.shape();
    for (std::size_t device = 0; device < list_devices().size(); ++device) {
        Desk desk(bar(), {}, 2, std::to_string(device));
        desk.play(wriggle);
        const std::vector<float> shape = desk.shape();
        double largest = 0;
        for (std::size_t i = 0; i < shape.size() / 3; ++i)
            largest = std::max(largest, (at(shape, i) - at(expected, i)).norm());
        // Some devices fuse multiplication and addition, which changes the last bits of a float.
        EXPECT_LT(largest, 2e-6 * desk.diagonal());
    }
}

// --- Turns

// How far the cloud is turned about z between its lowest and highest slice, in degrees.
double twist_of(const std::vector<float>& rest, const std::vector<float>& posed) {
    constexpr int slices = 60;
    std::vector<double> sine(slices), cosine(slices);
    for (std::size_t i = 0; i < rest.size() / 3; ++i) {
        const Vec3d p = at(rest, i), q = at(posed, i);
        const int slice = std::clamp(static_cast<int>((p.z() + 4.5) / 9 * slices), 0, slices - 1);
        sine[static_cast<std::size_t>(slice)] += p.x() * q.y() - p.y() * q.x();
        cosine[static_cast<std::size_t>(slice)] += p.x() * q.x() + p.y() * q.y();
    }
    double total = 0, before = 0;
    for (std::size_t slice = 0; slice < slices; ++slice) {
        const double angle = std::atan2(sine[slice], cosine[slice]);
        total += std::remainder(angle - before, 2 * std::numbers::pi);
        before = angle;
    }
    return total * 180 / std::numbers::pi;
}

TEST(Replay, KeepsAllTurnsOfATwist) {
    PointCloud cloud = bar(3000);
    for (std::size_t i = 2; i < cloud.positions.size(); i += 3) cloud.positions[i] *= 2; // 1 : 10
    Desk desk(make_cloud(cloud.positions));
    std::string lines = ends;
    for (const char* end : {"[0,0,2]", "[0,0,-2]"}) {
        const std::string farther = end[5] == '2' ? "[0,0,4.5]" : "[0,0,-4.5]";
        lines.replace(lines.find(end), std::strlen(end), farther);
    }
    const auto turned = [](int from, int to) {
        std::string frames;
        for (int degrees = from; degrees != to;) {
            degrees += to > from ? 10 : -10;
            frames += (frames.empty() ? "" : ",") + turn('z', degrees);
        }
        return drag(frames);
    };
    const auto twist = [&] { return twist_of(desk.document().cloud().positions, desk.shape()); };
    // Settled for ever, a bar of this thickness keeps a turn and a half; twice around, it buckles in the end.
    desk.play(lines + turned(0, 540) + settle(100));
    EXPECT_NEAR(twist(), 540, 1);
    desk.play(turned(540, 720));
    EXPECT_NEAR(twist(), 720, 2);
    EXPECT_LT(desk.handle_error(), 1e-5);
    // Turning back undoes it: nothing of it is left in the rotations.
    desk.play(turned(720, 0) + settle(200));
    EXPECT_LT(farthest(desk, every, stays), 1e-3 * desk.diagonal());
}

// A program that writes quaternions with w ≥ 0 flips their sign once a turn.
TEST(Replay, TurnsGoOnWhateverTheSignsOfTheirQuaternions) {
    std::string steady, flipping;
    for (int degrees = 30; degrees <= 360; degrees += 30) {
        const char* const comma = steady.empty() ? "" : ",";
        steady += comma + turn('z', degrees);
        flipping += comma + turn('z', degrees > 180 ? degrees - 360 : degrees);
    }
    Desk desk(bar()), other(bar());
    desk.play(ends + drag(steady));
    other.play(ends + drag(flipping));
    EXPECT_NE(desk.shape(), bar().positions);
    EXPECT_TRUE(same_bits(desk.shape(), other.shape()));
}

// --- Reports

TEST(Replay, ReportsWhatItDid) {
    const ScratchFolder folder;
    const Told result = told(session_in(folder, wriggle));
    const ReplayReport& report = result.report;
    EXPECT_EQ(report.points, 3000U);
    EXPECT_EQ(report.components, 1U);
    EXPECT_EQ(report.strays, 0U);
    EXPECT_EQ(report.frames, 5U);
    EXPECT_GT(report.iterations, 5U * 3);           // of the frames
    EXPECT_LE(report.iterations, 5U * 3 + 25 + 10); // settling stops by itself at rest
    EXPECT_GE(report.samples, 1000U);
    EXPECT_LT(report.handle_error, 1e-5);
    EXPECT_NEAR(report.diagonal, std::sqrt(27), 0.05);
    EXPECT_GT(report.solve, 0);
    EXPECT_GT(report.upsample, 0);
    EXPECT_GT(report.peak_memory, 1'000'000U);
    EXPECT_TRUE(report.all_checks_held());
    EXPECT_TRUE(result.warnings.empty());
    const StageSeconds& stages = report.stages;
    const double sum = report.read + stages.order + stages.neighbors + stages.sampling + stages.geodesic +
                       stages.factorize + stages.device + report.write;
    EXPECT_GE(report.total, sum);
}

TEST(Replay, WarnsOnceOfPartsWithoutAHandle) {
    const ScratchFolder folder;
    std::vector<float> positions = bar(1000).positions;
    for (const float x : {50.0F, 51.0F, 52.0F, 53.0F, 54.0F, 55.0F, 56.0F, 57.0F})
        positions.insert(positions.end(), {x, 0, 0});
    SilentProgress progress;
    write_cloud(folder / "bar.ply", make_cloud(positions), {}, progress);
    const Told result = told(session_in(folder, ends + drag(lift) + drag(lift) + commit + drag(lift)));
    EXPECT_EQ(result.report.components, 2U);
    EXPECT_EQ(result.report.strays, 1U);
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_SAYS(result.warnings[0], "1 part of the cloud (8 points)");
    EXPECT_EQ(result.report.warnings, result.warnings);
    EXPECT_SAYS(result.warnings[0], "stays where it is");
    const auto warning = [&](const std::string& mode) {
        const Told told_of = told(session_in(folder, set("\"strays\":\"" + mode + "\"") + ends + drag(lift)));
        EXPECT_EQ(told_of.report.strays, 1U);
        return told_of.warnings.empty() ? std::string() : told_of.warnings[0];
    };
    EXPECT_SAYS(warning("carry"), "follows the nearest part that does");
    EXPECT_SAYS(warning("bridge"), "too far from what holds a handle");
}

TEST(Replay, WarnsOfADragThatMovesNothing) {
    const ScratchFolder folder;
    const std::string later = R"({"op":"handle","name":"cap","role":"fixed","region":)";
    const auto cap = [&](const char* height) {
        return later + R"({"halfspace":{"point":[0,0,)" + height + R"(],"normal":[0,0,1]}}})" + "\n";
    };
    const Told swallowed = told(session_in(folder, ends + cap("1.5") + drag(lift)));
    ASSERT_EQ(swallowed.warnings.size(), 1U);
    EXPECT_SAYS(swallowed.warnings[0], "s.knead:5: handle \"top\" moves nothing");
    for (const std::string& words : told(session_in(folder, ends + cap("2.3") + drag(lift))).warnings)
        EXPECT_EQ(words.find("moves nothing"), std::string::npos) << words; // some points are left to it
}

TEST(Replay, ReportsOfTheShapeThatAnUndoLeaves) {
    const ScratchFolder folder;
    const std::string posed = ends + drag(lift) + commit;
    const Told before = told(session_in(folder, posed));
    const Told undone = told(session_in(folder, posed + set(R"("samples":100)") + drag(lift) + undo + undo));
    EXPECT_EQ(undone.report.samples, before.report.samples);
    EXPECT_EQ(undone.report.components, before.report.components);
}

TEST(Replay, SettingsGivenFromOutsideWinOverHeaderAndLines) {
    const ScratchFolder folder;
    const Session session = session_in(folder, set(R"("samples":100)") + ends + drag(lift) +
                                                   set(R"("iterations":7)") + drag(lift));
    ReplayOptions options;
    options.overrides = merged(parse_setting("samples=500"), parse_setting("iterations=2"));
    const ReplayReport report = told(session, options).report;
    EXPECT_GE(report.samples, 500U);
    EXPECT_LE(report.samples, 600U);
    EXPECT_EQ(report.iterations, 4U);
}

TEST(Replay, ARehearsalFindsMistakesAndComputesNothing) {
    const ScratchFolder folder;
    ReplayOptions options;
    options.rehearse = true;
    options.out = folder / "out.ply";
    const ReplayReport report = told(session_in(folder, wriggle + undo + undo + redo), options).report;
    EXPECT_EQ(report.iterations, 0U);
    EXPECT_EQ(report.components, 0U);
    EXPECT_FALSE(std::filesystem::exists(folder / "out.ply"));
    const auto words = [&](const std::string& lines) -> std::string {
        try {
            told(session_in(folder, lines), options);
        } catch (const Error& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_SAYS(words(ends + drag(lift) + foot), "s.knead:5: ");
    EXPECT_SAYS(words(ends + drag(lift, "ear")), "s.knead:4: \"handle\"");
    EXPECT_SAYS(words(undo), "s.knead:2: there is nothing to undo");
    EXPECT_SAYS(words(ends + R"({"op":"check","positions":"no.ply","tolerance":1})"),
                "s.knead:4: \"positions\"");
    EXPECT_EQ(words(ends + drag(lift) + commit + foot + drag(lift)), "accepted");
    // After a commit nobody knows here which points a region is: another colour may be all that changes.
    const std::string top = R"({"op":"handle","name":"top","role":"moving",)";
    EXPECT_EQ(words(ends + drag(lift) + commit + top +
                    R"("region":{"halfspace":{"point":[0,0,2],"normal":[0,0,1]}}})" + "\n" + drag(lift) +
                    top + R"("points":[1,2,3],"color":"#112233"})" + "\n"),
              "accepted");
    EXPECT_SAYS(words(ends + drag(lift) + commit + top + R"("points":[7]})" + "\n" + drag(lift) + top +
                      R"("points":[1,2,3],"color":"#112233"})" + "\n"),
                "s.knead:8: ");
}

TEST(Replay, AnEditWithNoIterationsIsEquationOneAlone) {
    const ScratchFolder folder;
    ReplayOptions options;
    options.overrides = parse_setting("iterations=0");
    const ReplayReport report = told(session_in(folder, ends + drag(turn('y', 90))), options).report;
    EXPECT_EQ(report.iterations, 0U);
    EXPECT_EQ(report.solve, 0);
    EXPECT_LT(report.handle_error, 1e-6);
}

TEST(Replay, ACheckWithAPointThatIsNotFiniteFails) {
    const ScratchFolder folder;
    std::vector<float> positions = bar(3000).positions;
    positions[3 * 7] = std::nanf("");
    SilentProgress progress;
    write_cloud(folder / "holed.ply", make_cloud(positions), {}, progress);
    const Session session = session_in(folder, R"({"op":"check","positions":"holed.ply","tolerance":1e-4})");
    const ReplayReport report = told(session).report;
    ASSERT_EQ(report.checks.size(), 1U);
    EXPECT_FALSE(report.checks[0].held);
    EXPECT_FALSE(report.all_checks_held());
    EXPECT_SAYS(report.checks[0].words, "point 7 is not finite");
    EXPECT_FALSE(report.checks[0].distance) << "they cannot be compared";
}

TEST(Replay, WhereAllPointsLieInOnePlaceACheckHoldsJustThere) {
    const ScratchFolder folder;
    SilentProgress progress;
    for (const float x : {0.0F, 0.5F}) {
        const std::vector<float> place{x, 1, 1};
        write_cloud(folder / (x == 0 ? "there.ply" : "elsewhere.ply"), make_cloud(place), {}, progress);
    }
    const auto held = [&](const std::string& other) {
        write_text(folder / "s.knead", R"({"knead":1,"cloud":{"path":"there.ply"}})"
                                       "\n"
                                       R"({"op":"check","positions":")" +
                                           other + R"(.ply","tolerance":1})" + "\n");
        return told(read_session(folder / "s.knead")).report.all_checks_held();
    };
    EXPECT_TRUE(held("there"));
    EXPECT_FALSE(held("elsewhere")) << "D is 0, and so is any tolerance times D";
}

TEST(Replay, WarnsThatItReplacedItsOwnCloud) {
    const ScratchFolder folder;
    const Session session = session_in(folder, ends + drag(lift));
    ReplayOptions options = on_the_reference();
    options.out = folder / "posed.ply";
    EXPECT_TRUE(told(session, options).warnings.empty());
    options.out = folder / "bar.ply";
    const std::vector<std::string> warnings = told(session, options).warnings;
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_SAYS(warnings.front(), "bar.ply");
}

TEST(Replay, NeverPutsTheShapeInThePlaceOfTheSession) {
    const ScratchFolder folder;
    const Session session = session_in(folder, ends + drag(lift));
    const std::string text = read_text(session.file);
    std::filesystem::create_symlink(session.file, folder / "link.ply");
    ReplayOptions options = on_the_reference();
    options.out = folder / "link.ply";
    try {
        told(session, options);
        ADD_FAILURE() << "the session is no cloud";
    } catch (const Error& error) {
        EXPECT_EQ(error.trouble(), Trouble::output);
        EXPECT_SAYS(error.what(), "the session itself");
    }
    EXPECT_EQ(read_text(session.file), text);
}

TEST(Replay, RecordsNoChecksThroughALinkFromAnotherFolder) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder / "links");
    const Session session = session_in(folder, ends + drag(lift));
    const std::string text = read_text(session.file);
    std::filesystem::create_symlink(session.file, folder / "links/s.knead");
    std::filesystem::create_symlink(session.file, folder / "beside.knead");
    std::filesystem::create_symlink(folder / "bar.ply", folder / "links/bar.ply");
    ReplayOptions options = on_the_reference();
    options.record_checks = true;
    try {
        told(read_session(folder / "links/s.knead"), options);
        ADD_FAILURE() << "it was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.trouble(), Trouble::output);
        EXPECT_SAYS(error.what(), "is a link into another folder");
    }
    EXPECT_EQ(read_text(session.file), text);
    told(read_session(folder / "beside.knead"), options);
    const ReplayReport again = told(read_session(session.file), on_the_reference()).report;
    ASSERT_EQ(again.checks.size(), 1U);
    EXPECT_TRUE(again.checks[0].held);
}

TEST(Replay, WritesAllItsOutputsOrNone) {
    const ScratchFolder folder;
    const Session session = session_in(folder, ends + drag(lift));
    ReplayOptions options;
    options.device = "reference";
    options.out = folder / "posed.ply";
    options.record_checks = true;
    write_text(*options.out, "old");
    const std::string recorded = read_text(session.file);
    SilentProgress silent;
    const auto run = [&](bool picture_folder_vanishes) {
        options.add_outputs = [&, picture_folder_vanishes](Outputs& outputs) {
            std::filesystem::create_directory(folder / "pictures");
            outputs.add(FileInTheMaking(folder / "pictures/a.png")).write("picture");
            if (picture_folder_vanishes) std::filesystem::remove_all(folder / "pictures");
        };
        return replay(session, options, silent, [](const std::string&) {});
    };
    try {
        run(true);
        ADD_FAILURE() << "there was no folder for the picture";
    } catch (const Error& error) {
        EXPECT_EQ(error.trouble(), Trouble::output);
        EXPECT_SAYS(error.what(), "a.png");
    }
    EXPECT_EQ(read_text(*options.out), "old");
    EXPECT_EQ(read_text(session.file), recorded);
    EXPECT_FALSE(std::filesystem::exists(folder / "s-check-1.ply"));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 3) << "no temporaries";
    run(false);
    EXPECT_NE(read_text(*options.out), "old");
    EXPECT_NE(read_text(session.file), recorded);
    EXPECT_EQ(read_text(folder / "pictures/a.png"), "picture");
}

} // namespace
} // namespace knead
