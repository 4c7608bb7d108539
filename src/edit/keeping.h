#pragma once
// Which of the things that history keeps, and can make again, is to go when there are too many. Private to
// this room.

#include <cstddef>
#include <span>

namespace knead {

// `places`: where in history they were made, ascending; one of them is `needed`, which stays, and there is
// another. `now`: the place of the present. Returns the number of the one that is missed least: whatever
// comes after it has then to be made from the one before it, so one close behind another goes first, and far
// from the present sooner than near it. So the gaps grow with the distance, and going back step by step costs
// a few steps each time, however long history is.
std::size_t least_missed(std::span<const std::size_t> places, std::size_t needed, std::size_t now);

} // namespace knead
