// The acts of the document's thread: lines, undo and redo, saving.

#include "edit/live_work.h"

#include "base/counts.h"
#include "base/error.h"
#include "base/require.h"
#include "edit/document_acts.h"
#include "edit/handle_motion.h"
#include "edit/kept_original.h"
#include "edit/live_opening.h"
#include "edit/measures.h"
#include "edit/way_back.h"
#include "io/cloud_file.h"
#include "io/digest.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace knead {

namespace {

// Of points of the file, in the shape that this edit began with.
Vec3d middle_at_rest(const Document& document, std::span<const IndexRange> points) {
    Vec3d sum = Vec3d::Zero();
    double count = 0;
    std::vector<bool> is_held(document.cloud().size(), false);
    for (const IndexRange& range : points)
        for (std::uint64_t i = range.first; i <= range.last; ++i) is_held[i] = true;
    const std::shared_ptr<const RestShape> committed = document.kept_rest();
    const RestShape& rest = committed ? *committed : document.pipeline().opened();
    const std::vector<Index>& file_index = document.pipeline().order().file_index;
    for (std::size_t point = 0; point < file_index.size(); ++point) {
        if (!is_held[file_index[point]]) continue;
        sum += point_at(rest.positions, point);
        ++count;
    }
    return count > 0 ? Vec3d(sum / count) : sum;
}

// What of a document a line would change that stays as it is while a pose stands.
std::string kept_of(const SessionAction& line) {
    return std::holds_alternative<SetLine>(line) ? "samples, neighbours and strays" : "handles";
}

} // namespace

// One line of a step, and a commit before it where it may not stand while handles are posed.
void LiveWork::carry_out_line(const SessionAction& line, bool joins, bool pose_is_seen, StepSoFar& step) {
    if (document_->needs_commit(line)) {
        carry_out_and_record(CommitLine{}, step.done > 0 || joins);
        ++step.done;
        step.told_of_commit |= pose_is_seen;
        if (pose_is_seen)
            publisher_.say(Notice::Kind::information,
                           "The pose became the new rest shape first: while it stands, " + kept_of(line) +
                               " cannot change. Ctrl+Z takes both back.",
                           Notice::About::committed);
    }
    carry_out_and_record(line, step.done > 0 || joins);
    ++step.done;
}

void LiveWork::carry_out(task::Lines& lines) {
    const bool is_seen = shared_.with([](const LiveShared& s) { return s.view->posed; });
    StepSoFar step;
    const struct FramesAreSeen {
        Document& document;
        ~FramesAreSeen() { document.on_frame = nullptr; }
    } until_the_end{*document_};
    try {
        finish_settling();
        const bool joins = lines.joins_last && recording_->last_is_settings();
        const auto is_drag = [](const SessionAction& line) { return std::holds_alternative<DragLine>(line); };
        if (std::ranges::all_of(lines.lines, is_drag)) // what was wound up is seen to unwind
            document_->on_frame = [this] { publish_shape(false); };
        for (const SessionAction& line : lines.lines) carry_out_line(line, joins, is_seen, step);
    } catch (...) {
        for (std::size_t i = 0; i < step.done; ++i) take_back_act(false); // first: half a step must not stay
        refuse(lines.step, step.done > 0);
        if (step.told_of_commit) publisher_.say(Notice::Kind::information, {}, Notice::About::committed);
        show_document();
        throw;
    }
    last_step_ = lines.step;
    ahead_ = choice_.is_due = true;
    // New settings show at once on a pose that stands; nothing else leaves one.
    settling_.wanted = document_->is_posed();
    if (!settling_.wanted) publisher_.demand({});
    show_document();
}

// A step whose lines are made when its turn comes, of what there is by then. It is refused where there are
// none, or where making them fails.
void LiveWork::carry_out_made(StepNumber step, const std::function<std::vector<SessionAction>()>& make) {
    task::Lines lines{step, {}, false};
    try {
        lines.lines = make();
    } catch (...) {
        refuse(step);
        throw;
    }
    if (lines.lines.empty()) return refuse(step);
    carry_out(lines);
}

void LiveWork::carry_out(task::EditHandle& task) {
    carry_out_made(task.step, [&] {
        std::vector<SessionAction> lines = lines_for(document_->handles(), task.edit);
        if (!lines.empty() && document_->needs_commit(lines.front())) // which takes the pivots along
            lines = lines_for(document_->handles_committed(), task.edit);
        return lines;
    });
}

HandleEdit LiveWork::edit_for(const PivotPlace& pivot) const {
    HandleEdit edit{.handle = pivot.handle};
    std::optional<Vec3d>& at_rest = edit.pivot.emplace().at_rest;
    const auto handle = number_of(document_->handles(), pivot.handle);
    if (pivot.place && handle) {
        const HandleMotion& motion = document_->motions()[*handle];
        const Vec3d& origin = document_->cloud().origin;
        at_rest = point_at_rest(motion, *pivot.place - origin) + origin;
    }
    return edit;
}

void LiveWork::carry_out(task::PutPivots& task) {
    carry_out_made(task.step, [&] {
        std::vector<SessionAction> lines;
        for (const PivotPlace& pivot : task.places)
            std::ranges::move(lines_for(document_->handles(), edit_for(pivot)), std::back_inserter(lines));
        return lines;
    });
}

void LiveWork::carry_out(task::MakePosed& task) {
    carry_out_made(task.step, [&] {
        finish_settling();
        std::vector<SessionAction> lines;
        // Declared again it would take a commit, and the other one's pose with it.
        if (!document_->has(task.line)) lines.emplace_back(task.line);
        std::vector<HandleMotion> way = document_->way_of(task.pose.handle);
        std::ranges::transform(way, way.begin(), task.pose.seen);
        const auto& points = std::get<std::vector<IndexRange>>(task.line.points);
        if (!way.empty())
            lines.emplace_back(way_there(task.line.name, way, middle_at_rest(*document_, points),
                                         document_->cloud().origin));
        return lines;
    });
}

// Of each that is not at rest a drag back there.
std::vector<SessionAction> LiveWork::ways_back(const std::vector<std::string>& handles) {
    std::vector<SessionAction> lines;
    for (const std::string& name : handles) {
        if (!moves(name)) continue; // it may have gone meanwhile
        const std::vector<HandleMotion> way = document_->way_of(name);
        if (is_back(way)) continue;
        const Handle* const handle = handle_named(document_->handles(), name);
        lines.emplace_back(way_back(name, way, middle_at_rest(*document_, ranges_of(*handle->points)),
                                    document_->cloud().origin));
    }
    return lines;
}

void LiveWork::carry_out(task::ResetPoses& task) {
    carry_out_made(task.step, [&] {
        finish_settling();
        return ways_back(task.handles);
    });
}

void LiveWork::carry_out(task::Undo& task) {
    finish_settling();
    choice_.is_due = false;
    if (refused_.contains(task.step) || !recording_->can_undo()) return;
    take_back_step(task.to_look);
    publisher_.say(Notice::Kind::information, {}, Notice::About::committed); // it may have been this
    show_where_it_rests();
}

void LiveWork::carry_out(task::Redo& task) {
    finish_settling();
    if (refused_.contains(task.step) || !recording_->can_redo()) return;
    do redo_act(task.to_look);
    while (recording_->next_joins());
    show_where_it_rests();
}

void LiveWork::redo_act(bool to_look) {
    recording_->make_room();
    document_->redo("");
    record([&] { recording_->step_forward(to_look); });
}

// After going back or forth; where that goes on at once, only the last shape is made.
void LiveWork::show_where_it_rests() {
    ahead_ = true; // other samples, perhaps
    publisher_.demand({});
    const bool goes_on = shared_.with([](const LiveShared& s) {
        return !s.inbox.empty() && (std::holds_alternative<task::Undo>(s.inbox.front()) ||
                                    std::holds_alternative<task::Redo>(s.inbox.front()));
    });
    if (goes_on)
        publish_view();
    else
        show_document();
}

// Somebody else's changes are lost only if the user says so.
bool LiveWork::hold_back(HeldSave save) {
    if (!was_changed(files_.known, save.target)) return false;
    shared_.with([&](LiveShared& s) { s.held_saves.push_back(std::move(save)); });
    return true;
}

void LiveWork::carry_out(task::SaveCloud& task) {
    come_to_rest();
    if (!task.anyway && hold_back({task.target, task.options})) return;
    look_for_others(task.target);
    const std::vector<std::uint8_t> left_out = left_out_of(task);
    std::filesystem::path copy; // of the original; empty: none is kept
    if (task.keeps_original && real_name(task.target) == real_name(recording_->cloud()))
        copy = copy_original();
    std::vector<std::string> heard;
    try {
        heard = write(task, left_out);
    } catch (...) {
        std::error_code ignored;
        if (!copy.empty()) std::filesystem::remove(copy, ignored);
        throw;
    }
    if (!copy.empty()) go_by_copy(copy);
    take_note(files_.known, task.target);
    say(Notice::Kind::information,
        "Saved the cloud as " + task.target.string() + words_about_left_out(left_out));
    if (!copy.empty())
        say(Notice::Kind::information, "The original is now " + copy.string() +
                                           ", and the session goes by that: save it (Ctrl+S) to go on "
                                           "later.");
    for (const std::string& words : heard) say(Notice::Kind::warning, words);
    publish_view();
}

// While it still is what was read.
std::filesystem::path LiveWork::copy_original() {
    const std::filesystem::path& cloud = recording_->cloud();
    begin_digest();
    if (files_.digest && files_.digest->get()) recording_->set_sha256(*files_.digest->get());
    if (stamp_of(cloud) != files_.cloud_stamp)
        throw Error(Trouble::input, cloud.string(),
                    "is not the file any more that was opened, so the original cannot be kept");
    std::filesystem::path copy = name_of_original(cloud);
    progress_.step("keeping the original", 0);
    keep_original(cloud, copy, progress_);
    return copy;
}

// A session that was saved names the file that now is another one.
void LiveWork::go_by_copy(const std::filesystem::path& copy) {
    files_.saved.session_state.reset();
    files_.cloud_stamp = stamp_of(copy);
    record([&] { recording_->lies_at(copy, files_.cloud_stamp); });
    take_note(files_.known, copy);
    tell_what_is_open();
}

// What the format could not hold, in words.
std::vector<std::string> LiveWork::write(const task::SaveCloud& task,
                                         std::span<const std::uint8_t> left_out) {
    const std::vector<float> positions = document_->positions(progress_);
    const std::vector<float> normals = document_->normals(progress_);
    const std::vector<float> far = task.options.displacement ? displacement_column() : std::vector<float>{};
    const std::vector<float> stretch = task.options.stretch ? stretch_column() : std::vector<float>{};
    const std::vector<float> rotations = document_->rotations(progress_);
    PosedShape shape{positions, normals, {}, rotations};
    if (task.options.displacement) shape.added.push_back({"displacement", far});
    if (task.options.stretch) shape.added.push_back({"stretch", stretch});
    if (left_out.empty()) return write_cloud(task.target, document_->cloud(), shape, progress_);
    return write_part(task.target, document_->cloud(), shape, left_out, progress_);
}

std::string LiveWork::words_about_left_out(std::span<const std::uint8_t> left_out) const {
    const auto all = static_cast<std::size_t>(std::ranges::count(left_out, std::uint8_t{1}));
    if (all == 0) return {};
    const std::size_t placeless = document_->cloud().size() - document_->pipeline().order().points();
    return ", without its " + counted(all - placeless, "hidden point") +
           (placeless > 0 ? " and " + counted(placeless, "point") + " without a place" : std::string());
}

// One a point of the file, 1 for those that are left out; empty where none is.
std::vector<std::uint8_t> LiveWork::left_out_of(const task::SaveCloud& task) const {
    if (!task.options.without_hidden || std::ranges::find(task.hidden, std::uint8_t{1}) == task.hidden.end())
        return {};
    const std::vector<Index>& file_index = document_->pipeline().order().file_index;
    require(task.hidden.size() == file_index.size(), "it is said of each point whether it is hidden");
    std::vector<std::uint8_t> left_out(document_->cloud().size(), 1); // what has no place is not seen either
    for (std::size_t i = 0; i < task.hidden.size(); ++i) left_out[file_index[i]] = task.hidden[i];
    return left_out;
}

void LiveWork::carry_out(task::SaveSession& task) {
    come_to_rest(); // or it would be unsaved again at once
    if (!task.anyway && hold_back({task.target, std::nullopt})) return;
    look_for_others(task.target);
    note_digest();
    recording_->save(task.target);
    take_note(files_.known, task.target);
    choice_.is_due = false; // or it would be unsaved again at once
    recording_->discard();  // the journal: a crash loses nothing of this any more
    recording_->is_in(task.target);
    files_.saved.session_state = recording_->state();
    files_.session = std::filesystem::absolute(task.target);
    tell_what_is_open();
    say(Notice::Kind::information, "Saved the session as " + task.target.string());
    publish_view();
}

// As early as may be: the file could be another one by the time that a session is saved.
void LiveWork::begin_digest() {
    if (files_.digest || !files_.cloud_stamp || recording_->sha256()) return;
    try {
        files_.digest.emplace(recording_->cloud(), *files_.cloud_stamp);
    } catch (
        const std::exception&) { // there is no memory or no thread for it now; the next time there may be
    }
}

// A session knows its cloud again, as it was when it was read. A file that was only touched, or copied to
// where it lay, is still that one.
void LiveWork::note_digest() {
    begin_digest();
    if (files_.digest && files_.digest->get()) recording_->set_sha256(*files_.digest->get());
    const std::filesystem::path& cloud = recording_->cloud();
    const std::optional<FileStamp> now = stamp_of(cloud);
    if (now && now == files_.cloud_stamp) return;
    bool is_as_read = false;
    try {
        is_as_read = now && recording_->sha256() && sha256_of_file(cloud) == *recording_->sha256();
    } catch (const Error&) { // it cannot even be read
    }
    if (is_as_read) return;
    const bool may_be = now && !recording_->sha256();
    say(Notice::Kind::warning,
        cloud.string() +
            (may_be ? " was written to since it was opened, and nobody knows whether its points are the same."
                    : " is not the file any more that was opened.") +
            " The session belongs to the points as they were: keep a copy of those, or it cannot be opened "
            "again.");
}

std::vector<float> LiveWork::in_file_order(std::span<const float> ordered, float left_out) {
    return knead::in_file_order(document_->pipeline().order(), ordered, document_->cloud().size(), left_out,
                                workers_);
}

std::vector<float> LiveWork::displacement_column() {
    const std::span<const float> opened = document_->pipeline().opened().positions;
    return in_file_order(displacements(opened, document_->shown(progress_).positions, workers_), 0);
}

std::vector<float> LiveWork::stretch_column() {
    document_->prepare_ahead(progress_); // the graph
    const Pipeline& pipeline = document_->pipeline();
    const RestShape& now = document_->shown(progress_);
    return in_file_order(local_stretch(pipeline.order(), pipeline.graph(), pipeline.opened().positions,
                                       now.positions, workers_),
                         1);
}

void LiveWork::carry_out_and_record(const SessionAction& line, bool joins) {
    auto coming = recording_->coming(line, joins, document_->handles());
    carry_out_act(*document_, line, "", progress_);
    record([&] { recording_->add(std::move(coming)); });
}

// Of the exception that is being handled. Where there is no memory to say it, the next line does.
void LiveWork::tell_of_journal() noexcept {
    if (told_of_journal_) return;
    try {
        try {
            throw;
        } catch (const Error& error) {
            say(Notice::Kind::error,
                words_in_window(error) +
                    ". Until it can be, a crash would lose what you do: save the session (Ctrl+S).");
        } catch (const std::bad_alloc&) {
            say(Notice::Kind::error, "There is not enough memory to write the recording now. It is made up "
                                     "for with the next step.");
        }
        told_of_journal_ = true;
    } catch (const std::exception&) {
    }
}

void LiveWork::take_back_act(bool to_look) {
    recording_->make_room();
    document_->undo("");
    record([&] { recording_->step_back(to_look); });
}

void LiveWork::take_back_step(bool to_look) {
    bool joins = false;
    do {
        joins = recording_->last_joins();
        take_back_act(to_look);
    } while (joins);
    settling_.wanted = false; // an undone pose is shown as it was
}

} // namespace knead
