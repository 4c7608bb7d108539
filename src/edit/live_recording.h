#pragma once
// What a live document records: every act, in which step of undo it belongs, and the journal. Private to this
// room.

#include "base/progress.h"
#include "edit/handles.h"
#include "edit/journal.h"
#include "edit/journal_facts.h"
#include "edit/session.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace knead {

// Whether the file is a session rather than a cloud, by its first bytes; what cannot be read is none.
bool is_session(const std::filesystem::path& file, Progress& progress);

// A journal as a session, mended (edit/journal.h); `dropped` tells whether a last line was left out. Throws
// Error (input).
Session recovered_session(const std::filesystem::path& journal, bool& dropped);

class LiveRecording {
public:
    // `session` gives the header; its lines are not taken. With `restored`, that journal is gone on with, and
    // what is known of it (facts()) is, too.
    LiveRecording(const Session& session, const std::optional<std::filesystem::path>& restored);

    // From the next act on there is a journal in that folder (none, if it is empty) that holds everything. So
    // a session that was only looked at leaves none. Functions that record throw Error (output) when it
    // cannot be written; then the act counts all the same.
    void keep_journal(const std::filesystem::path& folder) { folder_ = folder; }
    // Removes the journal: what it holds is not wanted, or was saved. The next act begins another.
    void discard();

    const JournalFacts& facts() const { return facts_; }
    // All that was recorded so far is in that file.
    void is_in(const std::filesystem::path& session);
    void chooses_samples(bool by_itself);
    // The file that the cloud was read from, as it was before it was read.
    void is_on(const std::optional<FileStamp>& cloud);

    // Document and recording stay in step where memory runs out: what a line needs is made before the
    // document carries it out. Where what records it afterwards throws, only the journal lacks it, until the
    // next line is written.

    // An act as it will stand here, of the step before it, or the first of a new one; `handles` are those
    // before it. The frames of a drag may still be put into its line.
    class Coming;
    Coming coming(SessionAction act, bool joins_step, std::span<const Handle> handles);
    // One that follows from the step before it, and goes by its name: what settles, and what is chosen by
    // itself. What it says of itself may still change (SettleLine, which takes no memory).
    Coming coming_to_last(SessionAction act);
    // Room for a step back or forward.
    void make_room();

    // An act that the document has carried out since it was coming. What could be redone is forgotten.
    void add(Coming act);
    // A line that is no act of the document (`check`).
    void note(const SessionAction& line);
    // The last act was undone, the next one redone. What is undone only to look at it stays as done in the
    // journal until something else is recorded: playing a session is no work that a crash could lose. What
    // was redone only to look at it is undone for good when one goes back.
    void step_back(bool to_look);
    void step_forward(bool to_look);

    // What the newest act does that was not undone, in a few words; empty at the beginning.
    std::string last_words() const { return past_.empty() ? std::string() : past_.back().words; }

    // And the step that would be redone next.
    std::string next_words() const;

    // How many frames the drag has that the newest step began with; 0: it is none.
    std::size_t last_frames() const;

    bool can_undo() const { return !past_.empty(); }
    bool can_redo() const { return !future_.empty(); }
    bool last_is_settings() const;                                           // of the acts that can be undone
    bool last_joins() const { return !past_.empty() && past_.back().joins; } // of the acts that can be undone
    bool next_joins() const {
        return !future_.empty() && future_.back().joins;
    } // of those that can be redone
    // Of every act, those that can be redone included, in the order in which they were done.
    std::vector<bool> which_join() const;
    std::size_t undoable_steps() const;
    std::size_t redoable_steps() const;

    // Names what is recorded: the number of the last act that is not undone, 0 at the beginning. What is
    // undone only to look at it is as good as done.
    std::uint64_t state() const;

    std::size_t acts() const { return lines_.size(); }
    const std::filesystem::path& cloud() const { return cloud_; } // absolute
    // The same cloud, by another name: what was saved does not say so.
    void lies_at(const std::filesystem::path& cloud, const std::optional<FileStamp>& stamp);

    // Writes all of it as a session file, with paths relative to it; what was undone only to look at it is in
    // it as done. Throws Error (output).
    void save(const std::filesystem::path& target) const;
    // The digest by which a session knows its cloud again, which saved ones and journals to come carry.
    const std::optional<std::string>& sha256() const { return header_.sha256; }
    void set_sha256(std::string digest) { header_.sha256 = std::move(digest); }

private:
    void write_down(SessionAction line);
    void write_missing_lines();
    void write_facts();
    void undo_what_was_looked_back();
    Journal begin_journal(const std::filesystem::path& folder) const;
    void begin_journal_again(const std::string& lines);

    Session header_;
    std::filesystem::path cloud_;
    std::vector<SessionAction> lines_;
    std::size_t looked_back_ = 0;    // so many `undo` lines are still to follow
    std::size_t looked_forward_ = 0; // so many acts before here were redone to look at them
    struct Act {
        bool joins = false; // the step of the act before it
        bool of_settings = false;
        std::uint64_t number = 0; // from 1
        std::string words = {};
        std::size_t frames = 0; // of a drag
        std::size_t kind = 0;   // of its line
        std::size_t alike = 1;  // acts of the step up to it that are of that kind, one after the other
    };
    std::vector<Act> past_, future_;
    std::uint64_t last_number_ = 0;
    std::filesystem::path folder_; // of the journal; empty: none is kept
    std::optional<Journal> journal_;
    JournalFacts facts_;
    bool facts_are_written_ = false;
    std::size_t written_ = 0; // lines that the journal has; a restored one has more than were replayed so far
};

class LiveRecording::Coming {
public:
    SessionAction line;

private:
    friend class LiveRecording;
    Coming(SessionAction coming, Act what) : line(std::move(coming)), act(std::move(what)) {}
    Act act;
};

} // namespace knead
