#include "support/run_knead.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace knead::test {
namespace {

const std::string header = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
                           "property float z\nproperty list uchar int seen\nproperty uchar red\nend_header\n";
// Point 1 equals point 0, where zero has two signs; point 4 is not finite.
const std::string rows = "0 0 0 0 1\n-0 0 0 2 5 6 1\n3 0 0 0 1\n3 4 0 0 1\nnan 0 0 0 1\n";

TEST(Info, tells_what_is_in_a_cloud) {
    const ScratchFolder folder;
    write_text(folder / "cloud.ply", header + rows);
    const Outcome outcome = run_knead({"info", "cloud.ply", "--json"}, folder.path());
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["points"], 5);
    EXPECT_EQ(json["finite"], 4);
    EXPECT_EQ(json["duplicates"], 1);
    EXPECT_EQ(json["diagonal"], 5.0);
    EXPECT_EQ(json["bounds"]["min"], (std::vector<double>{0, 0, 0}));
    EXPECT_EQ(json["bounds"]["max"], (std::vector<double>{3, 4, 0}));
    EXPECT_EQ(json["format"], "ply");
    EXPECT_EQ(json["encoding"], "ascii");
    ASSERT_EQ(json["attributes"].size(), 5U);
    EXPECT_EQ(json["attributes"][3]["name"], "seen");
    EXPECT_EQ(json["attributes"][3]["type"], "int32");
    EXPECT_EQ(json["attributes"][3]["list"], true);
    EXPECT_EQ(json["attributes"][4]["list"], false);
    EXPECT_EQ(json["remarks"].size(), 1U);
}

// Two rows of points side by side, seven steps apart: two parts, and one body.
TEST(Info, tells_what_bridging_would_join) {
    const ScratchFolder folder;
    std::string text = "ply\nformat ascii 1.0\nelement vertex 80\nproperty float x\nproperty float y\n"
                       "property float z\nend_header\n";
    for (int i = 0; i < 80; ++i) text += std::to_string(i % 40) + (i < 40 ? " 0 0\n" : " 7 0\n");
    write_text(folder / "rows.ply", text);
    const Outcome outcome = run_knead({"info", "rows.ply", "--json"}, folder.path());
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["components"], 2);
    EXPECT_EQ(json["largest_component"], 40);
    EXPECT_EQ(json["bridged"]["components"], 1);
    EXPECT_EQ(json["bridged"]["largest_component"], 80);
    EXPECT_EQ(json["bridged"]["outliers"], 0);
}

TEST(Info, prints_a_table_for_people) {
    const ScratchFolder folder;
    write_text(folder / "cloud.ply", header + rows);
    const Outcome outcome = run_knead({"info", "cloud.ply"}, folder.path());
    EXPECT_EQ(outcome.code, 0);
    for (const char* words : {"points      5\n", "duplicates  1\n", "diagonal    5\n", "seen  int32 list\n"})
        EXPECT_NE(outcome.out.find(words), std::string::npos) << outcome.out;
}

TEST(Info, takes_points_that_are_not_finite_for_no_duplicates) {
    const ScratchFolder folder;
    write_text(folder / "cloud.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                                     "property float y\nproperty float z\nend_header\n"
                                     "inf 0 0\ninf 0 0\n1 0 0\n1 0 0\n");
    const Outcome outcome = run_knead({"info", "cloud.ply", "--json"}, folder.path());
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(outcome.out)["duplicates"], 1);
}

TEST(Info, takes_a_cloud_of_no_points) {
    const ScratchFolder folder;
    write_text(folder / "cloud.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\n"
                                     "property float y\nproperty float z\nend_header\n");
    EXPECT_EQ(run_knead({"info", "cloud.ply"}, folder.path()).code, 0);
    EXPECT_EQ(run_knead({"info", "cloud.ply", "--json"}, folder.path()).code, 0);
}

TEST(Info, shows_names_in_any_encoding) {
    const ScratchFolder folder;
    write_text(folder / "cloud.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                                     "property float y\nproperty float z\nproperty float h\xF6he\n"
                                     "end_header\n1 2 3 4\n");
    const Outcome outcome = run_knead({"info", "cloud.ply", "--json"}, folder.path());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(outcome.out)["attributes"].size(), 4U);
}

TEST(Info, refuses_with_one_line_and_an_empty_stdout) {
    const ScratchFolder folder;
    write_text(folder / "bad.ply", header + "1 2\n");
    for (const char* file : {"bad.ply", "missing.ply", "."}) {
        const Outcome outcome = run_knead({"info", file}, folder.path());
        EXPECT_EQ(outcome.code, 3);
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
    EXPECT_EQ(run_knead({"info"}, folder.path()).code, 2);
}

} // namespace
} // namespace knead::test
