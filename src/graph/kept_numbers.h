#pragma once
// Numbers that the items of a list keep while others come and go anywhere in it.

#include "base/types.h"

#include <span>
#include <vector>

namespace knead {

// An item, which is told by a number that others may have had before.
struct Numbered {
    Index item, number;
};

// Numbers for different items in this order, ascending, from `first` up to `end`, which is no number itself;
// those that stay may lie beyond, where `end` was higher before.
// `before`: the numbers that there were, from the same `first` on. As many of these as the order allows stay,
// and what is new gets numbers between them; where there is no room for it, all numbers are new. There are no
// more items than numbers.
std::vector<Index> kept_numbers(std::span<const Numbered> before, std::span<const Index> items, Index first,
                                Index end);

} // namespace knead
