// How the document's thread follows the hand, and lets what it released converge.

#include "edit/live_work.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <utility>

namespace knead {

namespace {

// A drag whose samples go less far than this in an iteration, over the cloud's size, shows no more change.
constexpr double still = 1e-7;

// So many frames of a drag may repeat one pose, and so many iterations may a released pose settle.
constexpr std::size_t most_repeats = 400;
constexpr double most_turned = 40 * std::numbers::pi;
constexpr unsigned most_settling = 1000;

// Iterations of settling between two frames on the screen.
constexpr unsigned settling_iterations = 9;

} // namespace

void LiveWork::carry_out(task::BeginDrag& task) {
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

void LiveWork::carry_out(task::EndDrag& task) {
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

void LiveWork::finish_drag() {
    learn_cost(drag_->solving, drag_->upsampling);
    drag_.reset();
    converge_ = true;
    publish_view();
}

void LiveWork::carry_out(task::CancelDrag& /*task*/) {
    if (drag_) drop_drag();
}

void LiveWork::drop_drag() {
    document_->abandon();
    refuse(drag_->step);
    drag_.reset();
    show_document();
}

// Beyond so many turns a typed angle keeps its remainder alone: nobody means the others.
void LiveWork::take_wanted(WantedPose wanted) {
    double& angle = wanted.transform.angle;
    if (std::abs(angle) > most_turned)
        angle = std::copysign(most_turned, angle) + std::remainder(angle, 2 * std::numbers::pi);
    drag_->wanted = wanted;
    drag_->rests = false;
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
    drag.upsampling.push_back(document_->log().upsample.back());
    drag.solving.push_back(solve_seconds_ - drag.upsampling.back());
    publish_shape(document_->pipeline().posed(), true);
}

void LiveWork::settle() {
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

void LiveWork::stop_settling() {
    converge_ = settling_ = false;
    document_->abandon();
}

void LiveWork::finish_settling() {
    converge_ = false;
    if (!std::exchange(settling_, false)) return;
    const SettleLine line = document_->end_settling();
    record([&] { recording_->add_to_last(line); });
    publisher_.demand(document_->demand(progress_));
    publish_view();
}

} // namespace knead
