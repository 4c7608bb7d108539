// The program's command line before any subcommand.

#include "support/run_knead.h"

#include <gtest/gtest.h>

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

} // namespace
} // namespace knead::test
