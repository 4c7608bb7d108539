#include "edit/live_recording.h"

#include "base/counts.h"
#include "base/error.h"
#include "base/quoted.h"
#include "base/whole_file.h"
#include "edit/handle_lines.h"

#include <algorithm>
#include <utility>

namespace knead {

namespace {

bool are_one_file(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code ignored;
    return std::filesystem::equivalent(a, b, ignored);
}

// Absolute and without "..", but where that leads elsewhere because a folder on the way is a link.
std::filesystem::path plain_path(const std::filesystem::path& path) {
    const std::filesystem::path whole = std::filesystem::absolute(path), plain = whole.lexically_normal();
    std::error_code ignored;
    const bool leads_elsewhere = std::filesystem::exists(whole, ignored) && !are_one_file(whole, plain);
    return leads_elsewhere ? std::filesystem::weakly_canonical(whole, ignored) : plain;
}

// The way from a folder to a path: as they are named, or where that leads elsewhere, by their real names. A
// path that is nowhere keeps its name.
std::filesystem::path relative_to(const std::filesystem::path& path, const std::filesystem::path& folder) {
    std::error_code ignored;
    std::filesystem::path way = path.lexically_relative(folder);
    if (way.empty() || !std::filesystem::exists(path, ignored)) return way.empty() ? path : way;
    if (are_one_file(folder / way, path)) return way;
    const std::filesystem::path real = std::filesystem::weakly_canonical(path, ignored);
    return real.lexically_relative(std::filesystem::weakly_canonical(folder, ignored));
}

// What an act did, in a few words: one for each kind of line, so that none is forgotten.
struct WordsAboutAct {
    std::span<const Handle> handles; // before it
    std::string operator()(const HandleLine& line) const { return words_about(line, handles); }
    std::string operator()(const DragLine& line) const {
        if (line.with.empty()) return quoted(line.handle) + " posed";
        if (line.with.size() == 1)
            return quoted(line.handle) + " and " + quoted(line.with[0].handle) + " posed";
        return quoted(line.handle) + " and " + std::to_string(line.with.size()) + " more posed";
    }
    std::string operator()(const SettleLine& /*line*/) const { return "settled"; }
    std::string operator()(const CommitLine& /*line*/) const { return "pose committed"; }
    std::string operator()(const SetLine& /*line*/) const { return "settings changed"; }
    std::string operator()(const DeleteLine& line) const { return quoted(line.handle) + " deleted"; }
    std::string operator()(const RenameLine& line) const {
        return quoted(line.handle) + " is now " + quoted(line.to);
    }
    std::string operator()(const CheckLine& /*line*/) const { return {}; } // no acts
    std::string operator()(const UndoLine& /*line*/) const { return {}; }
    std::string operator()(const RedoLine& /*line*/) const { return {}; }
};

template<typename Acts>
std::size_t count_steps(const Acts& acts) {
    return static_cast<std::size_t>(std::ranges::count_if(acts, [](const auto& act) { return !act.joins; }));
}

} // namespace

bool is_session(const std::filesystem::path& file, Progress& progress) {
    progress.step("reading", 0);
    return looks_like_session(first_bytes_of_file(file, 1024));
}

Session recovered_session(const std::filesystem::path& journal, bool& dropped) {
    SilentProgress silent;
    const std::vector<std::byte> bytes = read_whole_file(journal, silent);
    MendedText text = mended({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, journal);
    dropped = text.dropped;
    return parse_session(text.text, journal);
}

LiveRecording::LiveRecording(const Session& session, const std::optional<std::filesystem::path>& restored)
    : header_(session), cloud_(plain_path(session.resolve(session.cloud))) {
    header_.lines.clear();
    if (restored) {
        journal_ = Journal::take_over(*restored);
        facts_ = read_journal_facts(*restored);
        facts_are_written_ = true;
        written_ = session.lines.size();
        const Session before = parse_session(session.header_text + "\n", *restored);
        if (plain_path(before.resolve(before.cloud)) == cloud_) return;
        std::string lines;
        for (const SessionLine& line : session.lines) lines += (lines.empty() ? "" : "\n") + line.text;
        begin_journal_again(lines);
    }
}

void LiveRecording::lies_at(const std::filesystem::path& cloud, const std::optional<FileStamp>& stamp) {
    cloud_ = plain_path(cloud);
    facts_.cloud = stamp;
    facts_.saved_lines = 0;
    if (!journal_) return;
    std::string lines;
    for (std::size_t number = 0; number < written_; ++number)
        lines += (lines.empty() ? "" : "\n") + to_text(lines_[number]);
    begin_journal_again(lines);
}

Journal LiveRecording::begin_journal(const std::filesystem::path& folder) const {
    Session header = header_;
    header.cloud = cloud_;
    return Journal::create(folder, header_text(header));
}

// The cloud lies elsewhere now: a journal says where in its first line.
void LiveRecording::begin_journal_again(const std::string& lines) {
    try {
        Journal again = begin_journal(journal_->file().parent_path());
        try {
            if (!lines.empty()) again.append(lines);
            write_journal_facts(again.file(), facts_);
        } catch (...) {
            again.discard();
            throw;
        }
        journal_->discard();
        journal_ = std::move(again);
    } catch (const Error&) {
        // The old one holds all acts, and where the cloud is can be told again.
    }
}

void LiveRecording::discard() {
    if (journal_) journal_->discard();
    if (journal_) folder_ = journal_->file().parent_path();
    journal_.reset();
    written_ = 0;
}

void LiveRecording::is_in(const std::filesystem::path& session) {
    facts_.session = std::filesystem::absolute(session);
    facts_.stamp = stamp_of(session);
    facts_.saved_lines = lines_.size();
    write_facts();
}

void LiveRecording::chooses_samples(bool by_itself) {
    if (std::exchange(facts_.chooses_samples, by_itself) != by_itself) write_facts();
}

void LiveRecording::is_on(const std::optional<FileStamp>& cloud) {
    if (std::exchange(facts_.cloud, cloud) != cloud) write_facts();
}

void LiveRecording::make_room() {
    const auto for_more = [](auto& list, std::size_t more) {
        if (list.capacity() - list.size() < more) list.reserve(2 * list.size() + more);
    };
    for_more(past_, 1);
    for_more(future_, 1);
    for_more(lines_, looked_back_ + 1);
}

LiveRecording::Coming LiveRecording::coming(SessionAction act, bool joins_step,
                                            std::span<const Handle> handles) {
    make_room();
    Act made{joins_step && !past_.empty(), std::holds_alternative<SetLine>(act), 0,
             std::visit(WordsAboutAct{handles}, act)};
    if (made.words.empty()) made.words = made.joins ? last_words() : "a handle as it was";
    made.kind = act.index();
    if (made.joins && past_.back().kind == made.kind) made.alike = past_.back().alike + 1;
    if (made.alike > 1 && std::holds_alternative<DeleteLine>(act))
        made.words = counted(made.alike, "handle") + " deleted";
    if (made.alike > 1 && std::holds_alternative<DragLine>(act))
        made.words = counted(made.alike, "handle") + " posed";
    return {std::move(act), std::move(made)};
}

LiveRecording::Coming LiveRecording::coming_to_last(SessionAction act) {
    make_room();
    // Another movement of a slider still joins what settled after it.
    return {std::move(act), {!past_.empty(), last_is_settings(), 0, last_words()}};
}

void LiveRecording::add(Coming act) {
    act.act.number = ++last_number_;
    if (const auto* drag = std::get_if<DragLine>(&act.line)) act.act.frames = drag->frames.size();
    past_.push_back(std::move(act.act));
    future_.clear();
    looked_forward_ = 0;
    write_down(std::move(act.line));
}

void LiveRecording::note(const SessionAction& line) {
    make_room();
    looked_forward_ = 0;
    write_down(line);
}

void LiveRecording::step_back(bool to_look) {
    make_room();
    future_.push_back(std::move(past_.back()));
    past_.pop_back();
    const std::size_t forward = looked_forward_;
    looked_forward_ = to_look && forward > 0 ? forward - 1 : 0;
    if (to_look && forward == 0)
        ++looked_back_;
    else
        write_down(UndoLine{});
}

void LiveRecording::step_forward(bool to_look) {
    make_room();
    past_.push_back(std::move(future_.back()));
    future_.pop_back();
    if (looked_back_ > 0) {
        --looked_back_;
        return;
    }
    looked_forward_ = to_look ? looked_forward_ + 1 : 0;
    write_down(RedoLine{});
}

bool LiveRecording::last_is_settings() const {
    return !past_.empty() && past_.back().of_settings;
}

std::string LiveRecording::next_words() const {
    std::string words;
    for (auto act = future_.rbegin(); act != future_.rend(); ++act) {
        if (act != future_.rbegin() && !act->joins) break;
        words = act->words;
    }
    return words;
}

std::size_t LiveRecording::last_frames() const {
    const auto first = std::find_if(past_.rbegin(), past_.rend(), [](const Act& act) { return !act.joins; });
    return first == past_.rend() ? 0 : first->frames;
}

std::vector<bool> LiveRecording::which_join() const {
    std::vector<bool> joins;
    for (const Act& act : past_) joins.push_back(act.joins);
    for (auto act = future_.rbegin(); act != future_.rend(); ++act) joins.push_back(act->joins);
    return joins;
}

std::size_t LiveRecording::undoable_steps() const {
    return count_steps(past_);
}

std::size_t LiveRecording::redoable_steps() const {
    return count_steps(future_);
}

// Acts that are looked back from wait last among those to be redone, the newest first.
std::uint64_t LiveRecording::state() const {
    if (looked_back_ > 0) return future_[future_.size() - looked_back_].number;
    return past_.empty() ? 0 : past_.back().number;
}

void LiveRecording::save(const std::filesystem::path& target) const {
    const std::filesystem::path folder = plain_path(std::filesystem::absolute(target).parent_path());
    Session header = header_;
    header.cloud = relative_to(cloud_, folder);
    FileInTheMaking file(target);
    file.write(header_text(header) + "\n");
    for (SessionAction line : lines_) {
        if (auto* check = std::get_if<CheckLine>(&line))
            check->positions = relative_to(plain_path(check->positions), folder);
        file.write(to_text(line) + "\n");
    }
    file.commit();
}

void LiveRecording::undo_what_was_looked_back() {
    for (; looked_back_ > 0; --looked_back_) lines_.emplace_back(UndoLine{});
}

// There is room for it, and all else is done: what can fail is the journal. Lines that could not be written
// are made up for before the next one, so that none is ever missing in between.
void LiveRecording::write_down(SessionAction line) {
    undo_what_was_looked_back();
    lines_.push_back(std::move(line));
    if (!journal_ && folder_.empty()) return;
    if (!journal_) {
        journal_ = begin_journal(folder_);
        facts_are_written_ = false;
    }
    if (written_ < lines_.size()) write_missing_lines();
    if (!facts_are_written_) write_facts();
}

// In one go: every write is synced, and the lines of a long session would keep the hand waiting.
void LiveRecording::write_missing_lines() {
    std::string missing;
    for (std::size_t number = written_; number < lines_.size(); ++number)
        missing += (missing.empty() ? "" : "\n") + to_text(lines_[number]);
    journal_->append(missing);
    written_ = lines_.size();
}

void LiveRecording::write_facts() {
    if (!journal_) return;
    facts_are_written_ = false; // and if this fails, the next line tries again
    write_journal_facts(journal_->file(), facts_);
    facts_are_written_ = true;
}

} // namespace knead
