// Sessions that were made to do harm: they write nowhere, take no memory out of proportion, and end with a
// word.

#include "edit/editing.h"
#include "edit/live_bar.h"
#include "support/child.h"
#include "support/run_knead.h"

#include <set>

#include <sys/resource.h>
#include <sys/stat.h>

namespace knead::test {
namespace {

namespace fs = std::filesystem;

class HostileSession : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directory(folder_ / "work");
        bar_file(folder_, 1000);
        fs::rename(folder_ / "bar.ply", folder_ / "work/bar.ply");
    }

    void session(const std::string& lines) const {
        write_text(folder_ / "work/s.knead", "{\"knead\":1,\"cloud\":{\"path\":\"bar.ply\"}}\n" + lines);
    }

    Outcome replay(std::vector<std::string> arguments = {}) const {
        arguments.insert(arguments.begin(), {"replay", "s.knead"});
        return run_knead(arguments, folder_ / "work");
    }

    std::string refused_with(const std::string& lines) const {
        session(lines);
        const Outcome outcome = replay();
        EXPECT_EQ(outcome.code, 3) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        return outcome.err;
    }

    std::set<std::string> names() const {
        std::set<std::string> all;
        for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
            all.insert(entry.path().lexically_relative(folder_.path()).string());
        return all;
    }

    const ScratchFolder folder_;
};

std::string handle_of(const std::string& points) {
    return R"({"op":"handle","name":"a","role":"fixed","points":)" + points + "}\n";
}

TEST_F(HostileSession, RecordingChecksWritesBesideTheSessionAndThroughNoLink) {
    write_text(folder_ / "precious", "precious");
    fs::create_directory(folder_ / "deeper");
    for (const char* name : {"work/s-check-1.ply", "work/s-check-7.ply"})
        fs::create_symlink("../precious", folder_ / name);
    write_text(folder_ / "s-check-1.ply", read_text(folder_ / "work/bar.ply"));
    const std::string elsewhere = R"({"op":"check","positions":"../s-check-1.ply","tolerance":9})"
                                  "\n"
                                  R"({"op":"check","positions":"../deeper/../s-check-1.ply","tolerance":9})"
                                  "\n"
                                  R"({"op":"check","positions":")" +
                                  (folder_ / "s-check-1.ply").string() + "\",\"tolerance\":9}\n";
    const std::string own = R"({"op":"check","positions":"s-check-1.ply","tolerance":9})"
                            "\n"; // is recorded again
    session(ends + drag(lift) + own + elsewhere);
    const std::set<std::string> before = names();
    const Outcome outcome = replay({"--record-checks"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(names(), before);
    EXPECT_EQ(read_text(folder_ / "precious"), "precious");
    EXPECT_FALSE(fs::is_symlink(folder_ / "work/s-check-1.ply")) << "the link is replaced, not followed";
    EXPECT_EQ(read_text(folder_ / "s-check-1.ply"), read_text(folder_ / "work/bar.ply"));
    const std::string text = read_text(folder_ / "work/s.knead");
    EXPECT_SAYS(text, elsewhere) << "checks that are not recorded ones stay as they are";
}

TEST_F(HostileSession, AReplayWritesNothingThatTheCommandLineDoesNotName) {
    session(ends + drag(lift) +
            R"({"op":"rename","handle":"top","to":"../../../x"})"
            "\n" +
            R"({"op":"check","positions":"bar.ply","tolerance":9})"
            "\n");
    const std::set<std::string> before = names();
    EXPECT_EQ(replay().code, 0);
    EXPECT_EQ(names(), before);
}

TEST_F(HostileSession, HugeNumbersAreRefusedByName) {
    for (const char* points :
         {"[[0,1e18]]", "[[0,1000000000000000000]]", "[[0,18446744073709551615]]", "[[0,9007199254740992]]",
          "[99999999999999999999999999]", "[1e400]", "[-1]", "[0.5]", "[[5,4]]", "[[0,1000]]", "[1000]"})
        EXPECT_SAYS(refused_with(handle_of(points)), "s.knead:2: ") << points;
    for (const char* key : {"neighbors", "samples", "iterations"})
        for (const char* number : {"1e18", "18446744073709551616", "-1", "1e999999999"})
            EXPECT_SAYS(refused_with(std::string(R"({"op":"set",")") + key + "\":" + number + "}\n"),
                        number == std::string("1e999999999") ? number : key); // no double holds that one
    EXPECT_SAYS(refused_with("{\"op\":\"settle\",\"iterations\":1000001}\n"), "iterations");
    EXPECT_SAYS(refused_with(ends + drag(R"({"translate":[1e308,1e308,0]})")), "out of all range");
    EXPECT_SAYS(refused_with(ends + drag(R"({"scale":1e300})")), "out of all range");
    write_text(folder_ / "work/s.knead",
               "{\"knead\":1,\"cloud\":{\"path\":\"bar.ply\",\"points\":18446744073709551615}}\n");
    EXPECT_EQ(replay().code, 3);
}

TEST_F(HostileSession, NestingIsRefusedAtAnyDepth) {
    for (const std::size_t depth : {33U, 100'000U, 3'000'000U})
        for (const std::string open : {"[", "{\"a\":"}) {
            std::string text;
            for (std::size_t i = 0; i < depth; ++i) text += open;
            EXPECT_SAYS(refused_with("{\"op\":" + text + "\n"), "nested too deeply");
        }
}

TEST_F(HostileSession, PathsThatAreNoCloudsAreRefusedAndNotWaitedFor) {
    ASSERT_EQ(::mkfifo((folder_ / "work/pipe").c_str(), 0600), 0);
    const std::string too_long(300, 'n');
    for (const std::string& path :
         std::vector<std::string>{"pipe", "/dev/zero", "/dev/stdin", ".", "../..", "/proc/self/mem",
                                  "a\\u0000b", "s.knead", "no\\nsuch", too_long}) {
        write_text(folder_ / "work/s.knead", "{\"knead\":1,\"cloud\":{\"path\":\"" + path + "\"}}\n");
        const Outcome outcome = replay();
        EXPECT_EQ(outcome.code, 3) << path;
        session(ends + drag(lift) + R"({"op":"check","positions":")" + path + "\",\"tolerance\":1}\n");
        EXPECT_EQ(replay({"--out", "out.ply"}).code, 3) << path;
        EXPECT_FALSE(fs::exists(folder_ / "work/out.ply"));
    }
}

TEST_F(HostileSession, PointsNamedManyTimesTakeMemoryOnce) {
    constexpr std::size_t points = 20'000, times = 100'000; // 8 GB, each time for itself
    const std::string megabytes = in_child([&] {
        const PointCloud cloud = bar(points);
        HandleLine line{"a", HandleRole::fixed, std::vector<IndexRange>(times, {0, points - 1})};
        rusage before{}, after{};
        ::getrusage(RUSAGE_SELF, &before);
        const std::vector<Index> found = resolve_points(line, cloud, {}, "s:2");
        ::getrusage(RUSAGE_SELF, &after);
        return std::to_string(found.size()) + " points, " +
               ((after.ru_maxrss - before.ru_maxrss) / 1024 < 64 ? "little" : "much") + " memory";
    });
    EXPECT_EQ(megabytes, "20000 points, little memory");
}

// What the document remembers grows with the acts, and not with the acts times the handles: that would be a
// gigabyte for the declarations, and two for the drags.
TEST_F(HostileSession, ThousandsOfHandlesTakeMemoryOnceAndNotOnceAnAct) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers keep freed memory, so what is held cannot be told";
#endif
    constexpr int count = 3000;
    const std::string outcome = in_child([&]() -> std::string {
        Desk desk(bar(3000), {}, 1, "reference", Document::Mode::rehearsal);
        const auto handle = [](int i) {
            return "a handle of the hostile session, number " + std::to_string(i);
        };
        rusage before{}, after{};
        ::getrusage(RUSAGE_SELF, &before);
        SilentProgress silent;
        Document& document = desk.document();
        for (Index i = 0; i < count; ++i)
            document.declare({handle(i), HandleRole::moving, std::vector<IndexRange>{{i, i}}}, "s:2");
        for (int i = 0; i < count; ++i)
            document.drag({handle(i), {}, {HandlePose{.translate = Vec3d(1, i, 0)}}}, "s:3", silent);
        for (int i = 0; i < count; ++i) document.undo("s:4");
        for (int i = 0; i < count; ++i) document.redo("s:5");
        ::getrusage(RUSAGE_SELF, &after);
        const long megabytes = (after.ru_maxrss - before.ru_maxrss) / 1024;
        if (document.motions().back().offset != Vec3d(1, count - 1, 0)) return "other motions";
        return megabytes < 32 ? "little" : std::to_string(megabytes) + " MB";
    });
    EXPECT_EQ(outcome, "little");
}

TEST_F(HostileSession, NamesDoNotCommandTheTerminal) {
    const std::string words =
        refused_with(ends + R"({"op":"delete","handle":"\u001b]0;owned\u0007\u009b31m\r\u007f"})"
                            "\n");
    EXPECT_SAYS(words, "owned");
    for (const char c : words) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20) << int(c);
    EXPECT_EQ(words.find("\xC2\x9B"), std::string::npos);
    EXPECT_EQ(words.find('\x7F'), std::string::npos);
}

} // namespace
} // namespace knead::test
