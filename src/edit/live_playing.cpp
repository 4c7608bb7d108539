// Doing a step again so that it is seen. Every act of it is computed from its recorded frames, is shown
// meanwhile, and is then redone: whatever happens on the way, the document is where undo and redo lead.

#include "edit/live_work.h"

#include <algorithm>
#include <utility>

namespace knead {

namespace {

constexpr double pictures_a_second = 30;
constexpr double longest_drag = 6;          // seconds, at a speed of 1
constexpr unsigned settling_iterations = 9; // of a frame, where there were none

std::size_t frames_of(const Document& document) {
    if (const DragLine* drag = document.redoable_drag()) return drag->frames.size();
    if (const auto settling = document.redoable_settling())
        return (settling->iterations + settling_iterations - 1) / settling_iterations;
    return 0;
}

// So many frames go by in a second.
double rate_of(const Document& document, double speed) {
    const auto frames = static_cast<double>(frames_of(document));
    return speed * std::max(pictures_a_second, frames / longest_drag);
}

} // namespace

void LiveWork::carry_out(task::Play& task) {
    finish_settling();
    if (refused_.contains(task.step) || !recording_->can_redo()) return;
    play_.emplace();
    since_frame_ = Stopwatch();
}

// Whether there is anything to do without a task.
bool LiveWork::plays_on(const LiveShared& shared) const {
    return play_ && (!shared.pace.held || shared.pace.frames != 0);
}

double LiveWork::seconds_to_next_picture(const LiveShared& shared) const {
    if (shared.pace.held) return 0;
    const double rate = rate_of(*document_, shared.pace.speed);
    return std::max(1 / pictures_a_second, 1 / rate) - since_frame_.seconds();
}

// The next picture: as many frames as its time stands for, but no fewer than one.
void LiveWork::play_on() {
    const PlayPace pace = shared_.with([](LiveShared& s) {
        return PlayPace{s.pace.speed, s.pace.held, std::exchange(s.pace.frames, 0)};
    });
    int frames = pace.frames;
    if (!pace.held) {
        play_->due = std::max(0.0, play_->due) + rate_of(*document_, pace.speed) / pictures_a_second;
        frames = std::max(1, static_cast<int>(play_->due));
        play_->due -= frames;
    }
    try {
        if (document_->redoable_drag())
            play_frames(frames);
        else if (document_->redoable_settling())
            play_settling(frames);
        else
            finish_playing_act();
    } catch (const Cancelled&) {
        throw;
    } catch (...) {
        finish_playing(); // whatever cannot be shown can be redone
        throw;
    }
}

void LiveWork::play_frames(int frames) {
    const DragLine& drag = *document_->redoable_drag();
    if (frames < 0) { // from the drag's beginning to where it is to be
        const auto back = static_cast<std::size_t>(-frames);
        frames = static_cast<int>(play_->frame > back ? play_->frame - back : 0);
        document_->abandon();
        *play_ = {};
        if (frames == 0) return publish_shape(false);
    }
    if (!play_->begun) document_->begin_drag(drag.handle, drag.pivot, "", progress_, drag.with);
    play_->begun = true;
    for (; frames > 0 && play_->frame < drag.frames.size(); --frames)
        document_->drag_frame(drag.frames[play_->frame++], "", progress_);
    publish_shape(false);
    if (play_->frame == drag.frames.size()) finish_playing_act();
}

void LiveWork::play_settling(int frames) {
    const unsigned whole = document_->redoable_settling()->iterations;
    if (frames < 0) return;
    if (!play_->begun) document_->begin_settling(progress_);
    play_->begun = true;
    const auto done = static_cast<unsigned>(play_->frame) * settling_iterations;
    const unsigned now =
        std::min(whole - std::min(done, whole), static_cast<unsigned>(frames) * settling_iterations);
    if (now > 0) document_->settle_some(now, progress_);
    play_->frame += static_cast<std::size_t>(frames);
    publish_shape(false);
    if (play_->frame * settling_iterations >= whole) finish_playing_act();
}

void LiveWork::finish_playing_act() {
    document_->abandon();
    redo_act(true);
    *play_ = {};
    if (recording_->next_joins()) return;
    play_.reset();
    show_where_it_rests();
}

void LiveWork::finish_playing() {
    if (!play_) return;
    document_->abandon();
    play_.reset();
    do redo_act(true);
    while (recording_->next_joins());
    show_where_it_rests();
}

std::optional<LiveDocument::Status::Playing> LiveWork::what_plays(const LiveShared& shared) const {
    if (!play_) return std::nullopt;
    LiveDocument::Status::Playing playing;
    if (const DragLine* drag = document_->redoable_drag()) playing.handle = drag->handle;
    playing.frames = frames_of(*document_);
    playing.frame = std::min(play_->frame, playing.frames);
    playing.held = shared.pace.held;
    return playing;
}

} // namespace knead
