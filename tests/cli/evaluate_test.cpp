// knead evaluate as a program: what it refuses before it computes.

#include "support/run_knead.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

namespace {

using namespace knead::test;

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

} // namespace
