#include "base/error.h"
#include "base/temporary_folder.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

namespace knead::test {
namespace {

namespace fs = std::filesystem;

std::ptrdiff_t entries_of(const fs::path& folder) {
    return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

TEST(TemporaryFolder, HandsOverOrLeavesNothing) {
    const ScratchFolder scratch;
    const fs::path target = scratch / "made";
    fs::path inside;
    {
        const TemporaryFolder folder(target);
        inside = folder.path();
        write_text(inside / "a", "1");
    }
    EXPECT_FALSE(fs::exists(inside));
    EXPECT_FALSE(fs::exists(target));
    {
        TemporaryFolder folder(target);
        write_text(folder.path() / "a", "1");
        folder.hand_over();
    }
    EXPECT_TRUE(fs::exists(target / "a"));
    EXPECT_EQ(entries_of(scratch.path()), 1);
    EXPECT_THROW(TemporaryFolder(target / "a"), Error);
    EXPECT_EQ(folder_of("made/"), fs::path("made"));
}

TEST(TemporaryFolder, RefusesNamesThatTheSystemRefuses) {
    const ScratchFolder scratch;
    fs::create_symlink("loop", scratch / "loop");
    for (const fs::path& target : {scratch / "loop", scratch / std::string(300, 'n')}) {
        try {
            const TemporaryFolder folder(target);
            ADD_FAILURE() << target;
        } catch (const Error& error) {
            EXPECT_EQ(error.trouble(), Trouble::output) << error.what();
        }
    }
}

TEST(TemporaryFolder, PutsFilesIntoAFolderThatIsThereAndFollowsNoLink) {
    const ScratchFolder scratch;
    const fs::path target = scratch / "made";
    fs::create_directory(target);
    write_text(target / "stays", "old");
    write_text(target / "replaced", "old");
    write_text(scratch / "elsewhere", "old");
    fs::create_symlink("../elsewhere", target / "link");
    {
        TemporaryFolder folder(target);
        for (const char* name : {"new", "replaced", "link"}) write_text(folder.path() / name, "new");
        folder.hand_over();
    }
    EXPECT_EQ(read_text(target / "stays"), "old");
    for (const char* name : {"new", "replaced", "link"}) EXPECT_EQ(read_text(target / name), "new");
    EXPECT_FALSE(fs::is_symlink(target / "link"));
    EXPECT_EQ(read_text(scratch / "elsewhere"), "old");
    EXPECT_EQ(entries_of(target), 4);
}

TEST(TemporaryFolder, HandsOverAllOrNothing) {
    const ScratchFolder scratch;
    const fs::path target = scratch / "made";
    fs::create_directories(target / "b");
    write_text(target / "a", "old");
    {
        TemporaryFolder folder(target);
        for (const char* name : {"a", "b"}) write_text(folder.path() / name, "new");
        EXPECT_THROW(folder.hand_over(), Error);
    }
    EXPECT_EQ(read_text(target / "a"), "old");
    EXPECT_EQ(entries_of(target), 2);
}

} // namespace
} // namespace knead::test
