// The program's command line before any subcommand.

#include "support/run_knead.h"
#include "support/scans.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include <sys/wait.h>

namespace knead::test {
namespace {

TEST(CommandLine, SaysThatAFileIsMissing) {
    const Outcome outcome = run_knead({"no-such-scan.ply"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("no-such-scan.ply"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("subcommand is required"), std::string::npos) << outcome.err;
}

TEST(CommandLine, IsTheEditorsWhereItBeginsWithAnOption) {
    const Outcome outcome = run_knead({"--threads", "none", "no-such-scan.ply"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("--threads"), std::string::npos) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("knead: ")) << outcome.err;
}

TEST(CommandLine, AnOptionWithNothingBehindItsEqualsSignTakesNoOther) {
    const Outcome outcome = run_knead({"replay", "--out=", "--json", "no-such-session.knead"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "knead: --out: must not be empty\n");
}

TEST(CommandLine, SaysThatNobodyCouldReadWhatItSaid) {
    const ScratchFolder folder;
    for (const std::string asked : {"devices", "--help", "--version"}) {
        const std::string command =
            knead_binary().string() + ' ' + asked + " > /dev/full 2> " + (folder / "err").string();
        const int status = std::system(command.c_str()); // NOLINT(concurrency-mt-unsafe)
        ASSERT_TRUE(WIFEXITED(status));
        EXPECT_EQ(WEXITSTATUS(status), 5) << asked;
        const std::string said = read_text(folder / "err"); // where there is no device, of that before
        EXPECT_TRUE(said.ends_with("knead: standard output: cannot be written\n")) << asked << ": " << said;
    }
}

TEST(CommandLine, EveryOptionIsInTheManualPage) {
    const std::string page = read_text(in_repository("data/knead.1"));
    const std::string help = run_knead({"--help-all"}).out;
    std::size_t count = 0;
    for (std::size_t at = help.find("  --"); at != std::string::npos; at = help.find("  --", at + 1)) {
        const std::size_t begin = at + 3, end = help.find_first_of(" ,:\n", begin);
        const std::string option = help.substr(begin, end - begin); // "-json"
        EXPECT_NE(page.find("Fl " + option), std::string::npos) << '-' << option;
        ++count;
    }
    EXPECT_GT(count, 40U);
}

} // namespace
} // namespace knead::test
