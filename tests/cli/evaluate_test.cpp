// knead evaluate as a program: what it prints, and what it refuses before it computes.

#include "support/run_knead.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {

using namespace knead::test;
using nlohmann::json;

TEST(Evaluate, RefusesAShapeThatIsNotThere) {
    const Outcome run = run_knead({"evaluate", "--shape", "teapot"});
    EXPECT_EQ(run.code, 2);
    EXPECT_TRUE(run.out.empty());
    EXPECT_NE(run.err.find("stiffness"), std::string::npos) << run.err; // what there is
}

TEST(Evaluate, RefusesAPageThatIsAFile) {
    const ScratchFolder folder;
    write_text(folder / "page", "a file");
    const Outcome run = run_knead({"evaluate", "--shape", "page", "--page", (folder / "page").string()});
    // 5: cannot write; 2: this build or machine draws no pictures, which is found first.
    EXPECT_TRUE(run.code == 5 || run.code == 2) << run.code << run.err;
    EXPECT_TRUE(run.out.empty());
}

TEST(Evaluate, PrintsALikenessWithoutSurveyAndScans) {
    const ScratchFolder empty;
    const std::string folder = empty.path().string();
    const Outcome outcome =
        run_knead({"evaluate", "--json", "--survey", folder, "--scans", folder, "--shape", "made-cylinder"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json told = json::parse(outcome.out);
    EXPECT_EQ(told.at("survey"), false);
    ASSERT_EQ(told.at("tasks").size(), 1U);
    EXPECT_EQ(told.at("tasks").at(0).at("name"), "made-cylinder");
}

TEST(Evaluate, RefusesWrongUsage) {
    EXPECT_EQ(run_knead({"evaluate", "--survey", "/nonexistent"}).code, 2);
    EXPECT_EQ(run_knead({"evaluate", "bar"}).code, 2);
}

} // namespace
