#include "base/progress.h"
#include "io/cloud_file.h"
#include "support/run_knead.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

namespace knead::test {

namespace {

Outcome make(const ScratchFolder& folder, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "make");
    return run_knead(arguments, folder.path());
}

} // namespace

TEST(Make, WritesEveryShape) {
    const ScratchFolder folder;
    for (const char* shape :
         {"plane", "bar", "cylinder", "sphere", "torus", "solid-bar", "knot", "creature"}) {
        const Outcome outcome = make(folder, {shape, "--points", "321", "--out", "cloud.ply"});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find("321 points"), std::string::npos) << outcome.err;
        SilentProgress progress;
        EXPECT_EQ(read_cloud(folder / "cloud.ply", progress).size(), 321U) << shape;
    }
}

TEST(Make, WritesTheSameBytesAgain) {
    const ScratchFolder folder;
    const std::vector<std::string> arguments{"torus", "--points", "2000", "--noise",    "0.2", "--outliers",
                                             "0.01",  "--seed",   "7",    "--gradient", "3",   "--out"};
    const auto with_out = [&](const char* out) {
        std::vector<std::string> all = arguments;
        all.emplace_back(out);
        return all;
    };
    ASSERT_EQ(make(folder, with_out("a.ply")).code, 0);
    ASSERT_EQ(make(folder, with_out("b.ply")).code, 0);
    EXPECT_EQ(read_text(folder / "a.ply"), read_text(folder / "b.ply"));
    EXPECT_FALSE(read_text(folder / "a.ply").empty());
}

TEST(Make, RefusesWithWordsAndLeavesNothing) {
    const ScratchFolder folder;
    const auto refused = [&](const std::vector<std::string>& arguments, const char* word) {
        const Outcome outcome = make(folder, arguments);
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
        EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    };
    refused({"teapot", "--points", "10", "--out", "a.ply"}, "solid-bar");
    refused({"plane", "--points", "0", "--out", "a.ply"}, "--points");
    refused({"plane", "--points", "-3", "--out", "a.ply"}, "--points");
    refused({"plane", "--points", "many", "--out", "a.ply"}, "--points");
    refused({"plane", "--out", "a.ply"}, "--points");
    refused({"plane", "--points", "10"}, "--out");
    refused({"plane", "--points", "10", "--out", "a.ply", "--gradient", "0.5"}, "--gradient");
    refused({"plane", "--points", "10", "--out", "a.ply", "--noise", "-1"}, "--noise");
    refused({"plane", "--points", "10", "--out", "a.ply", "--seed", "-1"}, "--seed");
    refused({"plane", "--points", "10", "--out", "a.ply", "--outliers", "1"}, "--outliers");
}

TEST(Make, SaysWhenItCannotWrite) {
    const ScratchFolder folder;
    EXPECT_EQ(make(folder, {"plane", "--points", "10", "--out", "nowhere/a.ply"}).code, 5);
}

} // namespace knead::test
