#include "app/handle_colors.h"

#include <gtest/gtest.h>

namespace knead::test {

namespace {

Handle handle(const std::string& name, HandleRole role = HandleRole::moving) {
    Handle made;
    made.name = name;
    made.role = role;
    made.points = std::make_shared<const std::vector<Index>>(1, Index{0});
    return made;
}

std::vector<ImU32> colors_of(const HandleColors& colors, const std::vector<Handle>& handles) {
    std::vector<ImU32> result;
    for (const Handle& one : handles) result.push_back(handle_color(colors, one));
    return result;
}

} // namespace

TEST(HandleColors, StayWhileOthersComeAndGo) {
    const Handle a = handle("a"), b = handle("b"), c = handle("c"), d = handle("d");
    HandleColors colors;
    place_colors(colors, std::vector{a, b, c});
    const std::vector<ImU32> three = colors_of(colors, {a, b, c});
    EXPECT_NE(three[0], three[1]);
    EXPECT_NE(three[1], three[2]);
    EXPECT_NE(three[0], three[2]);

    place_colors(colors, std::vector{b, c});
    EXPECT_EQ(colors_of(colors, {b, c}), (std::vector{three[1], three[2]}));
    place_colors(colors, std::vector{b, c, d});
    EXPECT_EQ(handle_color(colors, d), three[0]) << "the first that is free";
    place_colors(colors, std::vector{a, b, c});
    EXPECT_EQ(colors_of(colors, {a, b, c}), three) << "as before the deletion was undone";
}

TEST(HandleColors, FollowANewName) {
    Handle a = handle("a"), b = handle("b");
    HandleColors colors;
    place_colors(colors, std::vector{a, b});
    const ImU32 usual = handle_color(colors, b);
    a.name = "first";
    b.name = "second";
    place_colors(colors, std::vector{a, b});
    EXPECT_EQ(handle_color(colors, b), usual);
}

TEST(HandleColors, GoByTheNumberInTheNameSoThatASessionLooksTheSameAgain) {
    const Handle one = handle("handle 1"), two = handle("handle 2"), third = handle("handle 2 and 3");
    HandleColors made;
    place_colors(made, std::vector{one});
    place_colors(made, std::vector{one, two});
    place_colors(made, std::vector{two});
    HandleColors opened;
    place_colors(opened, std::vector{two});
    EXPECT_EQ(handle_color(opened, two), handle_color(made, two));
    place_colors(opened, std::vector{two, third});
    EXPECT_NE(handle_color(opened, third), handle_color(opened, two));
}

TEST(HandleColors, KeepTheListInTheOrderInWhichHandlesCame) {
    Handle a = handle("a"), b = handle("b"), c = handle("c");
    b.came = 1;
    c.came = 2;
    const std::vector again{b, c, a}; // "a" was changed, and so declared again
    EXPECT_EQ(order_of_list(again), (std::vector<std::size_t>{2, 0, 1}));
}

TEST(HandleColors, TheOneTriedCountsThenTheOneChosenThenTheUsual) {
    Handle a = handle("a"), b = handle("b");
    HandleColors colors;
    place_colors(colors, std::vector{a, b});
    const ImU32 usual = handle_color(colors, a), of_other = handle_color(colors, b);
    a.color = 0x123456;
    EXPECT_EQ(handle_color(colors, a), IM_COL32(0x12, 0x34, 0x56, 255));
    colors.tried = {"a", IM_COL32(1, 2, 3, 255)};
    EXPECT_EQ(handle_color(colors, a), IM_COL32(1, 2, 3, 255));
    EXPECT_EQ(handle_color(colors, b), of_other);
    colors.tried.reset();
    a.color.reset();
    EXPECT_EQ(handle_color(colors, a), usual);
}

} // namespace knead::test
