// Drags and settling: what a document does while the hand moves, and the same acts as lines of a session.

#include "edit/document.h"

#include "base/error.h"
#include "base/require.h"
#include "base/stopwatch.h"
#include "edit/handle_motion.h"
#include "edit/reflection.h"

#include <algorithm>
#include <utility>

namespace knead {

namespace {

// A sample that goes less far than this in an iteration, in units of the cloud's size, is at rest.
constexpr double at_rest = 1e-8;

// How far a handle may send its points: so many diagonals of the cloud, and not beyond what floats can hold.
constexpr double most_diagonals = 1e12;
constexpr double farthest = 1e30;

void refuse_absurd(const HandleMotion& motion, double diagonal, std::size_t frame, const std::string& place) {
    // Points that all lie in one place have no size to compare with.
    const double reach = diagonal > 0 ? std::min(most_diagonals * diagonal, farthest) : farthest;
    const bool sane = motion.offset.allFinite() && motion.linear.allFinite() &&
                      motion.offset.norm() < reach && motion.linear.norm() < most_diagonals &&
                      motion.linear.norm() * diagonal < reach;
    if (sane) return;
    // By hand it is no frame of a file.
    const std::string what =
        place.empty() ? "This" : "\"frames\": frame " + std::to_string(frame) + " (from 0)";
    throw Error(Trouble::input, place, what + " sends the handle out of all range");
}

} // namespace

// Returns the longest way that a sample went, over the cloud's size.
double Document::iterate_once(const std::vector<HandleMotion>& motions, SampleState& samples,
                              FrameMemory& memory) {
    const Stopwatch clock;
    const double way = pipeline_.iterate(motions, samples, memory.acceleration);
    if (memory.logs) log_.iteration.push_back(clock.seconds());
    return way / pipeline_.cloud_size();
}

// What a drag moves, where it is in `motions`: its handle, and then those that go along.
std::vector<Document::Moved> Document::moved_by(const DragLine& line, std::span<const HandleMotion> motions,
                                                const std::string& place) const {
    const Index handle = movable_handle(line.handle, "handle", place);
    std::vector<Moved> moved{{handle, motions[handle]}};
    for (const Companion& companion : line.with) {
        const Index other = movable_handle(companion.handle, "with", place);
        moved.push_back({other, motions[other]});
    }
    return moved;
}

// Where a frame of a drag takes what was at `from` when that began and is in `now`.
void Document::move(const DragLine& drag, const HandlePose& pose, std::span<const Moved> from,
                    std::span<const HandleMotion> now, std::vector<Moved>& next) const {
    next.assign(from.begin(), from.end());
    next[0].motion = motion_of(pose, drag.pivot, cloud_.origin, now[next[0].handle]);
    for (std::size_t k = 1; k < next.size(); ++k) {
        const auto& mirror = drag.with[k - 1].mirror;
        HandleMotion before = from[0].motion, after = next[0].motion;
        if (mirror) {
            const Reflection shown =
                reflection(mirror->across, drag.pivot - cloud_.origin, mirror->pivot - cloud_.origin);
            before = seen_in(shown, before);
            after = seen_in(shown, after);
        }
        next[k].motion = gone_along(from[k].motion, before, after, now[next[k].handle]);
    }
}

// A frame of a drag that takes handles from their places in `motions` to others. Returns as above, of the
// last iteration.
double Document::follow(std::span<const Moved> next, bool coarse, unsigned iterations,
                        std::vector<HandleMotion>& motions, SampleState& samples, FrameMemory& memory,
                        Progress& progress) {
    const auto move_handles = [&] {
        for (const Moved& each : next) motions[each.handle] = each.motion;
    };
    progress.stop_if_cancelled();
    if (coarse && pipeline_.has_coarse_samples()) {
        if (!memory.following.anchored) pipeline_.anchor(motions, samples, memory.following);
        move_handles();
        const double way = pipeline_.follow_coarsely(motions, iterations, memory.following, samples);
        return way / pipeline_.cloud_size();
    }
    memory.following.anchored = false;
    move_handles();
    pipeline_.follow_handles(motions, samples);
    forget(memory.acceleration);
    double way = 0;
    for (unsigned i = 0; i < iterations; ++i) {
        progress.stop_if_cancelled();
        way = iterate_once(motions, samples, memory);
    }
    return way;
}

// Moves the points to where the samples of this act are.
void Document::show(UnderWay& act) {
    drawn_frame_.reset();
    act.is_shown = false;
    upsample(act.motions, act.samples);
    act.is_shown = true;
}

// Leaves that to whoever draws. Returns false where nobody can.
bool Document::make_frame(const UnderWay& drag) {
    posed_is_now_ = false;
    const Stopwatch clock;
    drawn_frame_ = pipeline_.frame(drag.motions, drag.samples);
    if (!drawn_frame_) return false;
    log_.upsample.push_back(clock.seconds());
    return true;
}

void Document::drag(const DragLine& line, const std::string& place, Progress& progress) {
    std::vector<HandleMotion> motions = motions_;
    const std::vector<Moved> from = moved_by(line, motions, place);
    std::vector<Moved> moved = from;
    for (std::size_t f = 0; f < line.frames.size(); ++f) {
        move(line, line.frames[f], from, motions, moved);
        for (const Moved& each : moved) {
            refuse_absurd(each.motion, bounds_.diagonal(), f, place);
            motions[each.handle] = each.motion;
        }
    }
    if (mode_ == Mode::rehearsal) {
        State next = next_state();
        next.posed = std::make_shared<Posed>();
        next.posed->made_from = at_;
        next.posed->act = DragLine{line.handle, line.pivot, {}, line.with};
        next.posed->moved = std::move(moved);
        return take(std::move(next));
    }
    try {
        begin_drag(line.handle, line.pivot, place, progress, line.with);
        const auto frames = static_cast<double>(line.frames.size());
        for (std::size_t f = 0; f < line.frames.size(); ++f) {
            progress.step("following the handle", static_cast<double>(f) / frames);
            drag_frame(line.frames[f], place, progress);
            if (on_frame) on_frame();
        }
    } catch (...) {
        abandon();
        throw;
    }
    end_drag();
}

void Document::settle(const SettleLine& line, Progress& progress) {
    if (!is_posed() || mode_ == Mode::rehearsal) return take(next_state());
    try {
        begin_settling(progress);
        settle_some(line.iterations, progress);
    } catch (...) {
        abandon();
        throw;
    }
    end_settling();
}

void Document::begin_drag(const std::string& handle, const Vec3d& pivot, const std::string& place,
                          Progress& progress, const std::vector<Companion>& with) {
    require(!under_way_ && mode_ == Mode::real, "a drag begins when nothing else goes on");
    DragLine line{handle, pivot, {}, with};
    std::vector<Moved> from = moved_by(line, motions_, place);
    const auto samples = is_posed() ? samples_of(now(), progress) : nullptr;
    prepare(progress);
    under_way_.emplace(UnderWay{next_state(), motions_, samples ? *samples : pipeline_.rest_state()});
    under_way_->before = under_way_->next = from;
    under_way_->from = std::move(from);
    under_way_->line = std::move(line);
}

double Document::drag_frame(const HandlePose& pose, const std::string& place, Progress& progress,
                            Points points) {
    require(under_way_ && !under_way_->from.empty(), "a frame of a drag follows its begin");
    UnderWay& drag = *under_way_;
    for (Moved& each : drag.before) each.motion = drag.motions[each.handle];
    move(drag.line, pose, drag.from, drag.motions, drag.next);
    for (const Moved& each : drag.next)
        refuse_absurd(each.motion, bounds_.diagonal(), drag.line.frames.size(), place);
    drag.samples_before = drag.samples; // into the same memory, frame by frame
    CoarseFollowing& following = drag.memory.following;
    const bool was_anchored = following.anchored;
    drag.coarse_before = following.now;
    double way = 0;
    try {
        way = follow(drag.next, pose.coarse, drag.after.settings.iterations, drag.motions, drag.samples,
                     drag.memory, progress);
        drag.is_shown = false;
        if (points == Points::now || !make_frame(drag)) show(drag);
        drag.line.frames.push_back(pose);
    } catch (...) {
        drag.is_shown = false;
        drawn_frame_.reset();
        for (const Moved& each : drag.before) drag.motions[each.handle] = each.motion;
        drag.samples = drag.samples_before;
        following.anchored = was_anchored;
        following.now = drag.coarse_before;
        throw;
    }
    ++log_.frames;
    return way;
}

DragLine Document::end_drag() {
    require(under_way_ && !under_way_->from.empty(), "a drag that ends was begun");
    UnderWay drag = std::move(*under_way_);
    under_way_.reset();
    drawn_frame_.reset();
    DragLine line = std::move(drag.line);
    if (!line.frames.empty()) end(std::move(drag), line);
    return line;
}

// What was begun becomes the present state, of which `line` says how it came about.
void Document::end(UnderWay act, std::variant<DragLine, SettleLine> line) {
    auto posed = std::make_shared<Posed>();
    posed->samples = std::make_shared<const SampleState>(std::move(act.samples));
    posed->made_from = at_;
    posed->act = std::move(line);
    for (const Moved& each : act.from) posed->moved.push_back({each.handle, act.motions[each.handle]});
    act.after.posed = posed;
    take(std::move(act.after));
    keep(posed);
    posed_is_now_ = act.is_shown;
}

void Document::begin_settling(Progress& progress) {
    require(!under_way_ && is_posed() && mode_ == Mode::real, "only what is posed can settle");
    const auto samples = samples_of(now(), progress);
    prepare(progress);
    under_way_.emplace(UnderWay{next_state(), motions_, *samples});
}

bool Document::settle_some(unsigned iterations, Progress& progress) {
    require(under_way_ && under_way_->from.empty(), "settling goes on after its begin");
    UnderWay& settling = *under_way_;
    bool rests = false;
    for (unsigned i = 0; i < iterations && !rests; ++i) {
        progress.stop_if_cancelled();
        rests = iterate_once(settling.motions, settling.samples, settling.memory) <= at_rest;
        ++settling.iterations;
    }
    show(settling);
    return rests;
}

SettleLine Document::end_settling() {
    require(under_way_ && under_way_->from.empty(), "a settling that ends was begun");
    UnderWay settling = std::move(*under_way_);
    under_way_.reset();
    const SettleLine line{settling.iterations};
    end(std::move(settling), line);
    return line;
}

void Document::abandon() noexcept {
    if (!under_way_) return;
    under_way_.reset();
    drawn_frame_.reset();
    posed_is_now_ = false;
}

} // namespace knead
