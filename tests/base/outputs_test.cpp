// Several outputs take their places together, or none does.

#include "base/outputs.h"
#include "support/child.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

namespace knead::test {
namespace {

namespace fs = std::filesystem;

// The cloud, the picture and the frames of one command, in folders of their own; "old" stands in the way.
struct Targets {
    explicit Targets(const ScratchFolder& scratch)
        : cloud(scratch / "clouds/a.ply"), picture(scratch / "pictures/a.png"), frames(scratch / "frames") {
        for (const fs::path& target : {cloud, picture, frames / "1.png"}) {
            fs::create_directories(target.parent_path());
            write_text(target, "old");
        }
    }

    void fill(Outputs& outputs) const {
        outputs.add(FileInTheMaking(cloud)).write("new");
        outputs.add(FileInTheMaking(picture)).write("new");
        write_text(outputs.add(TemporaryFolder(frames)).path() / "1.png", "new");
    }

    // What handing over is refused with.
    std::string refusal(Outputs& outputs) const {
        try {
            outputs.hand_over();
        } catch (const Error& error) {
            return error.trouble() == Trouble::output ? error.what() : "not of output";
        }
        return "handed over";
    }

    fs::path cloud, picture, frames;
};

std::ptrdiff_t entries_of(const fs::path& folder) {
    return std::distance(fs::recursive_directory_iterator(folder), fs::recursive_directory_iterator());
}

TEST(Outputs, AreOldUntilAllAreNew) {
    const ScratchFolder scratch;
    const Targets targets(scratch);
    const std::ptrdiff_t entries = entries_of(scratch.path());
    for (const bool hand_over : {false, true}) {
        {
            Outputs outputs;
            targets.fill(outputs);
            EXPECT_EQ(read_text(targets.cloud), "old");
            if (hand_over) outputs.hand_over();
        }
        for (const fs::path& target : {targets.cloud, targets.picture, targets.frames / "1.png"})
            EXPECT_EQ(read_text(target), hand_over ? "new" : "old");
        EXPECT_EQ(entries_of(scratch.path()), entries) << "nothing is left behind";
    }
}

TEST(Outputs, StayOldWhereTheFolderOfOneVanished) {
    const ScratchFolder scratch;
    const Targets targets(scratch);
    {
        Outputs outputs;
        targets.fill(outputs);
        fs::remove_all(targets.picture.parent_path());
        EXPECT_NE(targets.refusal(outputs).find("its folder is not there"), std::string::npos);
    }
    EXPECT_EQ(read_text(targets.cloud), "old");
    EXPECT_EQ(read_text(targets.frames / "1.png"), "old");
    EXPECT_EQ(entries_of(scratch.path()), 4) << "two folders and their files";
}

TEST(Outputs, StayOldWhereTheFolderOfOneBecameReadOnly) {
    const ScratchFolder scratch;
    const Targets targets(scratch);
    for (const fs::path& folder : {scratch.path(), targets.cloud.parent_path(), targets.frames})
        fs::permissions(folder, fs::perms::all);
    for (const fs::path& file : {targets.cloud, targets.picture, targets.frames / "1.png"})
        fs::permissions(file, fs::perms{0666});
    const std::string outcome = in_child([&]() -> std::string {
        Outputs outputs;
        targets.fill(outputs);
        fs::permissions(targets.picture.parent_path(), fs::perms{0555});
        return become_nobody() ? targets.refusal(outputs) : "";
    });
    fs::permissions(targets.picture.parent_path(), fs::perms{0755});
    if (outcome.empty()) GTEST_SKIP() << "root's rights cannot be given up here";
    EXPECT_EQ(outcome,
              targets.picture.string() +
                  ": cannot be written: there is no permission to write in its folder; choose another place");
    EXPECT_EQ(read_text(targets.cloud), "old");
    EXPECT_EQ(read_text(targets.frames / "1.png"), "old");
}

TEST(Outputs, StayOldWhereAFileIsMeantForOneOfAFolder) {
    const ScratchFolder scratch;
    const Targets targets(scratch);
    Outputs outputs;
    targets.fill(outputs);
    outputs.add(FileInTheMaking(targets.frames / "1.png")).write("another");
    EXPECT_NE(targets.refusal(outputs).find("is named for two outputs"), std::string::npos);
    for (const fs::path& target : {targets.cloud, targets.picture, targets.frames / "1.png"})
        EXPECT_EQ(read_text(target), "old");
}

TEST(Outputs, StayOldWhereOneNameIsMeantTwice) {
    const ScratchFolder scratch;
    const Targets targets(scratch);
    Outputs outputs;
    targets.fill(outputs);
    fs::create_symlink("a.png", targets.picture.parent_path() / "link.png");
    outputs.add(FileInTheMaking(targets.picture.parent_path() / "link.png")).write("another");
    EXPECT_NE(targets.refusal(outputs).find("is named for two outputs"), std::string::npos);
    for (const fs::path& target : {targets.cloud, targets.picture, targets.frames / "1.png"})
        EXPECT_EQ(read_text(target), "old");
}

TEST(Outputs, ANameThatNoFileCanHaveIsRefusedAtOnce) {
    const ScratchFolder scratch;
    EXPECT_THROW(FileInTheMaking(scratch / (std::string(260, 'a') + ".ply")), Error);
}

TEST(Outputs, AFileOfSomebodyElsesInAStickyFolderIsRefusedAtOnce) {
    const ScratchFolder scratch;
    write_text(scratch / "theirs", "old");
    fs::permissions(scratch / "theirs", fs::perms{0666});
    fs::permissions(scratch.path(), fs::perms{01777});
    const std::string outcome = in_child([&]() -> std::string {
        if (!become_nobody()) return "";
        try {
            FileInTheMaking file(scratch / "theirs");
        } catch (const Error& error) {
            return error.what();
        }
        return "taken";
    });
    if (outcome.empty()) GTEST_SKIP() << "root's rights cannot be given up here";
    EXPECT_NE(outcome.find("cannot be written"), std::string::npos) << outcome;
}

TEST(Outputs, StayOldWhereAFolderTookThePlaceOfAFile) {
    const ScratchFolder scratch;
    const Targets targets(scratch);
    Outputs outputs;
    targets.fill(outputs);
    fs::remove(targets.picture);
    fs::create_directory(targets.picture);
    EXPECT_NE(targets.refusal(outputs).find("is a folder"), std::string::npos);
    EXPECT_EQ(read_text(targets.cloud), "old");
}

} // namespace
} // namespace knead::test
