#include "edit/journal_facts.h"

#include "support/scratch_folder.h"

#include <gtest/gtest.h>

namespace knead::test {

namespace {

std::vector<SessionLine> lines(std::initializer_list<SessionAction> actions) {
    std::vector<SessionLine> made;
    for (const SessionAction& action : actions) made.push_back({made.size() + 2, "", action});
    return made;
}

constexpr CommitLine act;
constexpr UndoLine undo;
constexpr RedoLine redo;

} // namespace

TEST(JournalFacts, AreReadAsTheyWereWritten) {
    const ScratchFolder folder;
    const std::filesystem::path journal = folder / "2026-j.knead";
    EXPECT_EQ(read_journal_facts(journal), JournalFacts{});
    JournalFacts facts{folder / "schön \"1\".knead", stamp_of("/proc/self/exe"), 17, true,
                       stamp_of("/proc/self/exe")};
    ASSERT_TRUE(facts.stamp);
    write_journal_facts(journal, facts);
    EXPECT_EQ(read_journal_facts(journal), facts);
    facts = {};
    write_journal_facts(journal, facts);
    EXPECT_EQ(read_journal_facts(journal), facts);
}

TEST(JournalFacts, ThatCannotBeReadAreAsIfItWasNeverSaved) {
    const ScratchFolder folder;
    const std::filesystem::path journal = folder / "j.knead";
    for (const char* text : {"", "{", "[]", R"({"session":3})", "\xff\xfe",
                             R"({"session":"a","saved_lines":"x","chooses_samples":1})"}) {
        write_text(journal_facts_file(journal), text);
        EXPECT_EQ(read_journal_facts(journal), JournalFacts{}) << text;
    }
}

TEST(JournalFacts, ANameThatIsNoUtf8IsForgotten) {
    const ScratchFolder folder;
    JournalFacts facts;
    facts.session = "/tmp/\xff.knead";
    write_journal_facts(folder / "j.knead", facts);
    EXPECT_EQ(read_journal_facts(folder / "j.knead").session, "");
}

TEST(JournalFacts, AStateIsTheSameAfterGoingBackAndForth) {
    const auto all = lines({act, act, undo, redo, CheckLine{}, undo, act});
    const std::vector<std::uint64_t> states{0, 1, 2, 1, 2, 2, 1, 3};
    for (std::size_t count = 0; count < states.size(); ++count)
        EXPECT_EQ(state_after(all, count), states[count]) << count;
    EXPECT_EQ(state_after(all, 100), 3U);
    EXPECT_EQ(state_after(lines({undo, redo}), 2), 0U) << "nothing to undo";
}

TEST(JournalFacts, WhatLedBackToWhatIsSavedIsNotLost) {
    EXPECT_EQ(lost_steps(lines({act, act}), 2), 0U);
    EXPECT_EQ(lost_steps(lines({act, act, undo, redo}), 2), 0U);
    EXPECT_EQ(lost_steps(lines({act, act, CheckLine{}}), 2), 0U);
    EXPECT_EQ(lost_steps(lines({act, act, undo}), 2), 1U) << "one that was taken back";
    EXPECT_EQ(lost_steps(lines({act}), 5), 0U);
    EXPECT_EQ(lost_steps({}, 0), 0U);
}

TEST(JournalFacts, LostStepsAreThoseThatAUserCounts) {
    EXPECT_EQ(lost_steps(lines({act, act, act, undo}), 2), 1U) << "it could be redone";
    EXPECT_EQ(lost_steps(lines({act, undo}), 0), 1U) << "and so could this";
    EXPECT_EQ(lost_steps(lines({act, undo, act, undo, act}), 0), 1U) << "the last is all there is";
    EXPECT_EQ(lost_steps(lines({act, undo, redo, undo, redo, undo, redo, act, act}), 1), 2U);
    EXPECT_EQ(lost_steps(lines({act, DragLine{}, SettleLine{}, DragLine{}, SettleLine{}}), 1), 2U);
    EXPECT_EQ(lost_steps(lines({act, SettleLine{}}), 1), 1U);
}

} // namespace knead::test
