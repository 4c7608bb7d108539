// Handles keep their places while others come and go.

#include "edit/handle_slots.h"

#include <gtest/gtest.h>

#include <random>

namespace knead {
namespace {

Handle handle_of(Index point) {
    Handle handle;
    handle.points = std::make_shared<const std::vector<Index>>(1, point);
    return handle;
}

void expect_in_order(const HandleSlots& slots, const std::vector<Handle>& list) {
    ASSERT_EQ(slots.slot.size(), list.size());
    ASSERT_EQ(slots.handle.size(), slots.handles.size() + 1);
    EXPECT_EQ(slots.handle.back(), list.size());
    EXPECT_TRUE(std::ranges::is_sorted(slots.slot, std::ranges::less_equal{}));
    std::size_t free = 0;
    for (std::size_t s = 0; s < slots.handles.size(); ++s) {
        free += slots.handles[s].points ? 0 : 1;
        EXPECT_EQ(slots.handle[s] == no_index, !slots.handles[s].points);
    }
    EXPECT_EQ(free + list.size(), slots.handles.size());
    for (Index h = 0; h < list.size(); ++h) {
        EXPECT_TRUE(holds_the_same(slots.handles[slots.slot[h]], list[h]));
        EXPECT_EQ(slots.handle[slots.slot[h]], h);
    }
}

TEST(HandleSlots, StayWhereverAnotherComesOrGoes) {
    std::vector<Handle> list{handle_of(1), handle_of(2), handle_of(3)};
    HandleSlots slots;
    arrange(list, slots);
    for (std::size_t at = 0; at <= 3; ++at) {
        SCOPED_TRACE(at);
        const std::vector<Index> before = slots.slot;
        std::vector<Handle> more = list;
        more.insert(more.begin() + static_cast<std::ptrdiff_t>(at), handle_of(9));
        arrange(more, slots);
        expect_in_order(slots, more);
        std::vector<Index> others = slots.slot;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(at));
        EXPECT_EQ(others, before);
        arrange(list, slots);
        expect_in_order(slots, list);
        EXPECT_EQ(slots.slot, before);
    }
    const std::vector<Index> before = slots.slot;
    list[1] = handle_of(7); // in the place of another
    arrange(list, slots);
    expect_in_order(slots, list);
    EXPECT_EQ(slots.slot, before);
}

TEST(HandleSlots, FindRoomForAnyNumber) {
    std::vector<Handle> list;
    HandleSlots slots;
    std::mt19937 random(4);
    for (Index i = 0; i < 400; ++i) {
        SCOPED_TRACE(i);
        const auto at = list.begin() + static_cast<std::ptrdiff_t>(random() % (list.size() + 1));
        if (i % 3 == 2 && at != list.end())
            list.erase(at);
        else
            list.insert(i % 2 == 0 ? list.begin() : at, handle_of(i));
        arrange(list, slots);
        expect_in_order(slots, list);
        EXPECT_LE(slots.handles.size(), 32 + 16 * (list.size() + 2)) << "they do not grow without need";
    }
    arrange({}, slots);
    expect_in_order(slots, {});
}

TEST(HandleSlots, StayWhileMoreAreAdded) {
    std::vector<Handle> list;
    HandleSlots slots;
    std::size_t anew = 0;
    for (Index i = 0; i < 200; ++i) {
        const std::vector<Index> before = slots.slot;
        list.push_back(handle_of(i));
        arrange(list, slots);
        anew += std::equal(before.begin(), before.end(), slots.slot.begin()) ? 0 : 1;
    }
    EXPECT_LE(anew, 8U); // each time for twice as many
}

} // namespace
} // namespace knead
