#include "app/draw_budget.h"

#include <gtest/gtest.h>

#include <set>

namespace knead::test {
namespace {

constexpr double target = 1.0 / 30;

// A machine, and the pictures of a cloud that it draws.
struct Machine {
    double a_point = 60e-9, rest = 0.012; // seconds
    double quicker_coarse = 3;            // rest, with half as many pixels each way

    double draw(DrawBudget& budget, std::size_t cloud) const {
        const std::size_t stride = (cloud + budget.points() - 1) / budget.points();
        const std::size_t drawn = cloud / stride;
        const double of_points = static_cast<double>(drawn) * a_point;
        const double all = of_points + (budget.coarse() ? rest / quicker_coarse : rest);
        budget.learn(drawn, of_points, all);
        return all;
    }
};

TEST(DrawBudget, fills_the_time_that_there_is) {
    for (const double a_point : {20e-9, 60e-9, 200e-9}) {
        DrawBudget budget(target);
        const Machine machine{a_point};
        double last = 0;
        for (int picture = 0; picture < 60; ++picture) last = machine.draw(budget, 50'000'000);
        EXPECT_LT(last, 1.15 * target) << a_point;
        EXPECT_GT(last, 0.8 * target) << a_point;
        EXPECT_FALSE(budget.coarse());
    }
}

TEST(DrawBudget, a_cloud_that_fits_is_drawn_whole) {
    DrawBudget budget(target);
    for (int picture = 0; picture < 60; ++picture) Machine{20e-9}.draw(budget, 437'645);
    EXPECT_GE(budget.points(), 437'645U);
}

TEST(DrawBudget, does_not_swing) {
    DrawBudget budget(target);
    std::set<std::size_t> strides;
    for (int picture = 0; picture < 400; ++picture) {
        Machine machine;
        machine.a_point *= picture % 3 == 0 ? 1.15 : 0.95; // as it is measured
        machine.draw(budget, 1'000'000);
        if (picture > 60) strides.insert((1'000'000 + budget.points() - 1) / budget.points());
    }
    EXPECT_EQ(strides.size(), 1U);
}

TEST(DrawBudget, one_late_picture_changes_little) {
    DrawBudget budget(target);
    for (int picture = 0; picture < 60; ++picture) Machine{}.draw(budget, 2'000'000);
    const auto before = static_cast<double>(budget.points());
    Machine{60e-9, 0.3}.draw(budget, 2'000'000);
    EXPECT_GT(static_cast<double>(budget.points()), 0.75 * before);
    EXPECT_FALSE(budget.coarse());
}

TEST(DrawBudget, coarse_pixels_are_the_last_resort_and_full_ones_are_tried_ever_more_seldom) {
    DrawBudget budget(target);
    const Machine slow{60e-9, 0.06};
    int coarse = 0, changes = 0;
    bool before = false;
    for (int picture = 0; picture < 3000; ++picture) {
        slow.draw(budget, 2'000'000);
        coarse += budget.coarse() ? 1 : 0;
        changes += budget.coarse() != before ? 1 : 0;
        before = budget.coarse();
        if (budget.coarse()) {
            EXPECT_GE(budget.points(), std::size_t{DrawBudget::least});
        }
    }
    EXPECT_GT(coarse, 2700);
    EXPECT_LT(changes, 20);
    const Machine quick{20e-9, 0.005}; // the other programs have ended
    for (int picture = 0; picture < 1200; ++picture) quick.draw(budget, 2'000'000);
    EXPECT_FALSE(budget.coarse());
}

TEST(DrawBudget, pictures_without_points_say_nothing) {
    DrawBudget budget(target);
    const std::size_t before = budget.points();
    budget.learn(0, 0, 5);
    EXPECT_EQ(budget.points(), before);
}

} // namespace
} // namespace knead::test
