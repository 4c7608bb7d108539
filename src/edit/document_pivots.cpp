#include "edit/document_pivots.h"

#include "edit/handle_motion.h"

#include <algorithm>
#include <utility>

namespace knead {

std::shared_ptr<const Pivots> with_pivot(const std::shared_ptr<const Pivots>& pivots,
                                         const std::string& handle, const std::optional<Vec3d>& place) {
    if (!place && (!pivots || !pivots->contains(handle))) return pivots;
    Pivots others = pivots ? *pivots : Pivots();
    if (place)
        others[handle] = *place;
    else
        others.erase(handle);
    return others.empty() ? nullptr : std::make_shared<const Pivots>(std::move(others));
}

namespace {

// Calls take(name, place) with where they are now, relative to the cloud's origin.
template<typename Take>
void for_places(const Pivots& pivots, std::span<const Handle> handles, std::span<const HandleMotion> motions,
                const Vec3d& origin, Take&& take) {
    for (std::size_t h = 0; h < handles.size(); ++h)
        if (const auto found = pivots.find(handles[h].name); found != pivots.end())
            take(found->first, moved_point(motions[h], found->second - origin));
}

} // namespace

std::shared_ptr<const Pivots> carried(const std::shared_ptr<const Pivots>& pivots,
                                      std::span<const Handle> handles, std::span<const HandleMotion> motions,
                                      const Vec3d& origin) {
    if (!pivots) return nullptr;
    Pivots moved;
    for_places(*pivots, handles, motions, origin,
               [&](const std::string& name, const Vec3d& place) { moved[name] = place + origin; });
    return std::make_shared<const Pivots>(std::move(moved));
}

// The handles of the present list have theirs as a state has them.
void Document::show_pivots(const State& before, const State& now) noexcept {
    if (!before.pivots && !now.pivots) return; // of handles, of which there may be thousands, none has one
    for (Handle& handle : handles_) {
        handle.pivot.reset();
        if (!now.pivots) continue;
        const auto found = now.pivots->find(handle.name);
        if (found != now.pivots->end()) handle.pivot = found->second;
    }
}

std::vector<std::vector<Document::PivotMove>> Document::pivot_moves() const {
    std::vector<std::vector<PivotMove>> moves(history_.size() - 1);
    std::vector<Handle> handles = handles_of(0);
    std::vector<HandleMotion> motions(handles.size());
    Pivots before;
    for (std::size_t at = 1; at < history_.size(); ++at) {
        const State& state = history_[at];
        if (state.change) apply(*state.change, handles);
        take_motions_of(state, handles.size(), motions);
        Pivots after;
        if (state.pivots)
            for_places(*state.pivots, handles, motions, cloud_.origin,
                       [&](const std::string& name, const Vec3d& place) { after[name] = place; });
        for (const auto& [name, place] : before)
            if (!after.contains(name)) moves[at - 1].push_back({name, place, std::nullopt});
        for (const auto& [name, place] : after) {
            const auto old = before.find(name);
            if (old == before.end())
                moves[at - 1].push_back({name, std::nullopt, place});
            else if (old->second != place)
                moves[at - 1].push_back({name, old->second, place});
        }
        before = std::move(after);
    }
    return moves;
}

// What a drag did to where the joints are that its handles have from drags.
void Document::move_pivots(const Posed& posed, std::vector<HandleMotion>& motions, Pivots& pivots) const {
    const auto* drag = std::get_if<DragLine>(&posed.act);
    for (std::size_t k = 0; k < posed.moved.size(); ++k) {
        const HandleMotion &now = posed.moved[k].motion, &before = motions[posed.moved[k].handle];
        if (drag && k == 0)
            pivots[drag->handle] = moved_on(drag->pivot - cloud_.origin, before, now);
        else if (const auto place = drag ? pivots.find(drag->with[k - 1].handle) : pivots.end();
                 place != pivots.end())
            place->second = moved_on(place->second, before, now);
        motions[posed.moved[k].handle] = now;
    }
}

Pivots Document::last_pivots() const {
    Pivots pivots;
    std::vector<Handle> handles = handles_of(0);
    std::vector<HandleMotion> motions(handles.size());
    for (std::size_t at = 1; at <= at_; ++at) {
        const State &state = history_[at], &before = history_[at - 1];
        if (state.change) apply(*state.change, handles);
        if (const auto& change = state.change; change && change->come)
            if (!change->gone || change->gone->handle.name != change->come->handle.name)
                pivots.erase(change->come->handle.name); // what had that name before is another handle
        if (!state.posed)
            motions.assign(handles.size(), HandleMotion{});
        else if (state.posed != before.posed)
            move_pivots(*state.posed, motions, pivots);
    }
    const Pivots* told = nullptr;
    for (const State& state : history_) {
        if (!state.pivots || state.pivots.get() == told) continue;
        told = state.pivots.get();
        for (const auto& [name, place] : *told) pivots.erase(name);
    }
    return pivots;
}

std::vector<Handle> Document::handles_committed() const {
    std::vector<Handle> handles = handles_;
    const std::shared_ptr<const Pivots> pivots = carried(now().pivots, handles_, motions_, cloud_.origin);
    if (!pivots) return handles;
    for (Handle& handle : handles)
        if (const auto found = pivots->find(handle.name); found != pivots->end())
            handle.pivot = found->second;
    return handles;
}

} // namespace knead
