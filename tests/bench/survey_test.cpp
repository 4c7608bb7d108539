// The reader of the survey's shapes, and what it refuses.

#include "bench/survey.h"

#include "base/error.h"
#include "support/scans.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <functional>

namespace {

using namespace knead;
using test::ScratchFolder;
using test::write_text;

// A shape of three vertices, one of each status, and files that a test may spoil.
struct Files {
    std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n# a remark\n2 0.5 -1e0\n3 0 1 2\n";
    std::string sel = "# status\n0\n1\n\n2\n";
    std::string def = "# motion\n0 -1 0 1\n1 0 0 2\n0 0 1 3\n0 0 0 1\n";
};

DeformationTask read(const Files& files) {
    const ScratchFolder folder;
    write_text(folder / "tri.off", files.off);
    write_text(folder / "tri.sel", files.sel);
    write_text(folder / "tri.def", files.def);
    return read_survey_task(folder.path(), "tri");
}

std::string refusal(const Files& files) {
    try {
        read(files);
    } catch (const Error& error) {
        EXPECT_EQ(error.trouble(), Trouble::input);
        return error.what();
    }
    return "";
}

void expect_refusal(const Files& files, const std::string& place, const std::string& words) {
    const std::string told = refusal(files);
    EXPECT_NE(told.find(place), std::string::npos) << told;
    EXPECT_NE(told.find(words), std::string::npos) << told;
}

TEST(Survey, ReadsVerticesHandlesAndMotion) {
    const DeformationTask task = read({});
    EXPECT_EQ(task.name, "tri");
    ASSERT_EQ(task.cloud.size(), 3U);
    EXPECT_EQ(task.cloud.file_position(2), Vec3d(2, 0.5, -1));
    EXPECT_EQ(task.fixed, std::vector<Index>{0});
    EXPECT_EQ(task.handle, std::vector<Index>{2});
    EXPECT_EQ(task.pose.translate, Vec3d(1, 2, 3));
    EXPECT_TRUE((task.pose.rotate * Vec3d::UnitX()).isApprox(Vec3d::UnitY()));
}

TEST(Survey, TakesTheShorterWayRound) {
    Files files;
    for (const char* motion : {"-0.5 0 -0.866025 0\n0 1 0 0\n0.866025 0 -0.5 0\n0 0 0 1\n",
                               "-0.707107 -0.707107 0 0\n0.707107 -0.707107 0 0\n0 0 1 0\n0 0 0 1\n",
                               "-1 0 0 0\n0 -1 0 0\n0 0 1 0\n0 0 0 1\n"}) {
        files.def = motion;
        const DeformationTask task = read(files);
        EXPECT_GE(task.pose.rotate.w(), 0);
        EXPECT_NEAR(task.pose.rotate.norm(), 1, 1e-12);
    }
}

TEST(Survey, ReadsWindowsLines) {
    Files files;
    files.off = "OFF\r\n3 0 0\r\n0 0 0\r\n1 0 0\r\n2 0 0\r\n";
    files.sel = "0\r\n1\r\n2\r\n";
    EXPECT_EQ(read(files).cloud.size(), 3U);
}

TEST(Survey, RefusesMalformedVertices) {
    Files files;
    files.off = "";
    expect_refusal(files, "tri.off", "ends");
    files.off = "PLY\n";
    expect_refusal(files, "tri.off:1", "OFF");
    files.off = "OFF\n0 0 0\n";
    expect_refusal(files, "tri.off:2", "no vertices");
    files.off = "OFF\n-3 0 0\n";
    expect_refusal(files, "tri.off:2", "whole number");
    files.off = "OFF\n3 0 0\n0 0 0\n1 0\n";
    expect_refusal(files, "tri.off:4", "vertex 1 of 3");
    files.off = "OFF\n3 0 0\n0 0 0\n1 0 x\n";
    expect_refusal(files, "tri.off:4", "\"x\"");
    files.off = "OFF\n3 0 0\n0 0 0\n";
    expect_refusal(files, "tri.off", "vertex 1 of 3");
}

TEST(Survey, RefusesAMalformedSelection) {
    Files files;
    files.sel = "0\n1\n";
    expect_refusal(files, "tri.sel", "vertex 2");
    files.sel = "0\n3\n2\n";
    expect_refusal(files, "tri.sel:2", "not 3");
    files.sel = "0\n1\n0\n";
    expect_refusal(files, "tri.sel", "handle");
    files.sel = "2\n1\n2\n";
    expect_refusal(files, "tri.sel", "fixed");
    files.sel = "0\n1.5\n2\n";
    expect_refusal(files, "tri.sel:2", "whole number");
}

TEST(Survey, RefusesAMotionThatIsNotRigid) {
    Files files;
    files.def = "2 0 0 0\n0 2 0 0\n0 0 2 0\n0 0 0 1\n";
    expect_refusal(files, "tri.def", "rigid");
    files.def = "-1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
    expect_refusal(files, "tri.def", "rigid");
    files.def = "1 0 0 nan\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
    expect_refusal(files, "tri.def", "rigid");
    files.def = "1 0 0 0\n0 1 0\n";
    expect_refusal(files, "tri.def:2", "4×4");
}

TEST(Survey, NamesAMissingFile) {
    const ScratchFolder folder;
    try {
        read_survey_task(folder.path(), "bar");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("bar.off"), std::string::npos);
    }
}

TEST(Survey, ReadsTheFourShapes) {
    const auto bar = test::find_survey("bar.off");
    if (!bar) GTEST_SKIP() << "no bar.off in KNEAD_SURVEY or ../shared/survey";
    for (const std::string& name : survey_names()) {
        const DeformationTask task = read_survey_task(bar->parent_path(), name);
        EXPECT_GT(task.cloud.size(), 4000U);
        EXPECT_FALSE(task.fixed.empty());
        EXPECT_FALSE(task.handle.empty());
    }
}

TEST(DataFiles, LookInTheFolderThatIsAskedForAlone) {
    const ScratchFolder folder;
    write_text(folder / "a.ply", "");
    const DataFolders folders = scan_folders(folder.path().string());
    EXPECT_EQ(find_data_file(folders, "a.ply"), folder / "a.ply");
    EXPECT_FALSE(find_data_file(folders, "bunny.ply"));
    EXPECT_EQ(missing_words(folders, "bunny.ply"), "no bunny.ply in " + folder.path().string());
    EXPECT_EQ(data_files(folders, ".ply").size(), 1U);
    EXPECT_FALSE(survey_folder(folders));
}

} // namespace
