#include "base/error.h"
#include "base/whole_file.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <unistd.h>

namespace knead::test {
namespace {

std::size_t entries_of(const std::filesystem::path& folder) {
    std::size_t entries = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) entries += entry.exists() ? 1 : 0;
    return entries;
}

Trouble trouble_of(const std::filesystem::path& target) {
    try {
        FileInTheMaking file(target);
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(target.string()), std::string::npos);
        return error.trouble();
    }
    return Trouble::usage;
}

TEST(WholeFile, is_read_as_it_was_written) {
    const ScratchFolder folder;
    SilentProgress progress;
    for (const std::size_t size : {0U, 1U, 20000000U}) {
        FileInTheMaking file(folder / "file");
        file.write(std::string(size, 'k'));
        file.commit();
        const auto bytes = read_whole_file(folder / "file", progress);
        EXPECT_EQ(bytes.size(), size);
        EXPECT_TRUE(std::all_of(bytes.begin(), bytes.end(), [](std::byte b) { return b == std::byte{'k'}; }));
    }
}

TEST(WholeFile, refuses_to_read_what_is_no_file) {
    const ScratchFolder folder;
    SilentProgress progress;
    EXPECT_THROW(read_whole_file(folder / "missing", progress), Error);
    EXPECT_THROW(read_whole_file(folder.path(), progress), Error);
    EXPECT_THROW(read_whole_file("/dev/null", progress), Error);
}

TEST(WholeFile, stops_reading_when_told) {
    class Stop final : public Progress {
    public:
        void report(std::string_view /*stage*/, double /*fraction*/) override {}
        bool cancelled() const override { return true; }
    } stop;
    const ScratchFolder folder;
    write_text(folder / "file", "text");
    EXPECT_THROW(read_whole_file(folder / "file", stop), Cancelled);
}

TEST(FileInTheMaking, replaces_its_target_at_the_commit) {
    const ScratchFolder folder;
    write_text(folder / "file", "old");
    FileInTheMaking file(folder / "file");
    file.write("new");
    EXPECT_EQ(read_text(folder / "file"), "old");
    file.commit();
    EXPECT_EQ(read_text(folder / "file"), "new");
    EXPECT_EQ(entries_of(folder.path()), 1U);
}

TEST(FileInTheMaking, leaves_nothing_without_a_commit) {
    const ScratchFolder folder;
    write_text(folder / "file", "old");
    {
        FileInTheMaking file(folder / "file");
        file.write("new");
        FileInTheMaking other(folder / "other");
        other.write("new");
    }
    EXPECT_EQ(read_text(folder / "file"), "old");
    EXPECT_EQ(entries_of(folder.path()), 1U);
}

TEST(FileInTheMaking, keeps_permissions) {
    using std::filesystem::perms;
    const ScratchFolder folder;
    write_text(folder / "file", "old");
    for (const perms mode : {perms{0640}, perms{0600}, perms{0755}}) {
        std::filesystem::permissions(folder / "file", mode);
        FileInTheMaking file(folder / "file");
        file.write("new");
        file.commit();
        EXPECT_EQ(std::filesystem::status(folder / "file").permissions(), mode);
    }
    // A new file has those of any other new file.
    write_text(folder / "plain", "");
    FileInTheMaking file(folder / "new");
    file.commit();
    EXPECT_EQ(std::filesystem::status(folder / "new").permissions(),
              std::filesystem::status(folder / "plain").permissions());
}

TEST(FileInTheMaking, follows_a_link) {
    const ScratchFolder folder;
    write_text(folder / "file", "old");
    std::filesystem::create_symlink("file", folder / "link");
    FileInTheMaking file(folder / "link");
    file.write("new");
    file.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(read_text(folder / "file"), "new");
}

TEST(FileInTheMaking, refuses_a_folder_and_a_missing_folder) {
    const ScratchFolder folder;
    EXPECT_EQ(trouble_of(folder.path()), Trouble::output);
    EXPECT_EQ(trouble_of(folder / "missing/file"), Trouble::output);
}

TEST(FileInTheMaking, writes_into_the_current_folder) {
    const ScratchFolder folder;
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    FileInTheMaking file("bare");
    file.write("text");
    file.commit();
    std::filesystem::current_path(before);
    EXPECT_EQ(read_text(folder / "bare"), "text");
}

} // namespace
} // namespace knead::test
