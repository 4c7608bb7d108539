#pragma once
// What a journal's lines do not say: the session file that they belong to, and how much of them that file
// has. It stands in a file of its own beside the journal, which stays a session like any other.

#include "base/whole_file.h"
#include "edit/session.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

namespace knead {

struct JournalFacts {
    std::filesystem::path session;  // as which the work was saved last, or opened; empty: never
    std::optional<FileStamp> stamp; // of that file then
    std::size_t saved_lines = 0;    // so many of the journal's lines are in that file, too
    bool chooses_samples = false;   // whether their number is chosen by itself
    std::optional<FileStamp> cloud; // of the file that the cloud was read from, before it was
    bool operator==(const JournalFacts&) const = default;
};

// Where they stand.
std::filesystem::path journal_facts_file(const std::filesystem::path& journal);

// Writes them as a whole. Throws Error (output).
void write_journal_facts(const std::filesystem::path& journal, const JournalFacts& facts);

// Those of a journal; of one that has none, or none that can be read, that it was never saved. Never throws.
JournalFacts read_journal_facts(const std::filesystem::path& journal);

// What a recording that only grows has made after so many of its lines: the number of the last of its acts
// that is not undone, from 1; 0 at the beginning.
std::uint64_t state_after(std::span<const SessionLine> lines, std::size_t count);

// How much of a recording that only grows is worth restoring beyond the lines that are saved, for the user:
// acts that are not saved, done or to be redone, without what a drag settled; 1 where going back or forth is
// all that is new. Nothing, if the lines only led away from what was saved and back to it.
std::size_t lost_steps(std::span<const SessionLine> lines, std::size_t saved_lines);

} // namespace knead
