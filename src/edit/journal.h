#pragma once
// The recording that is always on: a session file in the user's state folder that grows line by line, so that
// a crash loses at most the act that was going on.

#include "base/descriptor.h"
#include "edit/session.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace knead {

// $XDG_STATE_HOME/knead, or ~/.local/state/knead; empty when neither is known.
std::filesystem::path default_journal_folder();

// An open journal; owns the file and a lock on it that ends with the process.
class Journal {
public:
    // A new one in `folder`, which is made where it is missing. Throws Error (output).
    static Journal create(const std::filesystem::path& folder, const std::string& header);
    // One that a crash left, mended as below. Throws Error (input) when it is gone, cannot be read, or
    // another process has it; Error (output) when it cannot be mended.
    static Journal take_over(const std::filesystem::path& file);

    const std::filesystem::path& file() const { return file_; }

    // Appends a line, or several with line ends between them, and syncs. Throws Error (output) when the disk
    // is full or fails: then none of it is there.
    void append(std::string_view lines);
    // Removes the file and what stands beside it (edit/journal_facts.h): what it holds is kept elsewhere, or
    // not wanted.
    void discard();

private:
    Journal(std::filesystem::path file, Descriptor descriptor)
        : file_(std::move(file)), descriptor_(std::move(descriptor)) {}
    std::filesystem::path file_;
    Descriptor descriptor_; // carries the lock
};

// A journal's text as whole lines. The last one has no end where a crash cut it short: it counts if it can be
// read all the same, and is dropped if not. `file` is for errors, of which there are none.
struct MendedText {
    std::string text;
    bool dropped = false; // the last line
};
MendedText mended(std::string text, const std::filesystem::path& file);

// A journal that a crash left behind.
struct LostWork {
    std::filesystem::path journal;
    std::filesystem::path cloud;
    std::filesystem::path session; // as which it was saved last, or opened; empty: never
    std::size_t steps = 0;         // that are not in that file, lost_steps() of edit/journal_facts.h
    std::filesystem::file_time_type when = {};
    std::string trouble = {}; // why it cannot be read; then all else is unknown
};
// Journals of `folder` that hold what is saved nowhere and that no running knead has open, newest first; with
// those that cannot be read, which may. Those with nothing of the kind are removed on the way. Throws
// nothing but std::bad_alloc.
std::vector<LostWork> find_lost_work(const std::filesystem::path& folder);

} // namespace knead
