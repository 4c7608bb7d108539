// knead render, and the pictures of knead replay.

#include "io/cloud_file.h"
#include "support/run_knead.h"
#include "support/scans.h"
#include "support/scratch_folder.h"
#include "support/turned_cloud.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace knead::test {
namespace {

// A PNG file begins with its signature, and 16 bytes on with width and height, high byte first.
bool is_png_of(const std::filesystem::path& path, unsigned width, unsigned height) {
    const std::string bytes = read_text(path);
    if (bytes.size() < 24 || bytes.substr(1, 3) != "PNG") return false;
    const auto number = [&](std::size_t at) {
        unsigned value = 0;
        for (std::size_t i = at; i < at + 4; ++i) value = value << 8U | static_cast<unsigned char>(bytes[i]);
        return value;
    };
    return number(16) == width && number(20) == height;
}

std::vector<std::string> files_in(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

const std::string session_text =
    R"({"knead":1,"cloud":{"path":"bar.ply"},"settings":{"samples":100}})"
    "\n"
    R"({"op":"handle","name":"foot","role":"fixed","region":{"halfspace":{"point":[0,0,-2],"normal":[0,0,-1]}}})"
    "\n"
    R"({"op":"handle","name":"top","role":"moving","region":{"halfspace":{"point":[0,0,2],"normal":[0,0,1]}}})"
    "\n"
    R"({"op":"drag","handle":"top","pivot":[0,0,2],"frames":[{},{"translate":[1,0,0.5]}]})"
    "\n{\"op\":\"settle\",\"iterations\":5}\n";

class Render : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_EQ(run_knead({"make", "bar", "--points", "800", "--out", "bar.ply"}, folder.path()).code, 0);
        const Outcome outcome = render({"bar.ply", "--out", "probe.png", "--size", "4x4"});
        if (outcome.code == 2) GTEST_SKIP() << outcome.err;
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        std::filesystem::remove(folder / "probe.png");
        write_text(folder / "s.knead", session_text);
    }

    Outcome render(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "render");
        return run_knead(arguments, folder.path());
    }
    Outcome replay(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"replay", "s.knead"});
        return run_knead(arguments, folder.path());
    }

    // It ends with this code and words, and leaves no file behind.
    void expect_failure(const Outcome& outcome, int code, const std::string& words) {
        EXPECT_EQ(outcome.code, code) << outcome.err;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
        EXPECT_TRUE(outcome.out.empty());
        EXPECT_EQ(files_in(folder.path()), (std::vector<std::string>{"bar.ply", "s.knead"}));
    }

    ScratchFolder folder;
};

TEST_F(Render, WritesAPictureOfTheSizeAskedFor) {
    const Outcome outcome = render({"bar.ply", "--out", "a.png"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(is_png_of(folder / "a.png", 1280, 800));
    EXPECT_EQ(render({"bar.ply", "--out", "a.png", "--size", "300x200"}).code, 0);
    EXPECT_TRUE(is_png_of(folder / "a.png", 300, 200));
}

TEST_F(Render, EveryOptionChangesThePicture) {
    const std::vector<std::vector<std::string>> options = {{},
                                                           {"--view", "front"},
                                                           {"--view", "top"},
                                                           {"--view", "70,40"},
                                                           {"--view=-30,-20"},
                                                           {"--up", "y"},
                                                           {"--up=-y"},
                                                           {"--color", "height"},
                                                           {"--zoom", "2"},
                                                           {"--point-size", "2"},
                                                           {"--background", "#ffffff"},
                                                           {"--orthographic"},
                                                           {"--no-eye-dome"}};
    const std::string creature = in_repository("data/creature-5k.ply").string();
    std::vector<std::string> pictures;
    for (std::vector<std::string> arguments : options) {
        arguments.insert(arguments.begin(), {creature, "--out", "a.png", "--size", "320x240"});
        const Outcome outcome = render(arguments);
        EXPECT_EQ(outcome.code, 0) << arguments.back() << outcome.err;
        pictures.push_back(read_text(folder / "a.png"));
    }
    std::ranges::sort(pictures);
    EXPECT_EQ(std::ranges::adjacent_find(pictures), pictures.end());
}

TEST_F(Render, SeesACloudUprightWhateverItsAxis) {
    SilentProgress quiet;
    ASSERT_EQ(run_knead({"make", "cylinder", "--points", "3000", "--out", "tube.xyz"}, folder.path()).code,
              0);
    write_text(folder / "turned.xyz", turned_to_y(read_cloud(folder / "tube.xyz", quiet)));
    const auto picture = [&](const char* file, const char* up) {
        std::vector<std::string> arguments{file,    "--out",        "a.png", "--size",
                                           "64x48", "--point-size", "3",     "--no-eye-dome"};
        if (up) arguments.insert(arguments.end(), {"--up", up});
        const Outcome outcome = render(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return read_text(folder / "a.png");
    };
    EXPECT_EQ(picture("tube.xyz", "auto"), picture("tube.xyz", "z"));
    EXPECT_EQ(picture("turned.xyz", "auto"), picture("turned.xyz", "y"));
    EXPECT_EQ(picture("turned.xyz", nullptr), picture("turned.xyz", "y")) << "as the window opens it";
    EXPECT_NE(picture("turned.xyz", "y"), picture("turned.xyz", "z"));
}

TEST_F(Render, RefusesWhatItCannotDraw) {
    expect_failure(render({"nowhere.ply", "--out", "a.png"}), 3, "nowhere.ply");
    for (const char* size : {"0x5", "12", "axb", "10x10x10", "9999999x3", "-3x3", "10 x 10"})
        expect_failure(render({"bar.ply", "--out", "a.png", "--size=" + std::string(size)}), 2, "--size");
    for (const char* view : {"behind", "1,2,3", "0,91", "nan,0"})
        expect_failure(render({"bar.ply", "--out", "a.png", "--view", view}), 2, "--view");
    expect_failure(render({"bar.ply", "--out", "a.png", "--up", "x"}), 2, "--up");
    expect_failure(render({"bar.ply", "--out", "a.png", "--background", "red"}), 2, "--background");
    expect_failure(render({"bar.ply", "--out", "a.png", "--color", "heat"}), 2, "heat");
    expect_failure(render({"bar.ply", "--out", "a.png", "--color", "displacement"}), 2, "displacement");
    expect_failure(render({"bar.ply", "--out", "a.png", "--color", "rgb"}), 2, "no colours of its own");
    expect_failure(render({"bar.ply", "--out", "a.png", "--zoom", "0"}), 2, "--zoom");
    expect_failure(render({"bar.ply", "--out", "a.jpg"}), 2, "PNG");
    expect_failure(render({"bar.ply", "--out", "bar.ply"}), 2, "PNG");
    expect_failure(render({"bar.ply", "--out", "nowhere/a.png"}), 5, "nowhere");
    expect_failure(render({"bar.ply"}), 2, "--out");
}

TEST_F(Render, RefusesACloudWithNothingToSee) {
    const std::string header = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                               "property float z\nend_header\n";
    write_text(folder / "none.ply", header + "nan 0 0\n");
    EXPECT_EQ(render({"none.ply", "--out", "a.png"}).code, 3);
    write_text(folder / "one.ply", header + "1 2 3\n");
    EXPECT_EQ(render({"one.ply", "--out", "a.png"}).code, 0); // a point is something
}

TEST_F(Render, ReplayDrawsItsLastShape) {
    const Outcome outcome = replay({"--picture", "a.png", "--size", "200x100", "--color", "displacement"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(is_png_of(folder / "a.png", 200, 100));
    ASSERT_EQ(replay({"--picture", "b.png", "--size", "200x100", "--out", "posed.ply"}).code, 0);
    ASSERT_EQ(render({"posed.ply", "--out", "c.png", "--size", "200x100"}).code, 0);
    ASSERT_EQ(render({"bar.ply", "--out", "d.png", "--size", "200x100"}).code, 0);
    EXPECT_NE(read_text(folder / "b.png"), read_text(folder / "d.png"));
}

TEST_F(Render, ReplayDrawsEveryFrame) {
    const Outcome outcome = replay({"--frames", "frames/", "--picture", "a.png", "--size", "120x90"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    // Two frames of the drag, and the settling.
    EXPECT_EQ(files_in(folder / "frames"),
              (std::vector<std::string>{"frame-000001.png", "frame-000002.png", "frame-000003.png"}));
    EXPECT_TRUE(is_png_of(folder / "frames" / "frame-000003.png", 120, 90));
    EXPECT_NE(read_text(folder / "frames" / "frame-000001.png"),
              read_text(folder / "frames" / "frame-000002.png"));
    EXPECT_TRUE(is_png_of(folder / "a.png", 120, 90));
    EXPECT_EQ(files_in(folder.path()), (std::vector<std::string>{"a.png", "bar.ply", "frames", "s.knead"}));
}

TEST_F(Render, ASettlingIsAFrameOfTheShapeThatIsThere) {
    const std::string settle = "{\"op\":\"settle\",\"iterations\":2}\n";
    write_text(folder / "s.knead", session_text + "{\"op\":\"undo\"}\n{\"op\":\"undo\"}\n" + settle);
    ASSERT_EQ(replay({"--frames", "frames", "--picture", "a.png", "--size", "120x90"}).code, 0);
    EXPECT_NE(read_text(folder / "frames/frame-000003.png"), read_text(folder / "frames/frame-000004.png"));
    const std::string header = session_text.substr(0, session_text.find('\n') + 1);
    write_text(folder / "s.knead", header + settle); // before anything is posed
    const Outcome outcome = replay({"--frames", "rest", "--size", "120x90"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(files_in(folder / "rest"), std::vector<std::string>{"frame-000001.png"});
}

TEST_F(Render, SaysThatFramesOfALongerReplayAreStillThere) {
    ASSERT_EQ(replay({"--frames", "frames", "--size", "40x30"}).err.find("earlier"), std::string::npos);
    write_text(folder / "frames/frame-000004.png", "old");
    const Outcome outcome = replay({"--frames", "frames", "--size", "40x30"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.err.find("holds frames of an earlier run, too, up to frame-000004.png"),
              std::string::npos)
        << outcome.err;
    EXPECT_EQ(read_text(folder / "frames/frame-000004.png"), "old");
}

TEST_F(Render, AReplayThatFailsLeavesNoPictures) {
    expect_failure(replay({"--picture", "a.txt"}), 2, "PNG");
    expect_failure(replay({"--picture", "a.png", "--size", "0x0"}), 2, "--size");
    expect_failure(replay({"--frames", "bar.ply"}), 5, "bar.ply");
    expect_failure(replay({"--frames", "nowhere/frames"}), 5, "nowhere");
    write_text(folder / "s.knead",
               session_text + R"({"op":"drag","handle":"nobody","pivot":[0,0,0],"frames":[{}]})");
    expect_failure(replay({"--picture", "a.png", "--frames", "frames", "--size", "40x30"}), 3, "nobody");
}

TEST_F(Render, AReplayWhoseFramesCannotBePlacedSavesNothingElse) {
    write_text(folder / "posed.ply", "old");
    write_text(folder / "a.png", "old");
    std::filesystem::create_directories(folder / "frames/frame-000002.png"); // is in the way
    const Outcome outcome =
        replay({"--out", "posed.ply", "--picture", "a.png", "--frames", "frames", "--size", "40x30"});
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_NE(outcome.err.find("frame-000002.png"), std::string::npos) << outcome.err;
    EXPECT_EQ(read_text(folder / "posed.ply"), "old");
    EXPECT_EQ(read_text(folder / "a.png"), "old");
    EXPECT_EQ(files_in(folder / "frames"), std::vector<std::string>{"frame-000002.png"});
}

TEST_F(Render, NoPictureTakesThePlaceOfTheSession) {
    const std::string session = read_text(folder / "s.knead");
    const std::vector<std::string> commands[] = {{"replay", "frame-000001.png", "--frames", "."},
                                                 {"replay", "s.png", "--picture", "./s.png"}};
    for (const std::vector<std::string>& command : commands) {
        write_text(folder / command[1], session);
        const Outcome outcome = run_knead(command, folder.path());
        EXPECT_EQ(outcome.code, 5);
        EXPECT_NE(outcome.err.find("is the session itself"), std::string::npos) << outcome.err;
        EXPECT_EQ(read_text(folder / command[1]), session);
    }
}

TEST_F(Render, ARehearsalDrawsNothing) {
    EXPECT_EQ(replay({"--dry-run", "--picture", "a.png", "--frames", "frames"}).code, 0);
    EXPECT_EQ(replay({"--dry-run", "--picture", "a.jpg"}).code, 2);
    EXPECT_EQ(files_in(folder.path()), (std::vector<std::string>{"bar.ply", "s.knead"}));
}

TEST_F(Render, DrawsARecordedSessionOfTheRepository) {
    const Outcome outcome = run_knead({"replay", in_repository("data/creature-wave.knead").string(),
                                       "--picture", (folder / "wave.png").string(), "--size", "320x240"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(is_png_of(folder / "wave.png", 320, 240));
}

} // namespace
} // namespace knead::test
