// What the window keeps of files from one run to the next.

#include "app/kept_views.h"
#include "app/recent_files.h"
#include "app/remembered.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace knead::test {
namespace {

class RecentFiles : public ::testing::Test {
protected:
    RecentFiles() {
        if (const char* state = std::getenv("XDG_STATE_HOME")) before_ = state;
        setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);
        for (const char* name : {"a.knead", "b.knead"}) write_text(folder_ / name, "");
    }
    ~RecentFiles() override {
        if (before_.empty())
            unsetenv("XDG_STATE_HOME");
        else
            setenv("XDG_STATE_HOME", before_.c_str(), 1);
    }
    RecentFiles(const RecentFiles&) = delete;
    RecentFiles& operator=(const RecentFiles&) = delete;

    ScratchFolder folder_;
    std::string before_;
};

TEST_F(RecentFiles, ASessionIsLookedAtFromWhereItWasLeft) {
    const std::filesystem::path a = folder_ / "a.knead", b = folder_ / "b.knead";
    EXPECT_FALSE(kept_view(a));
    Camera camera;
    camera.pivot = {1.0 / 3, -2e-9, 4e5};
    camera.distance = 0.07;
    camera.orientation = glm::angleAxis(1.1, glm::normalize(glm::dvec3(1, 2, 3)));
    camera.offset = {0.25, -0.125};
    camera.orthographic = true;
    camera.up = UpAxis::minus_y;
    keep_view(a, {camera});
    keep_view(b, {Camera{}, 1});
    EXPECT_EQ(kept_view(folder_ / "." / "a.knead"), KeptView{camera}) << "to the last bit, by another name";
    EXPECT_EQ(kept_view(b), (KeptView{Camera{}, 1}));
    camera.distance = 3;
    keep_view(a, {camera, 2, "left arm"});
    EXPECT_EQ(kept_view(a), (KeptView{camera, 2, "left arm"})) << "the newest";
    write_text(folder_ / "state/knead/views",
               "0 0 0 -1 1 0 0 0 0 0 0 0 " + a.string() + "\nnan " + b.string() + '\n');
    EXPECT_FALSE(kept_view(a)) << "it stands nowhere";
    EXPECT_FALSE(kept_view(b));
    keep_view(b, {camera});
    std::vector<std::filesystem::path> recent;
    forget_files(recent);
    EXPECT_FALSE(kept_view(b));
}

TEST_F(RecentFiles, WhatWasChosenOfTheWindowIsThereTheNextTime) {
    EXPECT_EQ(read_remembered().width, Remembered{}.width);
    remember({UpAxis::minus_y, false, 1700, 1000, 400});
    const Remembered read = read_remembered();
    EXPECT_EQ(read.up, UpAxis::minus_y);
    EXPECT_FALSE(read.choose_samples);
    EXPECT_EQ(read.width, 1700);
    EXPECT_EQ(read.height, 1000);
    EXPECT_EQ(read.panel, 400);
    for (const char* nonsense : {"12x90", "1700", "-5x1000", "x", "1e4x900"}) {
        write_text(folder_ / "state/knead/window", std::string("size ") + nonsense + "\nup y\n");
        EXPECT_EQ(read_remembered().width, Remembered{}.width) << nonsense;
        EXPECT_EQ(read_remembered().up, UpAxis::y) << nonsense;
    }
    for (const char* nonsense : {"20", "9000", "-310", "x"}) {
        write_text(folder_ / "state/knead/window", std::string("panel ") + nonsense + "\n");
        EXPECT_EQ(read_remembered().panel, Remembered{}.panel) << nonsense;
    }
}

TEST_F(RecentFiles, ASessionThatChoosesItsSamplesIsKnownAgain) {
    const std::filesystem::path a = folder_ / "a.knead", b = folder_ / "b.knead";
    EXPECT_FALSE(chose_samples(a));
    remember_choosing(a, true);
    EXPECT_TRUE(chose_samples(a));
    EXPECT_FALSE(chose_samples(b));
    EXPECT_TRUE(chose_samples(folder_ / "." / "a.knead")) << "by another name";
    remember_choosing(b, true);
    remember_choosing(a, false); // by hand since
    EXPECT_FALSE(chose_samples(a));
    EXPECT_TRUE(chose_samples(b));
    EXPECT_TRUE(read_recent_files().empty()) << "a list of its own";
    std::vector<std::filesystem::path> recent;
    forget_files(recent);
    EXPECT_FALSE(chose_samples(b)) << "whoever wants no names kept means all of them";
}

} // namespace
} // namespace knead::test
