// What a document remembers: going back and forth, and making again what was dropped on the way.

#include "edit/document.h"

#include "base/error.h"
#include "base/require.h"
#include "edit/handle_motion.h"
#include "edit/keeping.h"

#include <algorithm>
#include <new>
#include <type_traits>
#include <utility>

namespace knead {

namespace {

std::size_t bytes_of(const SampleState& samples) {
    return samples.rotation.size() * sizeof(Quatd) + samples.displacement.size() * sizeof(Vec3d) +
           samples.handles.size() * sizeof(HandleMotion);
}

std::size_t bytes_of(const RestShape& shape) {
    return (shape.positions.size() + shape.normals.size() + shape.rotations.size()) * sizeof(float);
}

} // namespace

void Document::undo(const std::string& place) {
    require(!under_way_, "an act comes after the drag that goes on");
    if (at_ == 0) throw Error(Trouble::input, place, "there is nothing to undo");
    std::vector<HandleMotion> motions = motions_of(at_ - 1);
    if (now().change) take_back(*now().change, handles_);
    motions_ = std::move(motions);
    --at_;
    show_pivots(history_[at_ + 1], now());
    posed_is_now_ = false;
}

void Document::redo(const std::string& place) {
    require(!under_way_, "an act comes after the drag that goes on");
    if (at_ + 1 == history_.size()) throw Error(Trouble::input, place, "there is nothing to redo");
    arrive_at(history_[at_ + 1]);
}

Document::State Document::next_state() const {
    State next = now();
    next.change = nullptr;
    return next;
}

void Document::take(State next) {
    require(!under_way_, "an act comes after the drag that goes on");
    static_assert(std::is_nothrow_move_constructible_v<State> && std::is_nothrow_move_assignable_v<State>);
    if (history_.capacity() < at_ + 2) history_.reserve(2 * (at_ + 1)); // what can fail comes first
    arrive_at(next);
    history_.erase(history_.begin() + static_cast<std::ptrdiff_t>(at_), history_.end());
    history_.push_back(std::move(next));
    const auto forgotten = [&](const auto& made) { return made->made_from + 1 >= at_; };
    std::erase_if(kept_shapes_, forgotten);
    std::erase_if(kept_samples_, forgotten);
}

// Takes the handles from where they were in the state before to where they are in this one.
void Document::take_motions_of(const State& state, std::size_t handles, std::vector<HandleMotion>& motions) {
    if (!state.posed) return motions.assign(handles, HandleMotion{});
    for (const Moved& moved : state.posed->moved) motions[moved.handle] = moved.motion;
}

// From the present one. Where memory runs out nothing has changed.
void Document::arrive_at(const State& next) {
    motions_.reserve(handles_.size() + 1); // what can fail comes first
    if (next.change) apply(*next.change, handles_);
    take_motions_of(next, handles_.size(), motions_);
    show_pivots(now(), next);
    ++at_;
    posed_is_now_ = false;
}

void Document::change_handles(HandleChange change, std::shared_ptr<const Pivots> pivots) {
    State next = next_state();
    next.change = std::make_shared<const HandleChange>(std::move(change));
    next.pivots = std::move(pivots);
    take(std::move(next));
}

std::vector<Handle> Document::handles_of(std::size_t at) const {
    std::vector<Handle> handles = handles_;
    for (std::size_t later = at_; later > at; --later)
        if (const auto& change = history_[later].change) take_back(*change, handles);
    return handles;
}

std::vector<HandleMotion> Document::motions_of(std::size_t at) const {
    std::vector<HandleMotion> motions(handles_of(at).size());
    std::vector<bool> known(motions.size(), false);
    for (const Posed* posed = history_[at].posed.get(); posed;
         posed = history_[posed->made_from].posed.get()) {
        for (const Moved& moved : posed->moved) {
            if (known[moved.handle]) continue;
            motions[moved.handle] = moved.motion;
            known[moved.handle] = true;
        }
    }
    return motions;
}

// Of an early state this may make shapes again.
void Document::prepare_for(std::size_t at, Progress& progress) {
    pipeline_.prepare({history_[at].settings, handles_of(at), rest_of(history_[at], progress)}, progress);
}

const DragLine* Document::redoable_drag() const {
    if (at_ + 1 == history_.size()) return nullptr;
    const std::shared_ptr<Posed>& next = history_[at_ + 1].posed;
    return next && next != now().posed ? std::get_if<DragLine>(&next->act) : nullptr;
}

std::optional<SettleLine> Document::redoable_settling() const {
    if (at_ + 1 == history_.size()) return std::nullopt;
    const std::shared_ptr<Posed>& next = history_[at_ + 1].posed;
    const auto* line = next && next != now().posed ? std::get_if<SettleLine>(&next->act) : nullptr;
    return line ? std::optional(*line) : std::nullopt;
}

std::vector<HandleMotion> Document::way_of(const std::string& handle) const {
    const Index index = find_handle(handle, "");
    std::vector<const Posed*> drags; // that moved it, the last one first
    for (const Posed* posed = now().posed.get(); posed; posed = history_[posed->made_from].posed.get())
        if (std::ranges::find(posed->moved, index, &Moved::handle) != posed->moved.end())
            drags.push_back(posed);
    std::vector<HandleMotion> way;
    for (auto posed = drags.rbegin(); posed != drags.rend(); ++posed) {
        const auto& drag = std::get<DragLine>((*posed)->act);
        std::vector<HandleMotion> motions = motions_of((*posed)->made_from);
        std::vector<Moved> from = (*posed)->moved, next;
        for (Moved& each : from) each.motion = motions[each.handle];
        for (const HandlePose& pose : drag.frames) {
            move(drag, pose, from, motions, next);
            for (const Moved& each : next) motions[each.handle] = each.motion;
            way.push_back(motions[index]);
        }
    }
    return way;
}

std::shared_ptr<const RestShape> Document::kept_rest() const {
    return now().rest ? now().rest->shape : nullptr;
}

std::shared_ptr<const RestShape> Document::rest_of(const State& state, Progress& progress) {
    if (!state.rest) return nullptr;
    const std::shared_ptr<Committed> committed = state.rest;
    if (!committed->shape) {
        const std::vector<HandleMotion> motions = motions_of(committed->made_from);
        const auto samples = samples_of(history_[committed->made_from], progress);
        posed_is_now_ = false;
        prepare_for(committed->made_from, progress);
        pipeline_.upsample(motions, *samples);
        committed->shape = posed_shape(motions, *samples);
    }
    std::shared_ptr<const RestShape> shape = committed->shape;
    keep(committed);
    return shape;
}

std::shared_ptr<const SampleState> Document::samples_of(const State& state, Progress& progress) {
    std::vector<std::shared_ptr<Posed>> dropped;
    std::shared_ptr<Posed> posed = state.posed;
    for (; posed && !posed->samples; posed = history_[posed->made_from].posed) dropped.push_back(posed);
    std::shared_ptr<const SampleState> samples = posed ? posed->samples : nullptr;
    for (auto next = dropped.rbegin(); next != dropped.rend(); ++next) {
        posed_is_now_ = false;
        prepare_for((*next)->made_from, progress);
        SampleState made = samples ? *samples : pipeline_.rest_state();
        repeat(**next, made, progress);
        samples = (*next)->samples = std::make_shared<const SampleState>(std::move(made));
        keep(*next);
    }
    return samples;
}

// The act that made a pose, once more; the pipeline is prepared for the state before it.
void Document::repeat(const Posed& posed, SampleState& samples, Progress& progress) {
    const State& from = history_[posed.made_from];
    std::vector<HandleMotion> motions = motions_of(posed.made_from);
    FrameMemory memory;
    memory.logs = false;
    if (const auto* settling = std::get_if<SettleLine>(&posed.act)) {
        for (unsigned i = 0; i < settling->iterations; ++i) {
            progress.stop_if_cancelled();
            iterate_once(motions, samples, memory);
        }
        return;
    }
    const auto& drag = std::get<DragLine>(posed.act);
    const auto frames = static_cast<double>(drag.frames.size());
    std::vector<Moved> began = posed.moved, next;
    for (Moved& each : began) each.motion = motions[each.handle];
    for (std::size_t f = 0; f < drag.frames.size(); ++f) {
        progress.step("following the handle again", static_cast<double>(f) / frames);
        const HandlePose& pose = drag.frames[f];
        move(drag, pose, began, motions, next);
        follow(next, pose.coarse, from.settings.iterations, motions, samples, memory, progress);
    }
}

namespace {

// What is kept only spares time: an act that was carried out does not fail for want of memory to keep what it
// made.

// Puts one among those that are kept, which are sorted by where in history they were made. False if there is
// no memory for that.
template<typename Made>
bool put_in(std::vector<std::shared_ptr<Made>>& kept, const std::shared_ptr<Made>& made) noexcept {
    try {
        const auto place = std::ranges::lower_bound(kept, made->made_from, {},
                                                    [](const auto& other) { return other->made_from; });
        if (place == kept.end() || *place != made) kept.insert(place, made);
        return true;
    } catch (const std::bad_alloc&) {
        return false;
    }
}

// Takes out the one that is missed least, but for the one that is needed. Null if there is no memory to find
// it; the next call does.
template<typename Made>
std::shared_ptr<Made> take_out(std::vector<std::shared_ptr<Made>>& kept, const Made& needed,
                               std::size_t now) noexcept {
    try {
        std::vector<std::size_t> places;
        places.reserve(kept.size());
        for (const auto& made : kept) places.push_back(made->made_from + 1);
        const auto least =
            kept.begin() + static_cast<std::ptrdiff_t>(least_missed(places, needed.made_from + 1, now));
        std::shared_ptr<Made> out = std::move(*least);
        kept.erase(least);
        return out;
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

} // namespace

void Document::keep(const std::shared_ptr<Committed>& committed) noexcept {
    if (!put_in(kept_shapes_, committed)) return committed->shape.reset();
    while (mode_ == Mode::real && kept_shapes_.size() > std::max<std::size_t>(memory_.shapes, 1)) {
        const std::shared_ptr<Committed> out = take_out(kept_shapes_, *committed, at_);
        if (!out) return;
        out->shape.reset();
    }
}

void Document::keep(const std::shared_ptr<Posed>& posed) noexcept {
    if (!put_in(kept_samples_, posed)) return posed->samples.reset();
    std::size_t bytes = 0;
    for (const auto& kept : kept_samples_) bytes += bytes_of(*kept->samples);
    while (kept_samples_.size() > std::max<std::size_t>(memory_.samples, 1) && bytes > memory_.sample_bytes) {
        const std::shared_ptr<Posed> out = take_out(kept_samples_, *posed, at_);
        if (!out) return;
        bytes -= bytes_of(*out->samples);
        out->samples.reset();
    }
}

std::size_t Document::kept_bytes() const {
    std::size_t bytes = 0;
    for (const auto& kept : kept_shapes_) bytes += bytes_of(*kept->shape);
    for (const auto& kept : kept_samples_) bytes += bytes_of(*kept->samples);
    return bytes;
}

} // namespace knead
