#include "edit/live_work.h"

#include "base/error.h"
#include "base/require.h"
#include "edit/live_opening.h"
#include "view/framing.h"

#include <exception>
#include <utility>

namespace knead {

namespace {

using Stage = LiveDocument::Stage;

// Frames of a pose that rests come no faster than this, in seconds, nor, up to the second number, than the
// window takes them: nobody sees more, the recording stays short, and the window has the processor to itself
// meanwhile.
constexpr double shortest_frame = 0.008, longest_frame = 0.05;

// A hand that does nothing for so many seconds rests: frames of all samples, during which it would have to
// wait, do not come in between.
constexpr double hand_rests = 0.1;

// Other editors are looked for at most this often while acts are carried out, in seconds.
constexpr double between_looks = 2;

bool ends_drag(const LiveTask& task) {
    return std::holds_alternative<task::EndDrag>(task) || std::holds_alternative<task::CancelDrag>(task);
}

} // namespace

LiveWork::LiveWork(OpenRequest request, Locked<LiveShared>& shared)
    : request_(std::move(request)), shared_(shared), progress_(shared), workers_(request_.threads),
      publisher_(shared, workers_) {}

void LiveWork::open() {
    std::string about_journal;
    if (!request_.restore) take_note(files_.known, request_.file);
    Session session = session_to_open(request_, progress_, about_journal);
    if (!about_journal.empty()) say(Notice::Kind::warning, about_journal);
    const bool is_plain_cloud = session.file.empty();
    PointCloud cloud = read_cloud_of(session);
    for (const std::string& remark : cloud.remarks) say(Notice::Kind::warning, remark);
    UpsamplerChoice choice = request_.make_upsampler(request_.device, workers_, request_.threads);
    if (!choice.warning.empty()) say(Notice::Kind::warning, choice.warning);
    upsampler_ = std::move(choice.upsampler);
    choice_.by_itself = !request_.restore && !request_.settings.samples &&
                        (is_plain_cloud ? request_.choose_samples : request_.session_chooses_samples);
    if (choice_.by_itself && is_plain_cloud)
        session.settings.samples = knead::choose_samples({cloud.size(), {}, {}}).samples;
    document_ = std::make_unique<Document>(std::move(cloud), session.settings, workers_, *upsampler_);
    recording_ = std::make_unique<LiveRecording>(session, request_.restore);
    if (request_.restore)
        belong_to_session_of(recording_->facts());
    else if (!is_plain_cloud)
        files_.session = std::filesystem::absolute(request_.file);
    tell_what_is_open();
    document_->shape(progress_); // the order of the points
    replay_session(session, *document_, *recording_, progress_);
    if (request_.restore && !files_.session.empty())
        files_.saved.session_state = state_after(session.lines, recording_->facts().saved_lines);
    // One that was opened with another cloud than it names is not saved before it names that.
    if (!request_.restore && !request_.cloud) files_.saved.session_state = recording_->state();
    if (!request_.restore && !is_plain_cloud) recording_->is_in(files_.session);
    recording_->chooses_samples(choice_.by_itself);
    recording_->is_on(files_.cloud_stamp);
    if (!is_plain_cloud && request_.sets_session) take_settings();
    publish_opened();
    begin_digest();
    if (!request_.restore) recording_->keep_journal(request_.journal_folder);
}

// Those that were asked for with a session, as if the user had set them at its end.
void LiveWork::take_settings() {
    const SetLine line{request_.settings};
    if (changed(document_->settings(), line.change) == document_->settings()) return;
    StepSoFar step;
    carry_out_line(line, false, true, step);
    settling_.wanted = document_->is_posed();
}

PointCloud LiveWork::read_cloud_of(Session& session) {
    const std::filesystem::path file = request_.cloud ? *request_.cloud : session.resolve(session.cloud);
    take_note(files_.known, file);
    files_.cloud_stamp = stamp_of(file);
    try {
        if (request_.restore && !request_.cloud) refuse_changed_cloud(file, *request_.restore);
        return cloud_to_open(request_, session, progress_);
    } catch (const Error&) {
        shared_.with([&](LiveShared& s) { s.status.wants_cloud = !session.file.empty(); });
        throw;
    }
}

// A restored one is saved where it was saved before, unless somebody else wrote there meanwhile, and goes on
// choosing its samples if it did.
void LiveWork::belong_to_session_of(const JournalFacts& facts) {
    files_.session = facts.session;
    if (facts.stamp) take_note(files_.known, facts.session, *facts.stamp);
    choice_.by_itself = facts.chooses_samples;
}

// What the acts of a step did, one after the other.
std::vector<std::vector<Document::PivotMove>> LiveWork::pivot_moves_of_steps() const {
    const std::vector<std::vector<Document::PivotMove>> of_acts = document_->pivot_moves();
    const std::vector<bool> joins = recording_->which_join();
    require(joins.size() == of_acts.size(), "the recording has the document's acts");
    std::vector<std::vector<Document::PivotMove>> of_steps;
    for (std::size_t act = 0; act < of_acts.size(); ++act) {
        if (!joins[act]) of_steps.emplace_back();
        of_steps.back().insert(of_steps.back().end(), of_acts[act].begin(), of_acts[act].end());
    }
    return of_steps;
}

void LiveWork::publish_opened() {
    OpenedCloud opened;
    opened.file = recording_->cloud();
    opened.cloud = &document_->cloud();
    opened.order = &document_->pipeline().order();
    opened.opened = document_->pipeline().keep_opened();
    opened.bounds = document_->bounds();
    opened.spacing = usual_spacing(opened.opened->positions);
    opened.last_pivots = document_->last_pivots();
    opened.pivot_moves = pivot_moves_of_steps();
    publish_shape(false);
    publish_view();
    shared_.with([&](LiveShared& s) {
        if (s.stop) throw Cancelled(); // or the window would look at what is about to go
        s.opened = opened;
        s.saved = files_.saved;
        s.status.stage = Stage::open;
        s.status.busy = something_to_do();
        s.status.doing.clear();
    });
}

// --- The loop ---

template<typename Do>
void LiveWork::guarded(Do&& work) {
    try {
        std::forward<Do>(work)();
    } catch (const Cancelled&) {
        // The window is closing; turn() sees it.
    } catch (...) {
        tell_of_exception(shared_);
    }
}

bool LiveWork::turn() {
    wait_for_next_frame();
    std::list<LiveTask> task; // one, or none
    const bool more = shared_.when(
        [&](const LiveShared& s) {
            return s.stop || !s.inbox.empty() || (play_ ? plays_on(s) : s.wanted || something_to_do());
        },
        [&](LiveShared& s) {
            s.status.busy = true;
            if (!drag_ && !after_drag_.empty()) {
                task.splice(task.end(), after_drag_, after_drag_.begin());
            } else if (!s.inbox.empty()) {
                task.splice(task.end(), s.inbox, s.inbox.begin());
            } else if (s.wanted) {
                if (drag_) take_wanted(*s.wanted);
                s.wanted.reset();
            }
            return !s.stop;
        });
    if (!more) return false;
    if (!task.empty() && drag_ && !ends_drag(task.front()))
        after_drag_.splice(after_drag_.end(), task); // acts do not come in between
    else
        take_turn(task);
    guarded([&] { rest_if_idle(); });
    return true;
}

// Carries out a task, or goes on with what is under way.
void LiveWork::take_turn(std::list<LiveTask>& task) {
    if (task.empty()) return guarded([&] { go_on(); });
    LiveTask& one = task.front();
    // A cloud is saved as it is seen; whatever else comes, comes after the whole step.
    if (!std::holds_alternative<task::SaveCloud>(one)) guarded([&] { finish_playing(); });
    guarded([&] { std::visit([&](auto& t) { carry_out(t); }, one); });
    if (const auto count = count_of(one)) shared_.with([&](LiveShared& s) { --(s.*count); });
    if (others_.since_look.seconds() > between_looks) guarded([&] { look_for_others(); });
}

void LiveWork::end() {
    document_->abandon();
    drag_.reset();
    const bool keep = shared_.with([](const LiveShared& s) { return s.keep_journal; });
    if (recording_ && !keep) recording_->discard();
}

void LiveWork::wait_for_next_frame() {
    if (play_) {
        const double left = shared_.with([&](const LiveShared& s) { return seconds_to_next_picture(s); });
        if (left > 0)
            shared_.wait(left, [&](const LiveShared& s) {
                return s.stop || !s.inbox.empty() || s.pace.held || s.pace.frames != 0;
            });
        return;
    }
    if (!something_to_do()) return;
    const auto wait = [&](double until, auto&& enough) {
        const double left = until - since_frame_.seconds();
        if (left <= 0) return;
        shared_.wait(
            left, [&](const LiveShared& s) { return s.stop || !s.inbox.empty() || s.wanted || enough(s); });
    };
    wait(shortest_frame, [](const LiveShared&) { return false; });
    if (drag_ && drag_->repeats_pose() && drag_->is_coarse)
        wait(hand_rests, [](const LiveShared&) { return false; });
    if (drag_ && drag_->repeats_pose())
        wait(longest_frame, [&](const LiveShared& s) {
            return s.frame.version != publisher_.shapes() && !s.drawn.on_device;
        });
}

bool LiveWork::something_to_do() const {
    if (drag_) return !drag_->rests; // all else waits for its end
    return !after_drag_.empty() || ahead_ || settling_.wanted;
}

void LiveWork::go_on() {
    if (play_) return play_on();
    if (drag_) return drag_->rests ? void() : follow();
    if (ahead_) {
        ahead_ = false;
        document_->prepare_ahead(progress_);
        document_->make_spare_shapes();
        choose_samples();
        return publish_view();
    }
    if (settling_.wanted) settle();
}

void LiveWork::tell_what_is_open() {
    std::vector<std::filesystem::path> files{recording_->cloud()};
    if (!files_.session.empty()) files.push_back(files_.session);
    others_.open_files.reset();
    others_.open_files.emplace(request_.journal_folder, files);
    look_for_others();
}

// After this one told what it has open itself: so of two that open a file at once, one sees the other.
bool LiveWork::look_for_others(const std::filesystem::path& file) {
    const std::vector<pid_t> others = others_.open_files->others_with(file);
    for (const pid_t process : others) {
        const std::string words = "Another knead (process " + std::to_string(process) + ") has " +
                                  file.string() + " open, too: of what both save there, the last stays.";
        if (others_.told.insert(words).second) say(Notice::Kind::warning, words);
    }
    return !others.empty();
}

// Whoever has the session has its cloud, too.
void LiveWork::look_for_others() {
    others_.since_look = Stopwatch();
    if (files_.session.empty() || !look_for_others(files_.session)) look_for_others(recording_->cloud());
}

void LiveWork::rest_if_idle() {
    const std::string warning = upsampler_->take_warning();
    if (!warning.empty()) say(Notice::Kind::warning, warning);
    shared_.with([&](LiveShared& s) {
        s.status.solving = (drag_ && !drag_->rests) || settling_.wanted;
        s.status.busy = play_ ? plays_on(s) : something_to_do();
        s.status.playing = what_plays(s);
        s.status.doing.clear();
    });
}

// --- Telling the window ---

void LiveWork::show_document() {
    publish_view(); // first: it takes next to no memory
    publish_shape(false);
}

LivePublisher::FrameFacts LiveWork::facts_of_frame(bool of_drag) const {
    LivePublisher::FrameFacts facts;
    if (of_drag) facts.pose_set = drag_->wanted->set;
    facts.solve = solve_seconds_;
    if (!document_->log().upsample.empty()) facts.upsample = document_->log().upsample.back();
    return facts;
}

void LiveWork::publish_shape(bool of_drag) {
    auto shape = document_->keep_shown(progress_);
    publisher_.shape(std::move(shape), document_->pipeline(), facts_of_frame(of_drag));
    since_frame_ = Stopwatch();
}

// The last frame of the drag. The points themselves follow when the shape has come to rest.
void LiveWork::publish_drag() {
    if (!document_->drawn_frame() || drag_->rests) return publish_shape(true);
    publisher_.drawn(document_->drawn_frame(), facts_of_frame(true));
    since_frame_ = Stopwatch();
}

void LiveWork::publish_view() {
    publisher_.view(*document_, *recording_,
                    {drag_.has_value() || settling_.wanted, last_step_, upsampler_->device(), files_.session,
                     files_.saved, choice_.by_itself, suited_samples()});
}

void LiveWork::refuse(StepNumber step, bool ends_redo) {
    refused_.insert(step);
    publisher_.refuse({step, ends_redo});
}

void tell_of_exception(Locked<LiveShared>& shared) noexcept {
    try {
        Notice notice{.kind = Notice::Kind::error, .words = words_about_exception()};
        shared.with([&](LiveShared& s) { s.notices.push_back(std::move(notice)); });
    } catch (const std::exception&) {
        shared.with([](LiveShared& s) { s.lacked_memory = true; });
    }
}

void run_live_document(OpenRequest request, Locked<LiveShared>& shared) noexcept {
    const auto fail = [&] { shared.with([](LiveShared& s) { s.status.stage = Stage::failed; }); };
    try {
        LiveWork work(std::move(request), shared);
        work.open();
        while (work.turn()) {
        }
        work.end();
    } catch (const Cancelled&) {
        fail();
    } catch (...) {
        tell_of_exception(shared); // first: who sees that it failed looks for why
        fail();
    }
}

} // namespace knead
