#include "edit/handle_slots.h"

#include <algorithm>
#include <bit>

namespace knead {

namespace {

constexpr std::size_t fewest_slots = 32, slots_a_handle = 4;

// Places for `count` handles that leave some free before and between them, and half of all behind.
std::vector<Index> spread(std::size_t count, std::size_t& slots) {
    slots = std::bit_ceil(std::max(fewest_slots, 2 * slots_a_handle * (count + 1)));
    std::vector<Index> slot(count);
    for (std::size_t h = 0; h < count; ++h) slot[h] = static_cast<Index>((h + 2) * slots_a_handle - 1);
    return slot;
}

// `count` places between the last of `before` and the first of `after` that leave some free, behind `before`;
// returns whether there are as many.
bool find_between(std::vector<Index>& before, std::span<const Index> after, std::size_t count,
                  std::size_t slots) {
    const std::size_t begin = before.empty() ? 0 : before.back() + 1;
    const std::size_t end = after.empty() ? slots : after.front();
    std::size_t step = (end - begin + 1) / (count + 1);
    if (after.empty()) step = std::min(step, slots_a_handle); // more may follow
    if (count > 0 && step == 0) return false;
    for (std::size_t k = 1; k <= count; ++k) before.push_back(static_cast<Index>(begin + k * step - 1));
    return true;
}

} // namespace

void arrange(const std::vector<Handle>& list, HandleSlots& slots) {
    const std::vector<Index>& former = slots.slot;
    const auto is_at = [&](const Handle& handle, Index slot) {
        return holds_the_same(handle, slots.handles[slot]);
    };
    const auto first = std::ranges::mismatch(list, former, is_at).in2 - former.begin();
    const auto longest = static_cast<std::ptrdiff_t>(std::min(list.size(), former.size())) - first;
    std::ptrdiff_t last = 0; // so many at the end are as they were
    while (last < longest && is_at(list[list.size() - 1 - static_cast<std::size_t>(last)],
                                   former[former.size() - 1 - static_cast<std::size_t>(last)]))
        ++last;
    const std::span after(former.end() - last, former.end());
    const std::size_t kept_before =
        std::min(list.size(), former.size()) - static_cast<std::size_t>(last); // with what is between
    std::vector<Index> slot(former.begin(), former.begin() + static_cast<std::ptrdiff_t>(kept_before));
    std::size_t count = slots.handles.size();
    if (find_between(slot, after, list.size() - kept_before - after.size(), count))
        slot.insert(slot.end(), after.begin(), after.end());
    else
        slot = spread(list.size(), count);

    HandleSlots next{std::vector<Handle>(count), std::move(slot), std::vector<Index>(count + 1, no_index)};
    for (Index h = 0; h < list.size(); ++h) {
        next.handles[next.slot[h]] = list[h];
        next.handle[next.slot[h]] = h;
    }
    next.handle.back() = static_cast<Index>(list.size());
    slots = std::move(next);
}

} // namespace knead
