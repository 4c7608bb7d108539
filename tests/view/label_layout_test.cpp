// Labels beside what they name, none on another.

#include "view/label_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace knead {
namespace {

constexpr LabelBox view{{0, 0}, {1000, 800}};
constexpr glm::dvec2 size{80, 20};

void expect_no_overlap(const std::vector<PlacedLabel>& placed, std::span<const LabelBox> obstacles) {
    for (std::size_t i = 0; i < placed.size(); ++i) {
        if (!placed[i].shown) continue;
        EXPECT_TRUE(view.contains(placed[i].box));
        for (const LabelBox& obstacle : obstacles) EXPECT_FALSE(placed[i].box.overlaps(obstacle));
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_FALSE(placed[k].shown && placed[i].box.overlaps(placed[k].box)) << i << " and " << k;
    }
}

TEST(LabelLayout, ALoneLabelStandsWhereItWouldRatherBe) {
    const std::vector<Label> labels{{{500, 400}, size, 0}, {{200, 400}, size, 50}};
    const auto placed = lay_out_labels(labels, {}, view);
    EXPECT_EQ(placed[0].box.lowest, glm::dvec2(460, 390));
    EXPECT_FALSE(placed[0].is_led);
    EXPECT_EQ(placed[1].box.lowest, glm::dvec2(160, 340));
    EXPECT_TRUE(placed[1].is_led);
    EXPECT_EQ(placed[1].foot, glm::dvec2(200, 360));
}

TEST(LabelLayout, ThoseInOnePlaceMakeRoomForEachOther) {
    const std::vector<Label> labels(12, {{500, 400}, size, 0});
    const auto placed = lay_out_labels(labels, {}, view);
    expect_no_overlap(placed, {});
    for (const PlacedLabel& label : placed) EXPECT_TRUE(label.shown);
    EXPECT_FALSE(placed[0].is_led) << "the first has the choice";
}

TEST(LabelLayout, NoneLiesOnAPanelOrBeyondTheBorder) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> across(0, 1000), down(0, 800);
    std::vector<Label> labels;
    for (int i = 0; i < 60; ++i) labels.push_back({{across(random), down(random)}, size, 0});
    const std::vector<LabelBox> obstacles{{{0, 0}, {150, 260}}, {{600, 650}, {1000, 800}}};
    const auto placed = lay_out_labels(labels, obstacles, view);
    expect_no_overlap(placed, obstacles);
    EXPECT_GT(std::ranges::count_if(placed, [](const PlacedLabel& label) { return label.shown; }), 45);
}

TEST(LabelLayout, WhatLiesOutOfTheViewHasNoLabel) {
    const std::vector<Label> labels{{{-5, 400}, size, 0}, {{500, 801}, size, 0}};
    for (const PlacedLabel& label : lay_out_labels(labels, {}, view)) EXPECT_FALSE(label.shown);
}

TEST(LabelLayout, WhatFindsNoRoomIsLeftOut) {
    const std::vector<LabelBox> everything{view};
    EXPECT_FALSE(lay_out_labels(std::vector<Label>{{{500, 400}, size, 0}}, everything, view)[0].shown);
    EXPECT_TRUE(lay_out_labels({}, everything, view).empty());
}

} // namespace
} // namespace knead
