#include "render/scattered.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace knead {

namespace {

constexpr int bits = std::countr_zero(points_in_chunk);
static_assert(std::has_single_bit(points_in_chunk));

// A part of a chunk has two points at least.
constexpr std::size_t most_parts = points_in_chunk / 2;

std::uint16_t reversed(std::uint32_t number) {
    std::uint32_t result = 0;
    for (int bit = 0; bit < bits; ++bit) result |= (number >> bit & 1U) << (bits - 1 - bit);
    return static_cast<std::uint16_t>(result);
}

} // namespace

std::vector<std::uint16_t> scattered_order(std::size_t points) {
    std::vector<std::uint16_t> order;
    order.reserve(points);
    for (std::uint32_t number = 0; number < points_in_chunk; ++number)
        if (const std::uint16_t place = reversed(number); place < points) order.push_back(place);
    return order;
}

std::vector<std::uint16_t> slots_of_part(std::span<const std::uint16_t> order, std::size_t part,
                                         std::size_t parts) {
    const std::size_t first = order.size() * part / parts, end = order.size() * (part + 1) / parts;
    std::vector<std::uint16_t> slots(end - first);
    std::iota(slots.begin(), slots.end(), static_cast<std::uint16_t>(first));
    std::ranges::sort(slots, {}, [&](std::uint16_t slot) { return order[slot]; });
    return slots;
}

PartOfChunk part_of_chunk(std::size_t subset, std::size_t subsets) {
    PartOfChunk own;
    own.step = (subsets + most_parts - 1) / most_parts;
    own.rest = subset % own.step;
    own.part = subset / own.step;
    own.parts = (subsets - own.rest + own.step - 1) / own.step; // subsets of these chunks
    return own;
}

} // namespace knead
