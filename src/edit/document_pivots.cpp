#include "edit/document_pivots.h"

#include "edit/handle_motion.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
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

// Where a handle's place goes when the handle leaves one motion for another.
Vec3d moved_on(const Vec3d& place, const HandleMotion& before, const HandleMotion& after) {
    return after.linear * point_at_rest(before, place) + after.offset;
}

// Calls take(name, place) with where they are now, relative to the cloud's origin.
template<typename Take>
void for_places(const Pivots& pivots, std::span<const Handle> handles, std::span<const HandleMotion> motions,
                const Vec3d& origin, Take&& take) {
    for (std::size_t h = 0; h < handles.size(); ++h)
        if (const auto found = pivots.find(handles[h].name); found != pivots.end())
            take(found->first, motions[h].linear * (found->second - origin) + motions[h].offset);
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
        if (!state.posed)
            motions.assign(handles.size(), HandleMotion{});
        else
            for (const Moved& moved : state.posed->moved) motions[moved.handle] = moved.motion;
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

Pivots Document::last_pivots() const {
    const auto is_told = [&](const std::string& handle) {
        return std::ranges::any_of(
            history_, [&](const State& state) { return state.pivots && state.pivots->contains(handle); });
    };
    Pivots pivots;
    using Carry = std::function<Vec3d(const Vec3d&)>;
    std::map<std::string, Carry>
        carried_later;          // where handles went with others since the last drag of their own
    std::set<std::string> made; // from there on: what had that name before is another handle
    for (std::size_t at = at_; at > 0; --at) {
        if (const auto& change = history_[at].change; change && change->come)
            if (!change->gone || change->gone->handle.name != change->come->handle.name)
                made.insert(change->come->handle.name);
        const std::shared_ptr<Posed>& posed = history_[at].posed;
        if (!posed || posed == history_[at - 1].posed) continue;
        const auto* drag = std::get_if<DragLine>(&posed->act);
        if (!drag) continue;
        const auto is_known = [&](const std::string& handle) {
            return pivots.contains(handle) || made.contains(handle) || is_told(handle);
        };
        if (!is_known(drag->handle)) {
            const HandleMotion before = motions_of(posed->made_from)[posed->moved[0].handle];
            const Vec3d place = moved_on(drag->pivot - cloud_.origin, before, posed->moved[0].motion);
            const auto later = carried_later.find(drag->handle);
            pivots[drag->handle] = later == carried_later.end() ? place : later->second(place);
        }
        for (std::size_t k = 1; k < posed->moved.size(); ++k) {
            const std::string& handle = drag->with[k - 1];
            if (is_known(handle)) continue;
            const HandleMotion before = motions_of(posed->made_from)[posed->moved[k].handle];
            const auto later = carried_later.find(handle);
            carried_later[handle] = [before, after = posed->moved[k].motion,
                                     on = later == carried_later.end() ? Carry()
                                                                       : later->second](const Vec3d& place) {
                const Vec3d there = moved_on(place, before, after);
                return on ? on(there) : there;
            };
        }
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
