// knead replay: its exit codes, its JSON, and what it leaves behind.

#include "support/run_knead.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <set>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace knead::test {
namespace {

using nlohmann::json;

const std::string foot =
    R"({"op":"handle","name":"foot","role":"fixed","region":{"halfspace":{"point":[0,0,-2],"normal":[0,0,-1]}}})"
    "\n";
const std::string top =
    R"({"op":"handle","name":"top","role":"moving","region":{"halfspace":{"point":[0,0,2],"normal":[0,0,1]}}})"
    "\n";
const std::string lift =
    R"({"op":"drag","handle":"top","pivot":[0,0,2],"frames":[{},{"translate":[1,0,0.5]}]})"
    "\n";
const std::string settle = "{\"op\":\"settle\",\"iterations\":9}\n";
const std::string commit = "{\"op\":\"commit\"}\n";
const std::string edit = foot + top + lift + settle;

// A folder with a bar of 800 points and a session on it, whose lines begin at line 2.
class Replay : public testing::Test {
protected:
    static constexpr const char* points = "800";

    static void SetUpTestSuite() {
        made() = std::make_unique<ScratchFolder>();
        const Outcome outcome =
            run_knead({"make", "bar", "--points", points, "--out", (*made() / "bar.ply").string()});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
    }
    static void TearDownTestSuite() { made().reset(); }

    void SetUp() override { std::filesystem::copy_file(*made() / "bar.ply", folder / "bar.ply"); }

    void session(const std::string& lines, const std::string& cloud = R"("path":"bar.ply")") {
        write_text(folder / "s.knead", R"({"knead":1,"cloud":{)" + cloud + "}}\n" + lines);
    }

    Outcome replay(std::vector<std::string> arguments = {}) {
        arguments.insert(arguments.begin(), {"replay", "s.knead"});
        return run_knead(arguments, folder.path());
    }

    std::set<std::string> files() const {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
            names.insert(entry.path().filename().string());
        return names;
    }

    // A failure: this code, nothing on stdout, words on stderr, and no new file.
    void expect_failure(int code, const std::string& words, std::vector<std::string> arguments = {}) {
        const std::set<std::string> before = files();
        if (std::ranges::find(arguments, "--out") == arguments.end())
            arguments.insert(arguments.end(), {"--out", "out.ply"});
        const Outcome outcome = replay(arguments);
        EXPECT_EQ(outcome.code, code) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
        EXPECT_EQ(files(), before);
    }

    const ScratchFolder folder;

private:
    static std::unique_ptr<ScratchFolder>& made() {
        static std::unique_ptr<ScratchFolder> one;
        return one;
    }
};

// --- What comes out

TEST_F(Replay, SavesTheShapeAndSaysWhatItDid) {
    session(edit);
    const Outcome outcome = replay({"--out", "out.ply"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("out.ply"), std::string::npos);
    EXPECT_EQ(std::filesystem::file_size(folder / "out.ply"), std::filesystem::file_size(folder / "bar.ply"));
    const Outcome diff = run_knead({"diff", "bar.ply", "out.ply", "--json"}, folder.path());
    const double largest = json::parse(diff.out)["largest"];
    EXPECT_GT(largest, 0.2);
    EXPECT_EQ(files(), (std::set<std::string>{"bar.ply", "out.ply", "s.knead"}));
}

TEST_F(Replay, PrintsOneJsonObjectWithEveryKey) {
    session(edit + commit + lift);
    // The reference: "auto" has a warning where there is no device.
    const Outcome outcome = replay({"--json", "--out", "out.ply", "--threads", "2", "--device", "reference"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json all = json::parse(outcome.out);
    EXPECT_EQ(all["cloud"]["points"], 800);
    EXPECT_EQ(all["cloud"]["components"], 1);
    EXPECT_EQ(all["cloud"]["strays"], 0);
    EXPECT_EQ(all["samples"], 800);
    EXPECT_EQ(all["frames"], 4);
    EXPECT_EQ(all["iterations"], 4 * 3 + 9);
    EXPECT_EQ(all["threads"], 2);
    EXPECT_TRUE(all["device"].is_string());
    EXPECT_GT(all["peak_rss_bytes"].get<std::uint64_t>(), 1'000'000U);
    EXPECT_LT(all["handle_error"].get<double>(), 1e-5);
    EXPECT_EQ(all["checks"], json::array());
    EXPECT_EQ(all["warnings"], json::array());
    std::set<std::string> stages;
    for (const auto& [key, value] : all["seconds"].items()) {
        stages.insert(key);
        EXPECT_TRUE(value.is_number()) << key;
        EXPECT_GE(value.get<double>(), 0) << key;
    }
    EXPECT_EQ(stages, (std::set<std::string>{"read", "order", "neighbors", "sampling", "geodesic",
                                             "factorize", "solve", "upsample", "device", "write", "total"}));
    for (const char* key : {"read", "order", "neighbors", "factorize", "solve", "upsample", "write", "total"})
        EXPECT_GT(all["seconds"][key].get<double>(), 0) << key;
}

TEST_F(Replay, StagesThatDidNotRunAreZero) {
    session(foot);
    const Outcome outcome = replay({"--json", "--out", "out.ply"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json all = json::parse(outcome.out);
    for (const char* key : {"order", "neighbors", "sampling", "geodesic", "factorize", "solve", "upsample"})
        EXPECT_EQ(all["seconds"][key], 0) << key;
    for (const char* key : {"samples", "frames", "iterations"}) EXPECT_EQ(all[key], 0) << key;
    EXPECT_GT(all["seconds"]["write"].get<double>(), 0);
    EXPECT_EQ(read_text(folder / "out.ply"), read_text(folder / "bar.ply"));
    EXPECT_EQ(json::parse(replay({"--json"}).out)["seconds"]["write"], 0);
}

TEST_F(Replay, TakesSamplesAndSettingsFromTheCommandLine) {
    session(R"({"op":"set","samples":50,"iterations":1})"
            "\n" +
            foot + top + lift +
            R"({"op":"set","iterations":9})"
            "\n" +
            lift);
    const auto samples_of = [&](const std::vector<std::string>& arguments) -> json {
        std::vector<std::string> all = arguments;
        all.push_back("--json");
        const Outcome outcome = replay(all);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return json::parse(outcome.out);
    };
    EXPECT_LE(samples_of({})["samples"], 60);
    EXPECT_EQ(samples_of({"--samples", "all"})["samples"], 800);
    EXPECT_EQ(samples_of({"--set", "samples=all"})["samples"], 800);
    const json hundred = samples_of({"--samples", "100", "--set", "iterations=2"});
    EXPECT_GE(hundred["samples"], 100);
    EXPECT_LE(hundred["samples"], 120);
    EXPECT_EQ(hundred["iterations"], 8);
}

TEST_F(Replay, ADryRunComputesAndWritesNothing) {
    session(edit);
    const Outcome outcome = replay({"--dry-run", "--out", "out.ply", "--frames", "frames"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("so not used: --out, --frames"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(std::filesystem::exists(folder / "out.ply"));
    session(edit + foot);
    expect_failure(3, "s.knead:6: ", {"--dry-run"});
}

// --- Exit code 2

TEST_F(Replay, RefusesWrongArgumentsWithTwo) {
    session(edit);
    expect_failure(2, "nosuchdevice", {"--device", "nosuchdevice"});
    expect_failure(2, "", {"--device", "99"});
    expect_failure(2, "samples", {"--samples", "none"});
    expect_failure(2, "stifness", {"--set", "stifness=1"});
    expect_failure(2, "stiffness", {"--set", "stiffness=-1"});
    expect_failure(2, "", {"--threads", "0"});
    expect_failure(2, "", {"--no-such-option"});
    for (const char* option : {"--out", "--cloud", "--samples", "--set", "--device", "--picture", "--frames"})
        expect_failure(2, option, {option, ""});      // as a script has it whose variable is not set
    expect_failure(2, "--view", {"--view", "front"}); // no picture is asked for
    EXPECT_EQ(run_knead({"replay"}).code, 2);
    EXPECT_EQ(run_knead({}).code, 2);
    EXPECT_EQ(run_knead({"--help"}).code, 0);
}

// --- Exit code 3

TEST_F(Replay, TellsMistakesOfASessionByFileAndLine) {
    const std::pair<std::string, std::string> mistakes[] = {
        {edit + "{\"op\":\"settle\"}\n", "s.knead:6: "},
        {edit + "{\"op\":\"settle\",\"iterations\":-1}\n", "\"iterations\""},
        {edit + "{\"op\":\"explode\"}\n", "s.knead:6: "},
        {foot + lift, "s.knead:3: \"handle\""},
        {foot + "{\"op\":\"undo\"}\n{\"op\":\"undo\"}\n", "s.knead:4: there is nothing to undo"},
        {edit + top, "s.knead:6: "},
        {edit + R"({"op":"set","samples":7})"
                "\n",
         "\"samples\""},
        {R"({"op":"handle","name":"a","role":"fixed","points":[800]})"
         "\n",
         "s.knead:2: \"points\""},
        {foot + "not json\n", "s.knead:3: "},
        {foot + R"({"op":"settle")", "s.knead:3: "},
        {foot + R"({"op":"check","positions":"no.ply","tolerance":1})"
                "\n",
         "no.ply"}};
    for (const auto& [lines, words] : mistakes) {
        session(lines);
        expect_failure(3, words);
    }
}

TEST_F(Replay, RefusesCloudsThatAreNotTheRecordedOne) {
    session(edit, R"("path":"bar.ply","points":799)");
    expect_failure(3, "s.knead:1: \"cloud.points\"");
    expect_failure(3, "799", {"--cloud", "bar.ply"}); // another cloud must have as many points, too
    session(edit, R"("path":"bar.ply","points":800,"sha256":")" + std::string(64, '0') + "\"");
    expect_failure(3, "s.knead:1: \"cloud.sha256\"");
    expect_failure(3, "say with --cloud which file to use");
    EXPECT_EQ(replay({"--cloud", "bar.ply"}).code, 0);
    session(edit, R"("path":"missing.ply")");
    expect_failure(3, "missing.ply; say with --cloud which file to use");
    expect_failure(3, "`knead replay` runs it", {"--cloud", "s.knead"});
    EXPECT_EQ(replay({"--cloud", "bar.ply"}).code, 0);
    write_text(folder / "broken.ply", "ply\nformat ascii 1.0\nelement vertex 2\n");
    expect_failure(3, "broken.ply", {"--cloud", "broken.ply"});
    write_text(folder / "empty.ply",
               "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
               "property float z\nend_header\nnan nan nan\n");
    expect_failure(3, "empty.ply", {"--cloud", "empty.ply"});
    EXPECT_EQ(run_knead({"replay", "nowhere.knead"}, folder.path()).code, 3);
}

TEST_F(Replay, RefusesSettingsOutOfRangeOnTheCommandLineToo) {
    session(edit);
    expect_failure(2, "poisson", {"--set", "poisson=0.5"});
}

// As a service is started. A kernel is built anew then, for which PoCL runs the linker. What the tests
// themselves are run with stays: a sanitizer's options, and that there is to be no device.
TEST_F(Replay, RunsWithNoEnvironmentAtAll) {
    session(edit);
    std::string command =
        "cd " + folder.path().string() + " && env -i HOME=" + folder.path().string() + "/home";
    for (const char* const kept :
         {"ASAN_OPTIONS", "LSAN_OPTIONS", "TSAN_OPTIONS", "UBSAN_OPTIONS", "OCL_ICD_VENDORS"})
        command += " ${" + std::string(kept) + "+\"" + kept + "=$" + kept + "\"}";
    command += " " + knead_binary().string() + " replay s.knead --out out.ply 2> err";
    std::filesystem::create_directory(folder / "home");
    const int status = std::system(command.c_str()); // NOLINT(concurrency-mt-unsafe)
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0) << read_text(folder / "err");
    EXPECT_TRUE(std::filesystem::exists(folder / "out.ply"));
}

// --- Checks and exit code 4

TEST_F(Replay, RecordsChecksThatHoldAndRecordingAgainChangesNothing) {
    session(edit + commit + lift + settle + "{\"op\":\"undo\"}");
    ASSERT_EQ(replay({"--record-checks"}).code, 0);
    const std::string recorded = read_text(folder / "s.knead");
    const std::string first = read_text(folder / "s-check-1.ply");
    EXPECT_TRUE(std::filesystem::exists(folder / "s-check-2.ply"));
    EXPECT_EQ(std::ranges::count(recorded, '\n'), 1 + 4 + 1 + 1 + 3 + 1);
    for (const char* device : {"auto", "reference"}) {
        const Outcome outcome = replay({"--json", "--device", device});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        const json checks = json::parse(outcome.out)["checks"];
        ASSERT_EQ(checks.size(), 2U);
        EXPECT_EQ(checks[0]["line"], 6);
        for (const json& check : checks) {
            EXPECT_TRUE(check["held"]);
            EXPECT_LT(check["distance"].get<double>(), 1e-6);
        }
    }
    ASSERT_EQ(replay({"--record-checks"}).code, 0);
    EXPECT_EQ(read_text(folder / "s.knead"), recorded);
    EXPECT_EQ(read_text(folder / "s-check-1.ply"), first);
    EXPECT_EQ(files(), (std::set<std::string>{"bar.ply", "s-check-1.ply", "s-check-2.ply", "s.knead"}));
}

TEST_F(Replay, RecordsNoCheckWhereNothingMoved) {
    session(foot + top + settle + "{\"op\":\"undo\"}\n{\"op\":\"undo\"}\n{\"op\":\"redo\"}\n" + settle);
    const std::string before = read_text(folder / "s.knead");
    ASSERT_EQ(replay({"--record-checks"}).code, 0);
    EXPECT_EQ(read_text(folder / "s.knead"), before);
}

TEST_F(Replay, RecordsAgainWithTheToleranceThatACheckHas) {
    session(edit);
    ASSERT_EQ(replay({"--record-checks"}).code, 0);
    std::string recorded = read_text(folder / "s.knead");
    const std::string usual = "\"tolerance\":1e-04";
    ASSERT_NE(recorded.find(usual), std::string::npos) << recorded;
    recorded.replace(recorded.find(usual), usual.size(), "\"tolerance\":0.02");
    write_text(folder / "s.knead", recorded);
    ASSERT_EQ(replay({"--record-checks"}).code, 0);
    EXPECT_EQ(read_text(folder / "s.knead"), recorded);
}

TEST_F(Replay, RecordsOverNoCloudAndNoShapeThatHasACheckSName) {
    session(edit);
    std::filesystem::copy_file(folder / "bar.ply", folder / "s-check-1.ply");
    const std::string cloud = read_text(folder / "s-check-1.ply");
    const Outcome over = replay({"--record-checks", "--cloud", "s-check-1.ply"});
    EXPECT_EQ(over.code, 5);
    EXPECT_NE(over.err.find("s-check-1.ply: is the cloud"), std::string::npos) << over.err;
    EXPECT_EQ(read_text(folder / "s-check-1.ply"), cloud);
    EXPECT_EQ(replay({"--record-checks", "--out", "s-check-7.ply"}).code, 5);
    EXPECT_EQ(files(), (std::set<std::string>{"bar.ply", "s-check-1.ply", "s.knead"}));
    std::filesystem::remove(folder / "s-check-1.ply");
    EXPECT_EQ(replay({"--record-checks", "--out", "s-check.ply"}).code, 0);
}

TEST_F(Replay, RecordsOverNoFileThatIsNoCheckOfTheSession) {
    session(edit);
    write_text(folder / "s-check-1.ply", "of another session of that name");
    const std::string before = read_text(folder / "s.knead");
    const Outcome refused = replay({"--record-checks"});
    EXPECT_EQ(refused.code, 5);
    EXPECT_NE(refused.err.find("s-check-1.ply: is there already"), std::string::npos) << refused.err;
    EXPECT_EQ(read_text(folder / "s-check-1.ply"), "of another session of that name");
    EXPECT_EQ(read_text(folder / "s.knead"), before);
}

TEST_F(Replay, RecordingWithOtherSettingsThanTheSessionHasSaysSo) {
    session(edit);
    EXPECT_EQ(replay({"--record-checks"}).err.find("other settings"), std::string::npos);
    const Outcome outcome = replay({"--record-checks", "--set", "poisson=0.4"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.err.find("other settings"), std::string::npos) << outcome.err;
    EXPECT_NE(replay({"--record-checks", "--samples", "all"}).err.find("other settings"), std::string::npos);
}

TEST_F(Replay, RecordingWithAnotherCloudThanTheSessionHasSaysSo) {
    session(edit);
    std::filesystem::copy_file(folder / "bar.ply", folder / "other.ply");
    const Outcome outcome = replay({"--record-checks", "--cloud", "other.ply", "--json"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.err.find("the cloud of --cloud"), std::string::npos) << outcome.err;
    const auto warnings = json::parse(outcome.out)["warnings"].get<std::vector<std::string>>();
    EXPECT_EQ(std::ranges::count_if(warnings,
                                    [](const std::string& warning) {
                                        return warning.find("the cloud of --cloud") != std::string::npos;
                                    }),
              1);
}

TEST_F(Replay, RecordingLeavesChecksThatItDidNotRecord) {
    session(edit + R"({"op":"check","positions":"s-check-by-hand.ply","tolerance":1e-9})"
                   "\n");
    std::filesystem::copy_file(folder / "bar.ply", folder / "s-check-by-hand.ply");
    const Outcome outcome = replay({"--record-checks", "--json"});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_EQ(json::parse(outcome.out)["checks"].size(), 1U);
    EXPECT_NE(read_text(folder / "s.knead").find("s-check-by-hand.ply"), std::string::npos);
    EXPECT_NE(read_text(folder / "s.knead").find("s-check-1.ply"), std::string::npos);
}

TEST_F(Replay, AFailedCheckStillWritesAndExitsWithFour) {
    session(edit +
            R"({"op":"check","positions":"bar.ply","tolerance":1e-4})"
            "\n" +
            R"({"op":"check","positions":"bar.ply","tolerance":9})"
            "\n");
    const Outcome outcome = replay({"--json", "--out", "out.ply"});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_NE(outcome.err.find("s.knead:6: "), std::string::npos) << outcome.err;
    const json checks = json::parse(outcome.out)["checks"];
    ASSERT_EQ(checks.size(), 2U);
    EXPECT_FALSE(checks[0]["held"]);
    EXPECT_GT(checks[0]["distance"].get<double>(), 0.1);
    EXPECT_TRUE(checks[1]["held"]);
    EXPECT_TRUE(std::filesystem::exists(folder / "out.ply"));
}

TEST_F(Replay, ACheckOfAnotherCountOfPointsFails) {
    write_text(folder / "two.ply",
               "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
               "property float z\nend_header\n0 0 0\n1 1 1\n");
    session(edit + R"({"op":"check","positions":"two.ply","tolerance":9})"
                   "\n");
    const Outcome outcome = replay({"--json"});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_FALSE(json::parse(outcome.out)["checks"][0]["held"]);
    EXPECT_TRUE(json::parse(outcome.out)["checks"][0]["distance"].is_null());
}

// --- Exit codes 5 and 130

TEST_F(Replay, TellsWhereItCannotWrite) {
    session(edit);
    expect_failure(5, "missing", {"--out", "missing/out.ply"});
    expect_failure(5, ".stl", {"--out", "out.stl"});
    std::filesystem::create_directory(folder / "taken.ply");
    expect_failure(5, "taken.ply", {"--out", "taken.ply"});
}

// Whether a process handles SIGINT, or is gone.
bool catches_interrupts(pid_t process) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("State:") && line.find('Z') != std::string::npos) return true;
        if (line.starts_with("SigCgt:"))
            return (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1U) != 0;
    }
    return true;
}

TEST_F(Replay, InterruptedItLeavesNothing) {
    std::string frames;
    for (int i = 0; i < 20000; ++i)
        frames += std::string(i > 0 ? "," : "") + R"({"translate":[)" + std::to_string(i % 7) + ",0,0]}";
    session(foot + top + R"({"op":"drag","handle":"top","pivot":[0,0,0],"frames":[)" + frames + "]}\n");
    const std::set<std::string> before = files();
    const std::string binary = knead_binary().string();
    const std::string out = (folder / "out.ply").string();
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        const int nowhere = ::open("/dev/null", O_WRONLY);
        ::dup2(nowhere, STDOUT_FILENO);
        ::dup2(nowhere, STDERR_FILENO);
        if (::chdir(folder.path().c_str()) != 0) ::_exit(127);
        ::execl(binary.c_str(), "knead", "replay", "s.knead", "--out", out.c_str(), "--record-checks",
                "--json", nullptr);
        ::_exit(127);
    }
    while (!catches_interrupts(child)) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(400)); // into the frames, which take much longer
    ASSERT_EQ(::kill(child, SIGINT), 0);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 130);
    EXPECT_EQ(files(), before);
}

// --- The same everywhere

TEST_F(Replay, WritesTheSameBytesForAnyNumberOfThreads) {
    session(edit + commit + lift);
    std::set<std::string> results;
    for (const char* threads : {"1", "2", "3", "2"}) {
        ASSERT_EQ(replay({"--out", "out.ply", "--threads", threads}).code, 0);
        results.insert(read_text(folder / "out.ply"));
    }
    EXPECT_EQ(results.size(), 1U);
}

TEST_F(Replay, ReadsPathsFromTheSessionsFolderAndWritesToTheWorkingOne) {
    session(edit);
    std::filesystem::create_directory(folder / "elsewhere");
    const Outcome outcome = run_knead({"replay", "../s.knead", "--out", "out.ply"}, folder / "elsewhere");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "elsewhere" / "out.ply"));
}

// Names may hold anything: as JSON they come back as they are, and no raw byte of them reaches a terminal.
TEST_F(Replay, JsonAltersNoNameAndIsAscii) {
    write_text(folder / "c.ply",
               "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
               "property float z\nproperty int label\nend_header\n0 0 0 1\n");
    session("", R"("path":"c.ply")");
    const std::string name = "odd\x7F\xC2\x9B"
                             "31m\xC3\xA9";
    const Outcome outcome = replay({"--json", "--device", "reference", "--out", name + ".off"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(json::parse(outcome.out)["warnings"].at(0).get<std::string>().rfind(name + ".off: ", 0), 0U);
    for (const char c : outcome.out) EXPECT_TRUE(c == '\n' || (c >= 0x20 && c < 0x7F)) << int(c);
    EXPECT_NE(outcome.err.find("odd??31m\xC3\xA9.off: "), std::string::npos) << outcome.err;
    const Outcome no_utf8 = replay({"--json", "--device", "reference", "--out", "\xFF.off"});
    EXPECT_EQ(json::parse(no_utf8.out)["warnings"].size(), 1U);
}

TEST(CommandLine, RefusesAFirstWordThatIsNoPossibleFile) {
    const Outcome outcome = run_knead({std::string(300, 'n')});
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(outcome.out, "");
}

} // namespace
} // namespace knead::test
