// The document's thread: takes tasks one after the other, follows the newest pose, and lets a pose that rests
// converge.

#include "base/error.h"
#include "base/stopwatch.h"
#include "edit/live_drag.h"
#include "edit/live_opening.h"
#include "edit/live_publisher.h"
#include "edit/live_recording.h"
#include "edit/live_shared.h"
#include "edit/measures.h"
#include "edit/session_cloud.h"
#include "io/cloud_file.h"
#include "upsample/devices.h"
#include "view/framing.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <set>
#include <utility>

namespace knead {

namespace {

using Stage = LiveDocument::Stage;

// A drag whose samples go less far than this in an iteration, over the cloud's size, shows no more change.
constexpr double still = 1e-7;

// So many frames of a drag may repeat one pose, and so many iterations may a released pose settle.
constexpr std::size_t most_repeats = 400;
constexpr double most_turned = 40 * std::numbers::pi;
constexpr unsigned most_settling = 1000;

// Iterations of settling between two frames on the screen.
constexpr unsigned settling_iterations = 9;

// Frames of a pose that rests come no faster than this, in seconds: nobody sees more, the recording stays
// short, and the window has the processor to itself meanwhile.
constexpr double shortest_frame = 0.008;

class LiveWork {
public:
    LiveWork(OpenRequest request, Locked<LiveShared>& shared)
        : request_(std::move(request)), shared_(shared), publisher_(shared), progress_(shared),
          workers_(request_.threads) {}

    void open() {
        Session session = session_to_open(request_, progress_);
        const bool is_plain_cloud = session.file.empty();
        PointCloud cloud = read_session_cloud(
            session, is_plain_cloud ? std::optional(request_.file) : std::nullopt, progress_);
        for (const std::string& remark : cloud.remarks) say(Notice::Kind::warning, remark);
        UpsamplerChoice choice = make_upsampler(request_.device, workers_, request_.threads);
        if (!choice.warning.empty()) say(Notice::Kind::warning, choice.warning);
        upsampler_ = std::move(choice.upsampler);
        session.points = cloud.size();
        document_ = std::make_unique<Document>(std::move(cloud), session.settings, workers_, *upsampler_);
        recording_ = std::make_unique<LiveRecording>(session, request_.restore);
        if (!request_.restore && !is_plain_cloud) session_file_ = std::filesystem::absolute(request_.file);
        document_->shape(progress_); // the order of the points
        replay_session(session, *document_, *recording_, progress_);
        if (!request_.restore) saved_.session_state = recording_->state();
        publish_opened();
        if (!request_.restore) recording_->keep_journal(request_.journal_folder);
    }

    // One turn of the loop; false when it is time to stop.
    bool turn() {
        wait_for_next_frame();
        std::optional<LiveTask> task;
        const bool more = shared_.when(
            [&](const LiveShared& s) { return s.stop || !s.inbox.empty() || s.wanted || something_to_do(); },
            [&](LiveShared& s) {
                s.status.busy = true;
                if (!drag_ && !after_drag_.empty()) {
                    task = std::move(after_drag_.front());
                    after_drag_.pop_front();
                } else if (!s.inbox.empty()) {
                    task = std::move(s.inbox.front());
                    s.inbox.pop_front();
                } else if (s.wanted) {
                    if (drag_) take_wanted(*s.wanted);
                    s.wanted.reset();
                }
                return !s.stop;
            });
        if (!more) return false;
        if (task && drag_ && !ends_drag(*task))
            after_drag_.push_back(std::move(*task)); // acts do not come in between
        else if (task)
            guarded([&] { std::visit([&](auto& t) { carry_out(t); }, *task); });
        else
            guarded([&] { go_on(); });
        rest_if_idle();
        return true;
    }

    void end() {
        document_->abandon();
        drag_.reset();
        const bool keep = shared_.with([](const LiveShared& s) { return s.keep_journal; });
        if (recording_ && !keep) recording_->discard();
    }

private:
    // --- Opening ---

    void publish_opened() {
        OpenedCloud opened;
        opened.file = recording_->cloud();
        opened.cloud = &document_->cloud();
        opened.order = &document_->pipeline().order();
        opened.opened = &document_->pipeline().opened();
        opened.bounds = document_->bounds();
        opened.spacing = usual_spacing(opened.opened->positions);
        publish_shape(document_->shape(progress_), false);
        publish_view();
        shared_.with([&](LiveShared& s) {
            if (s.stop) throw Cancelled(); // or the window would look at what is about to go
            s.opened = opened;
            s.saved = saved_;
            s.status.stage = Stage::open;
            s.status.busy = something_to_do();
            s.status.doing.clear();
        });
    }

    // --- Tasks ---

    void carry_out(task::Lines& lines) {
        finish_settling();
        std::size_t done = 0;
        const bool joins = lines.joins_last && recording_->last_is_settings();
        try {
            for (const SessionAction& line : lines.lines) {
                if (needs_commit(line) && document_->is_posed()) {
                    carry_out_act(*document_, CommitLine{}, "", progress_);
                    add_act(CommitLine{}, done++ > 0 || joins);
                    say(Notice::Kind::information,
                        "The pose was committed first, since this cannot change while one stands. Ctrl+Z "
                        "takes both back.");
                }
                carry_out_act(*document_, line, "", progress_);
                add_act(line, done++ > 0 || joins);
            }
        } catch (...) {
            refuse(lines.step);
            for (; done > 0; --done) take_back_act();
            show_document();
            throw;
        }
        last_step_ = lines.step;
        ahead_ = true;
        // New settings show at once on a pose that stands; nothing else leaves one.
        converge_ = document_->is_posed();
        show_document();
    }

    void carry_out(task::BeginDrag& task) {
        finish_settling();
        try {
            document_->begin_drag(task.handle, task.pivot, "", progress_);
        } catch (...) {
            refuse(task.step);
            throw;
        }
        const auto& handles = document_->handles();
        const auto handle = std::ranges::find(handles, task.handle, &Handle::name) - handles.begin();
        drag_.emplace(LiveDrag{task.step,
                               {task.handle, task.pivot, {}},
                               document_->motions()[static_cast<std::size_t>(handle)],
                               document_->cloud().origin});
        publisher_.strays(document_->pipeline().strays());
        publish_view();
    }

    void carry_out(task::EndDrag& task) {
        if (!drag_) return;
        if (task.last) take_wanted(*task.last);
        std::exception_ptr trouble; // what was followed so far stands
        try {
            while (drag_->wanted && !(drag_->shown == drag_->wanted->transform)) {
                progress_.stop_if_cancelled();
                follow();
            }
        } catch (const Error&) {
            trouble = std::current_exception();
        } catch (const std::bad_alloc&) {
            trouble = std::current_exception();
        }
        if (drag_->line.frames.empty()) {
            drop_drag();
        } else {
            document_->end_drag();
            record([&] { recording_->add(drag_->line, false); });
            last_step_ = drag_->step;
            finish_drag();
        }
        if (trouble) std::rethrow_exception(trouble);
    }

    void finish_drag() {
        drag_.reset();
        converge_ = true;
        publish_view();
    }

    void carry_out(task::CancelDrag& /*task*/) {
        if (drag_) drop_drag();
    }

    void carry_out(task::Undo& task) {
        finish_settling();
        if (refused_.contains(task.step) || !recording_->can_undo()) return;
        take_back_step();
        ahead_ = true; // other samples, perhaps
        show_document();
    }

    void carry_out(task::Redo& task) {
        finish_settling();
        if (refused_.contains(task.step) || !recording_->can_redo()) return;
        do {
            document_->redo("");
            record([&] { recording_->step_forward(RedoLine{}); });
        } while (recording_->next_joins());
        ahead_ = true;
        show_document();
    }

    void carry_out(task::SaveCloud& task) {
        finish_settling();
        const std::vector<float> positions = document_->positions(progress_);
        const std::vector<float> normals = document_->normals(progress_);
        const std::vector<float> far =
            task.columns.displacement ? displacement_column() : std::vector<float>{};
        const std::vector<float> stretch = task.columns.stretch ? stretch_column() : std::vector<float>{};
        PosedShape shape{positions, normals, {}};
        if (task.columns.displacement) shape.added.push_back({"displacement", far});
        if (task.columns.stretch) shape.added.push_back({"stretch", stretch});
        write_cloud(task.target, document_->cloud(), shape, progress_);
        say(Notice::Kind::information, "Saved the cloud as " + task.target.string());
        publish_view();
    }

    void carry_out(task::SaveSession& task) {
        finish_settling();
        recording_->save(task.target);
        recording_->discard(); // the journal: a crash loses nothing of this any more
        saved_.session_state = recording_->state();
        session_file_ = task.target;
        say(Notice::Kind::information, "Saved the session as " + task.target.string());
        publish_view();
    }

    std::vector<float> in_file_order(std::span<const float> ordered, float left_out) {
        return knead::in_file_order(document_->pipeline().order(), ordered, document_->cloud().size(),
                                    left_out, workers_);
    }
    std::vector<float> displacement_column() {
        const std::vector<float>& opened = document_->pipeline().opened().positions;
        return in_file_order(displacements(opened, document_->shape(progress_).positions, workers_), 0);
    }
    std::vector<float> stretch_column() {
        document_->prepare_ahead(progress_); // the graph
        const Pipeline& pipeline = document_->pipeline();
        const RestShape& now = document_->shape(progress_);
        return in_file_order(local_stretch(pipeline.order(), pipeline.graph(), pipeline.opened().positions,
                                           now.positions, workers_),
                             1);
    }

    // The act is done; that its line cannot be written is said, once, and changes nothing.
    template<typename Record>
    void record(Record&& write) {
        try {
            std::forward<Record>(write)();
            told_of_journal_ = false;
        } catch (const Error& error) {
            if (!std::exchange(told_of_journal_, true)) say(Notice::Kind::error, error.what());
        }
    }
    void add_act(const SessionAction& action, bool joins) {
        record([&] { recording_->add(action, joins); });
    }

    void take_back_act() {
        document_->undo("");
        record([&] { recording_->step_back(UndoLine{}); });
    }

    void take_back_step() {
        bool joins = false;
        do {
            joins = recording_->last_joins();
            take_back_act();
        } while (joins);
        converge_ = false; // an undone pose is shown as it was
    }

    // --- Going on without a task ---

    void wait_for_next_frame() {
        const double left = shortest_frame - since_frame_.seconds();
        if (left > 0 && something_to_do())
            shared_.wait(left, [](const LiveShared& s) { return s.stop || !s.inbox.empty() || s.wanted; });
    }

    static bool ends_drag(const LiveTask& task) {
        return std::holds_alternative<task::EndDrag>(task) || std::holds_alternative<task::CancelDrag>(task);
    }

    bool something_to_do() const {
        return (!drag_ && !after_drag_.empty()) || ahead_ || (drag_ && !drag_->rests) ||
               (!drag_ && converge_);
    }

    void go_on() {
        if (drag_) return drag_->rests ? void() : follow();
        if (ahead_) {
            ahead_ = false;
            document_->prepare_ahead(progress_);
            return publish_view();
        }
        if (converge_) settle();
    }

    // Beyond so many turns a typed angle keeps its remainder alone: nobody means the others.
    void take_wanted(WantedPose wanted) {
        double& angle = wanted.transform.angle;
        if (std::abs(angle) > most_turned)
            angle = std::copysign(most_turned, angle) + std::remainder(angle, 2 * std::numbers::pi);
        drag_->wanted = wanted;
        drag_->rests = false;
    }

    // A frame of the drag: a step towards the wanted pose, or the same pose again.
    void follow() {
        LiveDrag& drag = *drag_;
        if (!drag.wanted) return;
        const Stopwatch clock;
        const bool new_pose = !(drag.shown == drag.wanted->transform);
        const Transform next = next_on_the_way(drag.shown, drag.wanted->transform);
        const HandleMotion motion = followed_by(drag.base, next);
        double way = 0;
        try {
            const HandlePose pose = pose_of(motion, drag.line.pivot, drag.origin);
            way = document_->drag_frame(pose, "", progress_);
            drag.line.frames.push_back(pose);
        } catch (...) {
            drag.wanted.reset();
            drag.rests = true;
            throw;
        }
        drag.shown = next;
        drag.repeats = new_pose ? 0 : drag.repeats + 1;
        drag.rests = next == drag.wanted->transform && (way < still || drag.repeats >= most_repeats);
        solve_seconds_ = clock.seconds();
        publish_shape(document_->pipeline().posed(), true);
    }

    void settle() {
        if (!settling_) {
            converge_ = false; // if it cannot begin now, it could not at once again
            document_->begin_settling(progress_);
            settling_ = converge_ = true;
            settled_ = 0;
        }
        const Stopwatch clock;
        bool rests = false;
        try {
            rests = document_->settle_some(settling_iterations, progress_);
        } catch (...) {
            stop_settling();
            throw;
        }
        settled_ += settling_iterations;
        solve_seconds_ = clock.seconds();
        publish_shape(document_->pipeline().posed(), false);
        if (rests || settled_ >= most_settling) finish_settling();
    }

    void stop_settling() {
        converge_ = settling_ = false;
        document_->abandon();
    }

    void finish_settling() {
        converge_ = false;
        if (!std::exchange(settling_, false)) return;
        const SettleLine line = document_->end_settling();
        record([&] { recording_->add(line, true); });
        publish_view();
    }

    void drop_drag() {
        document_->abandon();
        refuse(drag_->step);
        drag_.reset();
        show_document();
    }

    // --- Telling the window ---

    void show_document() {
        publish_view(); // first: it cannot fail
        publish_shape(document_->shape(progress_), false);
    }

    void publish_shape(const RestShape& shape, bool of_drag) {
        LivePublisher::FrameFacts facts;
        if (of_drag) facts.pose_set = drag_->wanted->set;
        facts.solve = solve_seconds_;
        if (!document_->log().upsample.empty()) facts.upsample = document_->log().upsample.back();
        publisher_.shape(shape, facts);
        since_frame_ = Stopwatch();
    }

    void publish_view() {
        publisher_.view(*document_, *recording_,
                        {drag_.has_value(), last_step_, upsampler_->device(), session_file_, saved_});
    }

    void refuse(StepNumber step) {
        refused_.insert(step);
        publisher_.refuse(step);
    }

    void say(Notice::Kind kind, const std::string& words) { publisher_.say(kind, words); }

    void rest_if_idle() {
        const std::string warning = upsampler_->take_warning();
        if (!warning.empty()) say(Notice::Kind::warning, warning);
        shared_.with([&](LiveShared& s) {
            s.status.solving = (drag_ && !drag_->rests) || converge_;
            s.status.busy = something_to_do();
            s.status.doing.clear();
        });
    }

    template<typename Do>
    void guarded(Do&& work) {
        try {
            std::forward<Do>(work)();
        } catch (const Cancelled&) {
            // The window is closing; turn() sees it.
        } catch (const std::bad_alloc&) {
            say(Notice::Kind::error, "There is not enough memory for this.");
        } catch (const std::exception& error) {
            say(Notice::Kind::error, error.what());
        }
    }

    OpenRequest request_;
    Locked<LiveShared>& shared_;
    LivePublisher publisher_;
    LiveProgress progress_;
    Workers workers_;
    std::unique_ptr<Upsampler> upsampler_;
    std::unique_ptr<Document> document_;
    std::unique_ptr<LiveRecording> recording_;
    std::optional<LiveDrag> drag_;
    bool converge_ = false; // a released pose
    bool settling_ = false; // begun in the document
    unsigned settled_ = 0;
    bool ahead_ = true; // stages could be prepared before they are needed
    Stopwatch since_frame_;
    double solve_seconds_ = 0;
    StepNumber last_step_ = 0;
    std::set<StepNumber> refused_;
    std::deque<LiveTask> after_drag_; // what came while a drag went on
    bool told_of_journal_ = false;
    LiveDocument::Saved saved_;
    std::filesystem::path session_file_;
};

} // namespace

void run_live_document(OpenRequest request, Locked<LiveShared>& shared) {
    const auto fail = [&](const std::string& words) {
        shared.with([&](LiveShared& s) {
            s.status.stage = Stage::failed;
            if (!words.empty()) s.notices.push_back({Notice::Kind::error, words});
        });
    };
    try {
        LiveWork work(std::move(request), shared);
        work.open();
        while (work.turn()) {
        }
        work.end();
    } catch (const Cancelled&) {
        fail("");
    } catch (const std::bad_alloc&) {
        fail("There is not enough memory for this.");
    } catch (const std::exception& error) {
        fail(error.what());
    }
}

} // namespace knead
