// How the document's thread follows the hand, and lets what it released converge.

#include "edit/live_work.h"

#include "base/error.h"
#include "edit/handle_motion.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

namespace knead {

namespace {

// A drag whose samples go less far than this in an iteration, over the cloud's size, shows no more change.
constexpr double still = 1e-7;

// So many frames of a drag may repeat one pose, and so many iterations may a released pose settle.
constexpr std::size_t most_repeats = 400;
constexpr unsigned most_settling = 1000;
constexpr double longest_wait = 3; // seconds that a save waits for a shape to come to rest

// Iterations of settling between two frames on the screen: as many as take this long, in seconds, but no
// more.
constexpr double settling_seconds = 0.03;
constexpr unsigned most_settling_iterations = 9;

// What a frame's iteration takes for each sample where none was measured yet, in seconds.
constexpr double usual_iteration = 0.4e-6;

} // namespace

// What the hand saw when it began may have gone meanwhile, or be fixed.
bool LiveWork::moves(const std::string& handle) const {
    const Handle* const found = handle_named(document_->handles(), handle);
    return found && found->role == HandleRole::moving;
}

void LiveWork::carry_out(task::BeginDrag& task) {
    try {
        finish_settling();
        std::erase_if(task.with, [&](const Companion& companion) { return !moves(companion.handle); });
        document_->begin_drag(task.handle, task.pivot, "", progress_, task.with);
        document_->make_spare_shapes();
        const std::size_t handle = *number_of(document_->handles(), task.handle);
        drag_.emplace(LiveDrag{task.step, task.handle, task.pivot, document_->motions()[handle],
                               document_->cloud().origin, task.with});
    } catch (...) {
        document_->abandon(); // or it would refuse whatever comes after
        refuse(task.step);
        throw;
    }
    publisher_.strays(document_->pipeline().strays());
    const DragLine drag{task.handle, task.pivot, {}, task.with};
    publisher_.swallowed(*document_, drag);
    publisher_.loose(*document_, drag);
    publish_view();
}

void LiveWork::carry_out(task::EndDrag& task) {
    if (!drag_) return;
    if (task.last) take_wanted(*task.last);
    std::exception_ptr trouble; // what was followed so far stands
    try {
        while (drag_->wanted && !(drag_->shown == drag_->wanted->transform)) {
            progress_.stop_if_cancelled();
            follow();
        }
    } catch (const Cancelled&) {
        throw;
    } catch (...) { // also what nobody foresaw: a drag that never ends would keep everything after it waiting
        trouble = std::current_exception();
    }
    if (drag_->frames == 0)
        drop_drag();
    else
        take_drag();
    if (trouble) std::rethrow_exception(trouble);
}

// What was followed becomes an act, or nothing of it stays: in either case the drag is over.
void LiveWork::take_drag() {
    try {
        auto coming = recording_->coming(DragLine{drag_->handle, drag_->pivot, {}, drag_->with}, false, {});
        coming.line = document_->end_drag();
        record([&] { recording_->add(std::move(coming)); });
    } catch (...) {
        drop_drag();
        throw;
    }
    finish_drag();
}

void LiveWork::finish_drag() {
    LiveDrag drag = std::move(*drag_);
    drag_.reset();
    last_step_ = drag.step;
    settling_.wanted = true;
    learn_cost(std::move(drag.solving), std::move(drag.upsampling));
    publish_view(); // first: it takes next to no memory
    if (publisher_.last_is_drawn()) publish_shape(false);
}

void LiveWork::carry_out(task::CancelDrag& /*task*/) {
    if (drag_) drop_drag();
}

void LiveWork::drop_drag() {
    const StepNumber step = drag_->step;
    document_->abandon();
    drag_.reset();
    refuse(step);
    show_document();
}

void LiveWork::take_wanted(WantedPose wanted) {
    wanted.transform.angle = within_turns(wanted.transform.angle);
    drag_->wanted = wanted;
    drag_->rests = false;
}

// Whether a frame of all samples would leave the hand waiting. Its start costs about what an iteration does.
bool LiveWork::is_too_slow() const {
    const Pipeline& pipeline = document_->pipeline();
    const auto samples = static_cast<double>(pipeline.samples().size());
    const double iterations = 1.0 + document_->settings().iterations;
    const auto& newest = choice_.newest; // a machine that is busy otherwise is slow now
    const double each =
        newest ? newest->cost.solving / static_cast<double>(newest->cost.samples) / (1.0 + newest->iterations)
               : usual_iteration;
    return pipeline.has_coarse_samples() && samples * iterations * each > request_.quick;
}

// A frame of the drag: a step towards the wanted pose, or the same pose again.
void LiveWork::follow() {
    LiveDrag& drag = *drag_;
    if (!drag.wanted) return;
    const Stopwatch clock;
    const bool new_pose = !(drag.shown == drag.wanted->transform);
    const Transform next = next_on_the_way(drag.shown, drag.wanted->transform);
    const HandleMotion motion = followed_by(drag.base, next);
    double way = 0;
    try {
        HandlePose pose = pose_of(motion, drag.pivot, drag.origin);
        pose.coarse = new_pose && is_too_slow();
        const bool later = upsampler_->shares_with_opengl() &&
                           shared_.with([](const LiveShared& s) { return s.draws_on_device; });
        way = document_->drag_frame(pose, "", progress_,
                                    later ? Document::Points::later : Document::Points::now);
        drag.is_coarse = pose.coarse;
    } catch (...) {
        drag.wanted.reset();
        drag.rests = true;
        show_what_was_drawn();
        throw;
    }
    ++drag.frames;
    drag.shown = next;
    drag.repeats = new_pose ? 0 : drag.repeats + 1;
    drag.rests =
        next == drag.wanted->transform && !drag.is_coarse && (way < still || drag.repeats >= most_repeats);
    solve_seconds_ = clock.seconds();
    const double upsampling = document_->log().upsample.back();
    if (!document_->drawn_frame()) drag.upsampling.push_back(upsampling);
    if (!drag.is_coarse) drag.solving.push_back(solve_seconds_ - upsampling);
    publish_drag();
}

// The points of a frame that only whoever draws has seen, after one that could not be made.
void LiveWork::show_what_was_drawn() {
    if (!publisher_.last_is_drawn()) return;
    try {
        publish_shape(false);
    } catch (const std::exception&) { // what is told is what went wrong before
    }
}

unsigned LiveWork::iterations_a_picture() const {
    const std::vector<double>& seconds = document_->log().iteration;
    if (seconds.empty()) return 1;
    return static_cast<unsigned>(
        std::clamp(settling_seconds / std::max(seconds.back(), 1e-6), 1.0, 1.0 * most_settling_iterations));
}

void LiveWork::settle() {
    if (!settling_.begun) {
        settling_.wanted = false; // if it cannot begin now, it could not at once again
        document_->begin_settling(progress_);
        settling_.begun = settling_.wanted = true;
        settling_.iterations = 0;
    }
    const Stopwatch clock;
    const unsigned iterations = iterations_a_picture();
    bool rests = false;
    try {
        rests = document_->settle_some(iterations, progress_);
    } catch (...) {
        stop_settling();
        throw;
    }
    settling_.iterations += iterations;
    solve_seconds_ = clock.seconds();
    publish_shape(false);
    if (rests || settling_.iterations >= most_settling) finish_settling();
}

// As far as one likes to wait for it. What goes wrong on the way is told, and nothing else fails of it.
void LiveWork::come_to_rest() {
    const Stopwatch clock;
    try {
        while (settling_.wanted && clock.seconds() < longest_wait) settle();
    } catch (const Cancelled&) { // the window is closing
    } catch (...) {
        tell_of_exception(shared_);
    }
    finish_settling();
}

void LiveWork::stop_settling() {
    settling_.wanted = settling_.begun = false;
    document_->abandon();
}

void LiveWork::finish_settling() {
    settling_.wanted = false;
    if (!std::exchange(settling_.begun, false)) return;
    try {
        auto coming = recording_->coming_to_last(SettleLine{});
        coming.line = document_->end_settling();
        record([&] { recording_->add(std::move(coming)); });
    } catch (...) {
        stop_settling(); // the pose stands as it was released
        throw;
    }
    publisher_.demand(document_->demand(progress_));
    publish_view();
}

} // namespace knead
