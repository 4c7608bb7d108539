#include "base/error.h"
#include "base/whole_file.h"
#include "support/child.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <csignal>

#include <sys/resource.h>
#include <sys/stat.h>
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

TEST(WholeFile, refuses_a_file_that_becomes_shorter_while_it_is_read) {
    class Shortening final : public Progress {
    public:
        explicit Shortening(std::filesystem::path file) : file_(std::move(file)) {}
        void report(std::string_view /*stage*/, double /*fraction*/) override {
            std::filesystem::resize_file(file_, 0);
            ++reports_;
        }
        bool cancelled() const override { return reports_ > 9; } // it need not try for ever

    private:
        std::filesystem::path file_;
        int reports_ = 0;
    };
    const ScratchFolder folder;
    write_text(folder / "file", "some text");
    Shortening shortening(folder / "file");
    EXPECT_THROW(read_whole_file(folder / "file", shortening), Error);
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

TEST(FileInTheMaking, follows_links_to_what_is_not_there_yet) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder / "deep");
    std::filesystem::create_symlink("deep/second", folder / "first");
    std::filesystem::create_symlink("../file", folder / "deep/second");
    {
        FileInTheMaking file(folder / "first");
        file.write("new");
        file.commit();
    }
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "first"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "deep/second"));
    EXPECT_EQ(read_text(folder / "file"), "new");
    std::filesystem::create_symlink("nowhere/file", folder / "astray");
    EXPECT_EQ(trouble_of(folder / "astray"), Trouble::output);
}

TEST(FileInTheMaking, refuses_what_is_no_file_by_its_links) {
    const ScratchFolder folder;
    std::filesystem::create_symlink("/dev/null", folder / "null");
    EXPECT_EQ(trouble_of(folder / "null"), Trouble::output);
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0); // what /proc names it by is no path
    std::filesystem::create_symlink("/proc/self/fd/" + std::to_string(ends[1]), folder / "pipe");
    EXPECT_EQ(trouble_of(folder / "pipe"), Trouble::output);
    ::close(ends[0]), ::close(ends[1]);
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "pipe"));
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

TEST(FileInTheMaking, refuses_what_is_write_protected_or_no_file) {
    const ScratchFolder folder;
    write_text(folder / "protected", "old");
    ASSERT_EQ(::chmod(folder.path().c_str(), 0777), 0);
    ASSERT_EQ(::chmod((folder / "protected").c_str(), 0444), 0);
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0666), 0);
    EXPECT_EQ(trouble_of(folder / "pipe"), Trouble::output);
    const std::string words = in_child([&]() -> std::string {
        if (!become_nobody()) return "";
        FileInTheMaking file(folder / "protected");
        return "accepted";
    });
    EXPECT_EQ(entries_of(folder.path()), 2U);
    if (words.empty()) GTEST_SKIP() << "root's rights cannot be given up here";
    EXPECT_NE(words.find("write-protected"), std::string::npos) << words;
}

// --- What stands in the way of writing: the old file stays, and nothing else

// Tries to replace "old" in the file by a megabyte; returns the words of the refusal.
std::string words_of_replacing(const std::filesystem::path& target) {
    try {
        FileInTheMaking file(target);
        file.write(std::string(std::size_t{1} << 20, 'n'));
        file.commit();
    } catch (const Error& error) {
        return error.trouble() == Trouble::output ? error.what() : "not of output";
    }
    return "written";
}

std::string left_in(const std::filesystem::path& folder) {
    std::string left;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        left += " " + entry.path().filename().string() + "=" + read_text(entry.path());
    return left;
}

constexpr const char* no_mounts = "file systems cannot be mounted here: it takes root or user namespaces";

TEST(FileInTheMaking, on_a_full_disk_leaves_the_old_file) {
    const ScratchFolder folder;
    const std::string outcome = in_child([&]() -> std::string {
        if (!mount_small_disk(folder.path(), 256 << 10)) return "";
        write_text(folder / "file", "old");
        return words_of_replacing(folder / "file") + left_in(folder.path());
    });
    if (outcome.empty()) GTEST_SKIP() << no_mounts;
    EXPECT_EQ(outcome, (folder / "file").string() + ": cannot be written: the disk is full; free some space "
                                                    "or choose another place file=old");
}

TEST(FileInTheMaking, on_a_disk_that_becomes_read_only_leaves_the_old_file) {
    const ScratchFolder folder;
    const std::string outcome = in_child([&]() -> std::string {
        if (!mount_small_disk(folder.path(), 4 << 20)) return "";
        write_text(folder / "file", "old");
        if (!make_read_only(folder.path())) return "";
        return words_of_replacing(folder / "file") + left_in(folder.path());
    });
    if (outcome.empty()) GTEST_SKIP() << no_mounts;
    EXPECT_EQ(outcome, (folder / "file").string() +
                           ": cannot be written: the disk is read-only; choose another place file=old");
}

TEST(FileInTheMaking, in_a_read_only_folder_leaves_the_old_file) {
    const ScratchFolder folder;
    write_text(folder / "file", "old");
    ASSERT_EQ(::chmod((folder / "file").c_str(), 0666), 0);
    ASSERT_EQ(::chmod(folder.path().c_str(), 0555), 0);
    const std::string outcome = in_child([&]() -> std::string {
        if (!become_nobody()) return "";
        return words_of_replacing(folder / "file") + left_in(folder.path());
    });
    ASSERT_EQ(::chmod(folder.path().c_str(), 0755), 0);
    if (outcome.empty()) GTEST_SKIP() << "root's rights cannot be given up here";
    EXPECT_EQ(outcome, (folder / "file").string() + ": cannot be written: there is no permission to write in "
                                                    "its folder; choose another place file=old");
}

TEST(FileInTheMaking, beyond_a_limit_on_files_leaves_the_old_file) {
    const ScratchFolder folder;
    write_text(folder / "file", "old");
    const std::string words = in_child([&] {
        ::signal(SIGXFSZ, SIG_IGN); // as the program does
        const rlimit limit{100'000, 100'000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        return words_of_replacing(folder / "file");
    });
    EXPECT_NE(words.find("larger than files may be here"), std::string::npos) << words;
    EXPECT_EQ(left_in(folder.path()), " file=old");
}

TEST(FileInTheMaking, says_so_when_its_folder_vanished_or_went_elsewhere) {
    const ScratchFolder folder;
    for (const bool moved : {false, true}) {
        std::filesystem::create_directory(folder / "here");
        {
            FileInTheMaking file(folder / "here/file");
            file.write("new");
            if (moved)
                std::filesystem::rename(folder / "here", folder / "there");
            else
                std::filesystem::remove_all(folder / "here");
            try {
                file.commit();
                ADD_FAILURE() << "there was no folder to write in";
            } catch (const Error& error) {
                EXPECT_EQ(error.trouble(), Trouble::output);
                EXPECT_NE(std::string(error.what()).find("its folder is not there"), std::string::npos);
            }
        }
        EXPECT_EQ(entries_of(folder.path()), moved ? 1U : 0U);
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder / "there"));
}

TEST(FileInTheMaking, clears_away_what_a_killed_one_left) {
    const ScratchFolder folder;
    const pid_t child = begin_child([&] {
        FileInTheMaking file(folder / "file");
        file.write("half");
        write_text(folder / "ready", "");
        ::pause();
    });
    while (!std::filesystem::exists(folder / "ready")) ::usleep(1000);
    kill_child(child);
    EXPECT_EQ(left_in(folder.path()).find(" file="), std::string::npos);
    EXPECT_EQ(entries_of(folder.path()), 2U) << "the temporary of the killed one";
    FileInTheMaking file(folder / "file");
    file.write("whole");
    file.commit();
    EXPECT_EQ(read_text(folder / "file"), "whole");
    EXPECT_EQ(entries_of(folder.path()), 2U) << "the file and \"ready\"";
}

TEST(WriteAll, goes_on_after_a_short_write_and_tells_what_stopped_it) {
    const ScratchFolder folder;
    const std::string outcome = in_child([&] {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{100'000, 100'000}; // a longer write is cut short there, and the next one fails
        ::setrlimit(RLIMIT_FSIZE, &limit);
        const Claim claim = Claim::beside(folder / "raw", Claim::Kind::file);
        const int code = write_all(claim.descriptor(), std::string(150'000, 'k'));
        return std::string(code == EFBIG ? "too large, " : "as if it were whole, ") +
               std::to_string(std::filesystem::file_size(claim.path())) + " bytes";
    });
    EXPECT_EQ(outcome, "too large, 100000 bytes");
}

TEST(FileStamp, changes_with_the_file_and_with_what_takes_its_place) {
    const ScratchFolder folder;
    EXPECT_FALSE(stamp_of(folder / "file"));
    EXPECT_FALSE(stamp_of(folder.path()));
    write_text(folder / "file", "one");
    std::filesystem::create_symlink("file", folder / "link");
    const auto first = stamp_of(folder / "file");
    ASSERT_TRUE(first);
    EXPECT_EQ(stamp_of(folder / "file"), first);
    EXPECT_EQ(stamp_of(folder / "link"), first);

    const auto written = std::filesystem::last_write_time(folder / "file");
    write_text(folder / "file", "longer");
    std::filesystem::last_write_time(folder / "file", written);
    EXPECT_NE(stamp_of(folder / "file"), first) << "another size";
    write_text(folder / "file", "two");
    std::filesystem::last_write_time(folder / "file", written + std::chrono::nanoseconds(1000));
    EXPECT_NE(stamp_of(folder / "file"), first) << "another time";
    std::filesystem::rename(folder / "file", folder / "kept"); // its inode is not free
    write_text(folder / "file", "two");
    std::filesystem::last_write_time(folder / "file", written);
    EXPECT_NE(stamp_of(folder / "file"), first) << "another file";
}

TEST(FirstBytes, are_those_of_regular_files_only_and_never_waited_for) {
    const ScratchFolder folder;
    write_text(folder / "file", "bytes");
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0666), 0);
    EXPECT_EQ(first_bytes_of_file(folder / "file", 3), "byt");
    EXPECT_EQ(first_bytes_of_file(folder / "file", 100), "bytes");
    EXPECT_EQ(first_bytes_of_file(folder / "pipe", 3), "");
    EXPECT_EQ(first_bytes_of_file(folder.path(), 3), "");
    EXPECT_EQ(first_bytes_of_file(folder / "missing", 3), "");
}

} // namespace
} // namespace knead::test
