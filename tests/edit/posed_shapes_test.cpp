// Shapes that are kept while the next ones are made.

#include "base/workers.h"
#include "edit/posed_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace knead {
namespace {

class Shapes : public ::testing::Test {
protected:
    Shapes() { shapes_.make_room(6, 3, workers_); }

    // Writes a shape of this number; returns whether there was another one before in its place.
    bool write(float number) {
        const auto [shape, was_written] = shapes_.next(workers_);
        EXPECT_EQ(shape.positions.size(), 6U);
        EXPECT_EQ(shape.normals.size(), 3U);
        std::ranges::fill(shape.positions, number);
        std::ranges::fill(shape.normals, -number);
        EXPECT_EQ(&shape, &shapes_.now());
        return was_written;
    }
    static bool is(const RestShape& shape, float number) {
        return std::ranges::count(shape.positions, number) == 6 &&
               std::ranges::count(shape.normals, -number) == 3;
    }

    Workers workers_{2};
    PosedShapes shapes_;
};

TEST_F(Shapes, AreWrittenOverWhereNobodyKeepsThem) {
    EXPECT_FALSE(write(1));
    const float* const place = shapes_.now().positions.data();
    EXPECT_TRUE(write(2));
    EXPECT_EQ(shapes_.now().positions.data(), place);
}

TEST_F(Shapes, StayAsTheyAreForWhoKeepsThem) {
    std::vector<std::shared_ptr<const RestShape>> kept;
    for (int number = 1; number <= 6; ++number) {
        EXPECT_FALSE(write(static_cast<float>(number)));
        kept.push_back(shapes_.keep_now());
        EXPECT_EQ(kept.back().get(), &shapes_.now());
    }
    for (int number = 1; number <= 6; ++number)
        EXPECT_TRUE(is(*kept[static_cast<std::size_t>(number) - 1], static_cast<float>(number)));
}

TEST_F(Shapes, ComeBackFromWhoLetsGoOfThem) {
    write(1);
    auto shown = shapes_.keep_now();
    write(2);
    auto waits = shapes_.keep_now();
    EXPECT_FALSE(write(3));
    const float* const place = shown->positions.data();
    shapes_.keep_now(); // and not for long
    shown = std::move(waits);
    EXPECT_TRUE(write(4)) << "over the first or the third";
    auto newest = shapes_.keep_now();
    EXPECT_TRUE(write(5)) << "over the other one";
    EXPECT_TRUE(newest->positions.data() == place || shapes_.now().positions.data() == place);
    EXPECT_TRUE(is(*shown, 2) && is(*newest, 4) && is(shapes_.now(), 5));
}

TEST_F(Shapes, MayOutliveWhatMadeThem) {
    std::shared_ptr<const RestShape> kept;
    {
        PosedShapes others;
        others.make_room(3, 0, workers_);
        others.next(workers_).shape.positions[0] = 7;
        kept = others.keep_now();
    }
    EXPECT_EQ(kept->positions[0], 7);
    EXPECT_TRUE(kept->normals.empty());
}

TEST_F(Shapes, HaveSparesAheadOfTheFirstFrame) {
    shapes_.make_spares(workers_);
    shapes_.make_spares(workers_); // there are enough
    write(1);
    const auto first = shapes_.keep_now();
    EXPECT_FALSE(write(2)) << "a spare has nothing in it";
    const auto second = shapes_.keep_now();
    EXPECT_FALSE(write(3));
    EXPECT_TRUE(is(*first, 1) && is(*second, 2) && is(shapes_.now(), 3));
}

TEST_F(Shapes, OfOtherSizesLeaveKeptOnesAlone) {
    write(1);
    const auto kept = shapes_.keep_now();
    shapes_.make_room(9, 0, workers_);
    EXPECT_FALSE(shapes_.next(workers_).was_written);
    EXPECT_EQ(shapes_.now().positions.size(), 9U);
    EXPECT_TRUE(is(*kept, 1));
}

} // namespace
} // namespace knead
