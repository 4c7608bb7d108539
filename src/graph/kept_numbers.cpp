#include "graph/kept_numbers.h"

#include "base/require.h"

#include <algorithm>
#include <cstdint>

namespace knead {

namespace {

// Numbers that follow upon each other leave as many as this between them, so that there is room for more.
constexpr std::int64_t widest_step = 8;

// Of each item the number that it had, no_index if none.
std::vector<Index> former_numbers(std::span<const Numbered> before, std::span<const Index> items) {
    std::vector<Numbered> by_item(before.begin(), before.end());
    std::ranges::sort(by_item, {}, &Numbered::item);
    std::vector<Index> former(items.size(), no_index);
    for (std::size_t i = 0; i < items.size(); ++i) {
        const auto found = std::ranges::lower_bound(by_item, items[i], {}, &Numbered::item);
        if (found != by_item.end() && found->item == items[i]) former[i] = found->number;
    }
    return former;
}

// Leaves the longest ascending part of these numbers, which are different, and no_index for the others.
void leave_ascending(std::vector<Index>& numbers) {
    std::vector<std::size_t> last;                        // of a part of each length, where its last is
    std::vector<std::size_t> previous(numbers.size(), 0); // in its part; of the first anything
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i] == no_index) continue;
        const auto place =
            std::ranges::lower_bound(last, numbers[i], {}, [&](std::size_t j) { return numbers[j]; });
        if (place != last.begin()) previous[i] = *(place - 1);
        if (place == last.end())
            last.push_back(i);
        else
            *place = i;
    }
    std::vector<Index> ascending(numbers.size(), no_index);
    std::size_t at = last.empty() ? 0 : last.back();
    for (std::size_t length = last.size(); length > 0; --length, at = previous[at])
        ascending[at] = numbers[at];
    numbers = std::move(ascending);
}

// Gives numbers to those that have none. Returns whether there is room for them.
bool fill(std::span<Index> numbers, Index first, Index end) {
    std::int64_t below = std::int64_t{first} - 1;
    for (auto from = numbers.begin(); from != numbers.end();) {
        const auto to = std::find_if(from, numbers.end(), [](Index number) { return number != no_index; });
        const std::int64_t above = to == numbers.end() ? std::int64_t{end} : std::int64_t{*to};
        const std::int64_t count = to - from;
        if (count > above - below - 1) return false;
        const std::int64_t step = std::min(widest_step, (above - below) / (count + 1));
        for (; from != to; ++from) *from = static_cast<Index>(below += step);
        if (to == numbers.end()) return true;
        below = above;
        from = to + 1;
    }
    return true;
}

} // namespace

std::vector<Index> kept_numbers(std::span<const Numbered> before, std::span<const Index> items, Index first,
                                Index end) {
    std::vector<Index> numbers = former_numbers(before, items);
    leave_ascending(numbers);
    if (fill(numbers, first, end)) return numbers;
    std::ranges::fill(numbers, no_index);
    require(fill(numbers, first, end), "there are no more items than numbers");
    return numbers;
}

} // namespace knead
