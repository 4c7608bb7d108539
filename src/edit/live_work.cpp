// The document's thread: takes tasks one after the other, follows the newest pose, and lets a pose that rests
// converge.

#include "base/error.h"
#include "base/stopwatch.h"
#include "edit/live_drag.h"
#include "edit/live_recording.h"
#include "edit/live_shared.h"
#include "edit/measures.h"
#include "edit/session_cloud.h"
#include "io/cloud_file.h"
#include "upsample/devices.h"
#include "view/framing.h"

#include <algorithm>
#include <utility>

namespace knead {

namespace {

using Stage = LiveDocument::Stage;

// A drag whose samples go less far than this in an iteration, over the cloud's size, shows no more change.
constexpr double still = 1e-7;

// So many frames of a drag may repeat one pose, and so many iterations may a released pose settle.
constexpr std::size_t most_repeats = 400;
constexpr unsigned most_settling = 1000;

// Iterations of settling between two frames on the screen.
constexpr unsigned settling_iterations = 9;

// Frames of a pose that rests come no faster than this, in seconds: nobody sees more, the recording stays
// short, and the window has the processor to itself meanwhile.
constexpr double shortest_frame = 0.008;

class LiveWork {
public:
    LiveWork(OpenRequest request, Locked<LiveShared>& shared)
        : request_(std::move(request)), shared_(shared), progress_(shared), workers_(request_.threads) {}

    void open() {
        const Stopwatch clock;
        Session session = begin_session();
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
        document_->shape(progress_); // the order of the points
        replay(session);
        publish_opened(clock);
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
                if (!s.inbox.empty()) {
                    task = std::move(s.inbox.front());
                    s.inbox.pop_front();
                } else if (s.wanted) {
                    if (drag_) drag_->wanted = s.wanted;
                    if (drag_) drag_->rests = false;
                    s.wanted.reset();
                }
                return !s.stop;
            });
        if (!more) return false;
        if (task)
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

    Session begin_session() {
        if (request_.restore) return recovered_session(*request_.restore);
        if (is_session(request_.file, progress_)) return read_session(request_.file);
        Session session;
        session.cloud = std::filesystem::absolute(request_.file);
        session.settings = changed({}, request_.settings);
        return session;
    }

    void replay(const Session& session) {
        std::size_t done = 0;
        for (const SessionLine& line : session.lines) {
            progress_.step("replaying the session",
                           static_cast<double>(done++) / static_cast<double>(session.lines.size()));
            const std::string place = session.place(line.number);
            const bool joins = std::holds_alternative<SettleLine>(line.action);
            if (std::holds_alternative<UndoLine>(line.action))
                document_->undo(place), recording_->step_back(UndoLine{});
            else if (std::holds_alternative<RedoLine>(line.action))
                document_->redo(place), recording_->step_forward(RedoLine{});
            else if (const auto* check = std::get_if<CheckLine>(&line.action))
                recording_->note(CheckLine{session.resolve(check->positions), check->tolerance});
            else
                act(line.action, place), recording_->add(line.action, joins);
        }
        saved_ = {recording_->acts(), recording_->acts()};
        if (request_.restore) saved_ = {};
    }

    void publish_opened(const Stopwatch& clock) {
        OpenedCloud opened;
        opened.file = recording_->cloud();
        opened.cloud = &document_->cloud();
        opened.order = &document_->pipeline().order();
        opened.opened = &document_->pipeline().opened();
        opened.bounds = document_->bounds();
        opened.spacing = usual_spacing(opened.opened->positions);
        publish_shape(document_->shape(progress_), false);
        publish_view();
        opened.read_seconds = clock.seconds();
        shared_.with([&](LiveShared& s) {
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
        try {
            for (const SessionAction& line : lines.lines) {
                if (needs_commit(line) && document_->is_posed()) {
                    act(CommitLine{}, "");
                    recording_->add(CommitLine{}, done++ > 0);
                }
                act(line, "");
                recording_->add(line, done++ > 0);
            }
        } catch (...) {
            refuse(lines.step);
            if (done > 0) take_back_step();
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
        warn_of_strays();
        publish_view();
    }

    void carry_out(task::EndDrag& task) {
        if (!drag_) return;
        if (task.last) drag_->wanted = task.last;
        while (drag_->wanted && !(drag_->shown == drag_->wanted->transform)) follow();
        if (drag_->line.frames.empty()) return drop_drag();
        document_->end_drag();
        recording_->add(drag_->line, false);
        last_step_ = drag_->step;
        drag_.reset();
        converge_ = true;
        publish_view();
    }

    void carry_out(task::CancelDrag& /*task*/) {
        if (drag_) drop_drag();
    }

    void carry_out(task::Undo& /*task*/) {
        finish_settling();
        if (drag_ || !recording_->can_undo()) return;
        take_back_step();
        show_document();
    }

    void carry_out(task::Redo& /*task*/) {
        finish_settling();
        if (drag_ || !recording_->can_redo()) return;
        do {
            document_->redo("");
            recording_->step_forward(RedoLine{});
        } while (recording_->next_joins());
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
        saved_.cloud_acts = recording_->acts();
        say(Notice::Kind::information, "Saved the cloud as " + task.target.string());
        publish_view();
    }

    void carry_out(task::SaveSession& task) {
        finish_settling();
        recording_->save(task.target);
        recording_->discard(); // the journal: a crash loses nothing of this any more
        saved_.session_acts = recording_->acts();
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

    void act(const SessionAction& action, const std::string& place) {
        if (const auto* line = std::get_if<HandleLine>(&action)) document_->declare(*line, place);
        if (const auto* line = std::get_if<DragLine>(&action)) document_->drag(*line, place, progress_);
        if (const auto* line = std::get_if<SettleLine>(&action)) document_->settle(*line, progress_);
        if (std::holds_alternative<CommitLine>(action)) document_->commit(progress_);
        if (const auto* line = std::get_if<SetLine>(&action)) document_->change_settings(line->change, place);
        if (const auto* line = std::get_if<DeleteLine>(&action)) document_->remove(*line, place);
        if (const auto* line = std::get_if<RenameLine>(&action)) document_->rename(*line, place);
    }

    void take_back_step() {
        bool joins = false;
        do {
            joins = recording_->last_joins();
            document_->undo("");
            recording_->step_back(UndoLine{});
        } while (joins);
        converge_ = false; // an undone pose is shown as it was
    }

    // --- Going on without a task ---

    void wait_for_next_frame() {
        const double left = shortest_frame - since_frame_.seconds();
        if (left > 0 && something_to_do())
            shared_.wait(left, [](const LiveShared& s) { return s.stop || !s.inbox.empty() || s.wanted; });
    }

    bool something_to_do() const { return ahead_ || (drag_ && !drag_->rests) || (!drag_ && converge_); }

    void go_on() {
        if (drag_) return drag_->rests ? void() : follow();
        if (ahead_) {
            ahead_ = false;
            document_->prepare_ahead(progress_);
            return publish_view();
        }
        if (converge_) settle();
    }

    // A frame of the drag: a step towards the wanted pose, or the same pose again.
    void follow() {
        LiveDrag& drag = *drag_;
        if (!drag.wanted) return;
        const Stopwatch clock;
        const bool new_pose = !(drag.shown == drag.wanted->transform);
        const Transform next = next_on_the_way(drag.shown, drag.wanted->transform);
        const HandleMotion motion = followed_by(drag.base, next);
        drag.line.frames.push_back(pose_of(motion, drag.line.pivot, drag.origin));
        double way = 0;
        try {
            way = document_->drag_frame(drag.line.frames.back(), "", progress_);
        } catch (...) {
            drag.line.frames.pop_back();
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
            document_->begin_settling(progress_);
            settling_ = true;
            settled_ = 0;
        }
        const Stopwatch clock;
        const bool rests = document_->settle_some(settling_iterations, progress_);
        settled_ += settling_iterations;
        solve_seconds_ = clock.seconds();
        publish_shape(document_->pipeline().posed(), false);
        if (rests || settled_ >= most_settling) finish_settling();
    }

    void finish_settling() {
        converge_ = false;
        if (!std::exchange(settling_, false)) return;
        recording_->add(document_->end_settling(), true);
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
        publish_shape(document_->shape(progress_), false);
        publish_view();
    }

    void publish_shape(const RestShape& shape, bool of_drag) {
        back_.positions.assign(shape.positions.begin(), shape.positions.end());
        back_.normals.assign(shape.normals.begin(), shape.normals.end());
        back_.version = ++frames_;
        since_frame_ = Stopwatch();
        back_.shows_pose = of_drag;
        if (of_drag) back_.pose_set = drag_->wanted->set;
        back_.solve = solve_seconds_;
        back_.upsample = document_->log().upsample.empty() ? 0 : document_->log().upsample.back();
        shared_.with([&](LiveShared& s) { std::swap(s.frame, back_); });
    }

    void publish_view() {
        auto view = std::make_shared<DocumentView>();
        const Pipeline& pipeline = document_->pipeline();
        view->settings = document_->settings();
        view->handles = document_->handles();
        view->motions = document_->motions();
        view->posed = document_->is_posed() || drag_;
        view->acts = recording_->acts();
        view->last_step = last_step_;
        view->undoable_steps = recording_->undoable_steps();
        view->redoable_steps = recording_->redoable_steps();
        view->samples = pipeline.samples().size();
        view->strays = pipeline.strays();
        view->graph = pipeline.shared_graph();
        view->components = pipeline.shared_components();
        note_samples();
        view->sample_vertices = sample_vertices_;
        view->sample_graph = sample_graph_;
        view->device = upsampler_->device();
        view->session = session_file_;
        shared_.with([&](LiveShared& s) {
            s.view = std::move(view);
            s.saved = saved_;
        });
    }

    // Copies for the window, which may look at them while the pipeline makes others.
    void note_samples() {
        const Pipeline& pipeline = document_->pipeline();
        if (pipeline.samples_version() == samples_seen_) return;
        samples_seen_ = pipeline.samples_version();
        sample_vertices_ = std::make_shared<const std::vector<Index>>(pipeline.samples());
        sample_graph_ = std::make_shared<const Graph>(pipeline.sample_graph().graph);
    }

    void refuse(StepNumber step) {
        shared_.with([&](LiveShared& s) { s.refused.push_back(step); });
    }

    void say(Notice::Kind kind, const std::string& words) {
        shared_.with([&](LiveShared& s) { s.notices.push_back({kind, words}); });
    }

    void warn_of_strays() {
        const std::string words = words_about(document_->pipeline().strays());
        if (!words.empty() && words != told_of_strays_) say(Notice::Kind::information, words);
        told_of_strays_ = words;
    }

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
    PosedFrame back_;
    std::uint64_t frames_ = 0;
    Stopwatch since_frame_;
    double solve_seconds_ = 0;
    StepNumber last_step_ = 0;
    LiveDocument::Saved saved_;
    std::filesystem::path session_file_;
    std::string told_of_strays_;
    std::uint64_t samples_seen_ = 0;
    std::shared_ptr<const std::vector<Index>> sample_vertices_;
    std::shared_ptr<const Graph> sample_graph_;
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
