#include "support/run_knead.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace knead::test {
namespace {

std::string cloud(const std::string& points, const std::string& extra, const std::string& rows) {
    return "ply\nformat ascii 1.0\nelement vertex " + points + "\nproperty float x\nproperty float y\n" +
           "property float z\n" + extra + "end_header\n" + rows;
}

TEST(Diff, measures_in_diagonals_of_the_first_cloud) {
    const ScratchFolder folder;
    write_text(folder / "a.ply", cloud("3", "property uchar red\nproperty uchar mine\n",
                                       "0 0 0 1 1\n6 8 0 1 1\nnan 0 0 1 1\n"));
    write_text(folder / "b.ply",
               cloud("3", "property uchar red\nproperty uchar other\n", "0 0 1 1 1\n6 8 0 2 1\n0 0 0 1 1\n"));
    const Outcome outcome = run_knead({"diff", "a.ply", "b.ply", "--json"}, folder.path());
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["points"], 3);
    EXPECT_EQ(json["diagonal"], 10.0);
    EXPECT_DOUBLE_EQ(json["largest"].get<double>(), 0.1);
    EXPECT_EQ(json["largest_index"], 0);
    EXPECT_DOUBLE_EQ(json["rms"].get<double>(), 0.1 / std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(json["p95"].get<double>(), 0.1);
    EXPECT_EQ(json["incomparable"], 1);
    EXPECT_EQ(json["attributes_differ"], std::vector<std::string>{"red"});
    const auto& red = json["attribute_differences"][0];
    EXPECT_EQ(red["name"], "red");
    EXPECT_EQ(red["points"], 1);
    EXPECT_EQ(red["largest"], 1.0);
    EXPECT_EQ(red["largest_index"], 1);
    EXPECT_EQ(json["attributes_only_in_a"], std::vector<std::string>{"mine"});
    EXPECT_EQ(json["attributes_only_in_b"], std::vector<std::string>{"other"});
    const Outcome table = run_knead({"diff", "a.ply", "b.ply"}, folder.path());
    for (const char* words : {"largest     0.1 D  at point 0\n",
                              "differs     red: 1 point, by 1 at most, at point 1\n", "only in A   mine\n"})
        EXPECT_NE(table.out.find(words), std::string::npos) << table.out;
}

TEST(Diff, tells_another_type_of_the_same_values) {
    const ScratchFolder folder;
    write_text(folder / "a.ply", cloud("2", "property uchar heat\n", "0 0 0 1\n6 8 0 2\n"));
    write_text(folder / "b.ply", cloud("2", "property float heat\n", "0 0 0 1\n6 8 0 2\n"));
    const Outcome table = run_knead({"diff", "a.ply", "b.ply"}, folder.path());
    EXPECT_EQ(table.code, 0);
    EXPECT_NE(table.out.find("differs     heat: 0 points, of another type\n"), std::string::npos)
        << table.out;
    const Outcome outcome = run_knead({"diff", "a.ply", "b.ply", "--json"}, folder.path());
    EXPECT_EQ(nlohmann::json::parse(outcome.out)["attribute_differences"][0]["same_type"], false);
}

TEST(Diff, of_a_cloud_with_itself_is_zero) {
    const ScratchFolder folder;
    write_text(folder / "a.ply", cloud("2", "", "0 0 0\n6 8 0\n"));
    const Outcome outcome = run_knead({"diff", "a.ply", "a.ply"}, folder.path());
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.out.find("largest     0 D\nattributes  all equal\n"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.err, "");
}

TEST(Diff, tells_absolute_distances_where_there_is_no_diagonal) {
    const ScratchFolder folder;
    write_text(folder / "a.ply", cloud("1", "", "1 1 1\n"));
    write_text(folder / "b.ply", cloud("1", "", "1 1 3\n"));
    const Outcome outcome = run_knead({"diff", "a.ply", "b.ply", "--json"}, folder.path());
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(nlohmann::json::parse(outcome.out)["largest"], 2.0);
    EXPECT_NE(outcome.err.find("diagonal is 0"), std::string::npos);
}

TEST(Diff, says_what_is_odd_about_either_cloud) {
    const ScratchFolder folder;
    write_text(folder / "plain.ply", cloud("2", "", "0 0 0\n6 8 0\n"));
    write_text(folder / "odd.ply", cloud("2", "", "0 0 0\n6 8 0\n") + "more");
    for (const auto& [a, b] : {std::pair("plain.ply", "odd.ply"), {"odd.ply", "plain.ply"}}) {
        const Outcome outcome = run_knead({"diff", a, b}, folder.path());
        EXPECT_EQ(outcome.code, 0);
        EXPECT_NE(outcome.err.find("odd.ply: "), std::string::npos) << outcome.err;
    }
}

TEST(Diff, refuses_clouds_of_different_sizes) {
    const ScratchFolder folder;
    write_text(folder / "a.ply", cloud("1", "", "1 1 1\n"));
    write_text(folder / "b.ply", cloud("2", "", "1 1 3\n1 2 3\n"));
    const Outcome outcome = run_knead({"diff", "a.ply", "b.ply"}, folder.path());
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("has 2 points, but a.ply has 1"), std::string::npos) << outcome.err;
    EXPECT_EQ(run_knead({"diff", "a.ply"}, folder.path()).code, 2);
}

} // namespace
} // namespace knead::test
