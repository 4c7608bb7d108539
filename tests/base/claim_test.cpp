// Names that a living process holds, and what dead ones leave.

#include "base/claim.h"
#include "support/child.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <fstream>

#include <unistd.h>

namespace knead::test {
namespace {

using Kind = Claim::Kind;

// A process that holds a claim beside `target` until it is killed.
pid_t begin_claiming(const std::filesystem::path& target, Kind kind, const std::filesystem::path& done) {
    return begin_child([=] {
        const Claim claim = Claim::beside(target, kind);
        if (kind == Kind::folder) write_text(claim.path() / "piece", "half");
        write_text(done, "");
        ::pause();
    });
}

void wait_for(const std::filesystem::path& file) {
    while (!std::filesystem::exists(file)) ::usleep(1000);
}

class ClaimOfKind : public testing::TestWithParam<Kind> {
protected:
    const ScratchFolder folder;
    const std::filesystem::path target = folder / "target";
    const std::filesystem::path first = folder / "target.knead-making";
};
INSTANTIATE_TEST_SUITE_P(Kinds, ClaimOfKind, testing::Values(Kind::file, Kind::folder));

TEST_P(ClaimOfKind, IsGoneWithItsOwner) {
    {
        const Claim claim = Claim::beside(target, GetParam());
        EXPECT_EQ(claim.path(), first);
        EXPECT_TRUE(std::filesystem::exists(first));
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST_P(ClaimOfKind, EndsAsTheTarget) {
    Claim::beside(target, GetParam()).rename_to(target);
    EXPECT_TRUE(std::filesystem::exists(target));
    EXPECT_FALSE(std::filesystem::exists(first));
}

TEST_P(ClaimOfKind, TwoAtOnceHaveDifferentNames) {
    const Claim one = Claim::beside(target, GetParam());
    const Claim two = Claim::beside(target, GetParam());
    EXPECT_EQ(two.path(), first.string() + "-2");
    EXPECT_FALSE(Claim::of(first, GetParam()));
    EXPECT_TRUE(is_held(first, GetParam()));
}

TEST_P(ClaimOfKind, OfALivingProcessIsLeftAloneAndOfADeadOneRemoved) {
    const pid_t child = begin_claiming(target, GetParam(), folder / "done");
    wait_for(folder / "done");
    EXPECT_TRUE(is_held(first, GetParam()));
    EXPECT_EQ(Claim::beside(target, GetParam()).path(), first.string() + "-2");
    EXPECT_TRUE(kill_child(child));
    EXPECT_TRUE(std::filesystem::exists(first)) << "a killed process cleans nothing up";
    EXPECT_EQ(Claim::beside(target, GetParam()).path(), first);
    EXPECT_FALSE(std::filesystem::exists(first));
}

TEST_P(ClaimOfKind, LeavesAloneWhatIsSomethingElse) {
    write_text(folder / "kept", "kept");
    if (GetParam() == Kind::file)
        std::filesystem::create_directory(first);
    else
        write_text(first, "file");
    std::filesystem::create_symlink("kept", first.string() + "-2");
    EXPECT_EQ(Claim::beside(target, GetParam()).path(), first.string() + "-3");
    EXPECT_TRUE(std::filesystem::is_symlink(first.string() + "-2"));
    EXPECT_EQ(read_text(folder / "kept"), "kept");
}

TEST_P(ClaimOfKind, LeavesAloneWhatTookItsPlace) {
    {
        Claim claim = Claim::beside(target, GetParam());
        EXPECT_TRUE(claim.is_at_path());
        std::filesystem::rename(first, folder / "carried off");
        EXPECT_FALSE(claim.is_at_path());
        if (GetParam() == Kind::folder) std::filesystem::create_directory(first);
        const std::filesystem::path other = GetParam() == Kind::folder ? first / "other" : first;
        write_text(other, "other");
        EXPECT_FALSE(claim.is_at_path());
        EXPECT_THROW(claim.rename_to(target), std::system_error);
    }
    EXPECT_FALSE(std::filesystem::exists(target));
    EXPECT_EQ(read_text(GetParam() == Kind::folder ? first / "other" : first), "other");
}

TEST(Claim, RemovedWhereItsFolderWasMovedTo) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder / "here");
    {
        Claim claim = Claim::beside(folder / "here/target", Kind::file);
        std::filesystem::rename(folder / "here", folder / "there");
        EXPECT_THROW(claim.rename_to(folder / "here/target"), std::system_error);
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder / "there"));
}

TEST(Claim, FitsBesideTheLongestName) {
    const ScratchFolder folder;
    const Claim claim = Claim::beside(folder / std::string(255, 'n'), Kind::file);
    EXPECT_TRUE(std::filesystem::exists(claim.path()));
}

TEST(Claim, NeedsItsFolder) {
    EXPECT_THROW(Claim::beside("/nowhere/at/all", Kind::file), std::system_error);
    EXPECT_FALSE(is_held("/nowhere/at/all", Kind::file));
}

} // namespace
} // namespace knead::test
