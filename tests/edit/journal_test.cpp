#include "edit/journal.h"

#include "base/error.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include <sys/resource.h>

namespace knead::test {

namespace {

constexpr const char* header = R"({"knead":1,"cloud":{"path":"/somewhere/cat.ply"}})";
constexpr const char* commit = R"({"op":"commit"})";

std::filesystem::path abandoned(const ScratchFolder& folder, const std::string& last = "") {
    Journal journal = Journal::create(folder.path(), header);
    journal.append(commit);
    const std::filesystem::path file = journal.file();
    if (!last.empty()) write_text(file, read_text(file) + last);
    return file;
}

} // namespace

TEST(Journal, HoldsEveryLineAtOnce) {
    const ScratchFolder folder;
    Journal journal = Journal::create(folder.path() / "deep" / "state", header);
    EXPECT_EQ(read_text(journal.file()), std::string(header) + "\n");
    journal.append(commit);
    EXPECT_EQ(read_text(journal.file()), std::string(header) + "\n" + commit + "\n");
}

// A disk that takes nothing, as far as a process can make one: no file may grow.
TEST(Journal, ThatCannotBeBegunLeavesNothing) {
    const ScratchFolder folder;
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit none{0, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &none), 0);
    bool threw = false; // nothing is told before files can grow again
    try {
        (void)Journal::create(folder.path(), header);
    } catch (const Error&) {
        threw = true;
    }
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    (void)std::signal(SIGXFSZ, handler);
    EXPECT_TRUE(threw);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Journal, OfAnEarlierVersionThatHasNoLineAtAllIsRemoved) {
    const ScratchFolder folder;
    write_text(folder / "empty.knead", "");
    EXPECT_TRUE(find_lost_work(folder.path()).empty());
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Journal, IsFoundOnceNobodyHasItOpen) {
    const ScratchFolder folder;
    {
        Journal journal = Journal::create(folder.path(), header);
        journal.append(commit);
        EXPECT_TRUE(find_lost_work(folder.path()).empty());
    }
    const std::vector<LostWork> lost = find_lost_work(folder.path());
    ASSERT_EQ(lost.size(), 1U);
    EXPECT_EQ(lost[0].steps, 1U);
    EXPECT_EQ(lost[0].cloud, "/somewhere/cat.ply");
}

TEST(Journal, OneWithoutAnActIsNotWorthKeeping) {
    const ScratchFolder folder;
    std::filesystem::path file;
    {
        const Journal journal = Journal::create(folder.path(), header);
        file = journal.file();
    }
    EXPECT_TRUE(find_lost_work(folder.path()).empty());
    EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(Journal, ALineThatWasCutShortIsDropped) {
    const ScratchFolder folder;
    const std::filesystem::path file = abandoned(folder, R"({"op":"settle","itera)");
    ASSERT_EQ(find_lost_work(folder.path()).size(), 1U);
    Journal journal = Journal::take_over(file);
    journal.append(commit);
    EXPECT_EQ(read_text(file), std::string(header) + "\n" + commit + "\n" + commit + "\n");
}

TEST(Journal, ALastLineThatOnlyLacksItsEndIsKept) {
    const ScratchFolder folder;
    const std::filesystem::path file = abandoned(folder, R"({"op":"set","iterations":3})");
    const std::vector<LostWork> lost = find_lost_work(folder.path());
    ASSERT_EQ(lost.size(), 1U);
    EXPECT_EQ(lost[0].steps, 2U);
    Journal journal = Journal::take_over(file);
    journal.append(commit);
    EXPECT_EQ(read_text(file), std::string(header) + "\n" + commit + "\n" + R"({"op":"set","iterations":3})" +
                                   "\n" + commit + "\n");
}

TEST(Journal, IsMendedWhereverACrashCutIt) {
    const std::string whole =
        std::string(header) + "\n" + R"({"op":"settle","iterations":3})" + "\n" + commit + "\n";
    const auto lines_up_to = [&](std::size_t end) {
        return static_cast<std::size_t>(std::ranges::count(whole.substr(0, end), '\n'));
    };
    for (std::size_t cut = 0; cut <= whole.size(); ++cut) {
        const MendedText text = mended(whole.substr(0, cut), "j");
        // A line that lacks nothing but its end counts.
        const bool lacks_end = cut < whole.size() && whole[cut] == '\n';
        EXPECT_EQ(lines_up_to(text.text.size()), lines_up_to(cut + (lacks_end ? 1 : 0))) << cut;
        EXPECT_TRUE(whole.starts_with(text.text)) << cut;
        const bool is_whole = cut == 0 || whole[cut - 1] == '\n' || lacks_end;
        EXPECT_EQ(text.dropped, !is_whole) << cut;
    }
    // What a power cut may leave behind it.
    EXPECT_EQ(mended(whole + std::string(100, '\0'), "j").text, whole);
}

TEST(Journal, IsTakenOverByOneOnly) {
    const ScratchFolder folder;
    const std::filesystem::path file = abandoned(folder);
    const Journal journal = Journal::take_over(file);
    EXPECT_THROW(Journal::take_over(file), Error);
}

TEST(Journal, DiscardedIsGone) {
    const ScratchFolder folder;
    const std::filesystem::path file = abandoned(folder);
    {
        Journal journal = Journal::take_over(file);
        journal.discard();
    }
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_TRUE(find_lost_work(folder.path()).empty());
}

TEST(Journal, ThatCannotBeReadIsToldOfAndKept) {
    const ScratchFolder folder;
    const std::filesystem::path good = abandoned(folder), bad = folder / "bad.knead";
    const std::string text = std::string(header) + "\n{\"op\":\"comm\n" + commit + "\n";
    write_text(bad, text);
    const std::vector<LostWork> lost = find_lost_work(folder.path());
    ASSERT_EQ(lost.size(), 2U);
    const LostWork& damaged = lost[0].journal == bad ? lost[0] : lost[1];
    EXPECT_EQ(damaged.journal, bad);
    EXPECT_NE(damaged.trouble.find("bad.knead:2"), std::string::npos) << damaged.trouble;
    EXPECT_TRUE((damaged.journal == lost[0].journal ? lost[1] : lost[0]).trouble.empty());
    EXPECT_EQ(read_text(bad), text);
}

TEST(Journal, WithHalfAFirstLineIsRemoved) {
    const ScratchFolder folder;
    write_text(folder / "half.knead", std::string(header).substr(0, 12));
    EXPECT_TRUE(find_lost_work(folder.path()).empty());
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Journal, AFolderThatIsNotThereHoldsNothing) {
    EXPECT_TRUE(find_lost_work("/nowhere/at/all").empty());
    EXPECT_THROW(Journal::create("/proc/nowhere", header), Error);
}

} // namespace knead::test
