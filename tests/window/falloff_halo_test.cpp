// The dots around the chosen handle: how far they reach, and when there are others or none.

#include "app/falloff_halo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace knead::test {

namespace {

// A row of points, one apart, each linked to the next, of a cloud in which all handles are large but for
// their falloff. "hand" holds the first ten.
class Halo : public ::testing::Test {
protected:
    static constexpr Index points = 200, held = 10;

    void SetUp() override {
        RestShape shape;
        Graph graph{{0}, {}};
        for (Index i = 0; i < points; ++i) {
            for (const float value : {static_cast<float>(i), 0.0F, 0.0F}) shape.positions.push_back(value);
            if (i > 0) graph.neighbor.push_back(i - 1);
            if (i + 1 < points) graph.neighbor.push_back(i + 1);
            graph.first.push_back(static_cast<Index>(graph.neighbor.size()));
            order_.file_index.push_back(i);
            editor_.ordered.push_back(i);
        }
        order_.vertex = Numbering::as_they_stand(points);
        order_.first_point = Numbering::as_they_stand(points + 1);
        editor_.opened.order = &order_;
        editor_.opened.opened = std::make_shared<const RestShape>(std::move(shape));
        document_.graph = std::make_shared<const Graph>(std::move(graph));
        std::vector<Index> hand(held);
        for (Index i = 0; i < held; ++i) hand[i] = i;
        document_.handles.emplace_back().name = "hand";
        document_.handles.back().points = std::make_shared<const std::vector<Index>>(std::move(hand));
        document_.motions.resize(1);
        editor_.marks.assign(points, 0);
        std::fill_n(editor_.marks.begin(), held, handle_mark(0));
        editor_.chosen = "hand";
        with_falloff(20);
    }
    void with_falloff(double falloff) {
        document_.handles.back().falloff = falloff;
        editor_.document = std::make_shared<const DocumentView>(document_);
    }
    // What is to be seen once the search is over.
    std::vector<HaloDot> dots(bool wanted = true) {
        for (halo_.look_at(editor_, wanted); halo_.expected(); halo_.look_at(editor_, wanted))
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return halo_.dots() ? *halo_.dots() : std::vector<HaloDot>();
    }

    PointOrder order_;
    DocumentView document_;
    Editor editor_{1};
    FalloffHalo halo_;
};

TEST_F(Halo, ReachesToTheEndOfTheFalloffAndFades) {
    const std::vector<HaloDot> found = dots();
    ASSERT_EQ(found.size(), 20U);
    for (const HaloDot& dot : found) {
        EXPECT_GE(dot.vertex, held);
        EXPECT_NEAR(dot.nearness, 1 - (dot.vertex - held + 1) / 20.0, 1e-6) << dot.vertex;
    }
}

TEST_F(Halo, IsOfWhatNoLaterHandleHolds) {
    editor_.marks[held - 1] = handle_mark(1);
    for (const HaloDot& dot : dots()) EXPECT_LT(dot.vertex, held - 1 + 20U);
}

TEST_F(Halo, IsAnotherForAnotherFalloffOrHandle) {
    EXPECT_EQ(dots().size(), 20U);
    with_falloff(50);
    halo_.look_at(editor_, true);
    EXPECT_EQ(halo_.dots(), nullptr) << "what is not known yet is not shown";
    EXPECT_EQ(dots().size(), 50U);
    with_falloff(0);
    EXPECT_TRUE(dots().empty());
    with_falloff(20);
    EXPECT_EQ(dots().size(), 20U);
    editor_.chosen.clear();
    EXPECT_TRUE(dots().empty());
}

// The first point is a patch of its own that pulls as far as 40, the others pull nothing.
TEST_F(Halo, IsAroundWhatIsSmallWhereTheHandleHasNoFalloff) {
    const auto small = [&](Index vertex) {
        PatchesOfHandles patches;
        patches.points = {nullptr, document_.handles.back().points};
        patches.patches.push_back({1, 0, 40, 0, {vertex}});
        document_.small_patches = std::make_shared<const PatchesOfHandles>(std::move(patches));
    };
    small(0);
    with_falloff(0);
    EXPECT_TRUE(dots().empty()) << "all else is nearer to the others";
    small(held - 1);
    with_falloff(0);
    const std::vector<HaloDot> found = dots();
    ASSERT_EQ(found.size(), 40U);
    for (const HaloDot& dot : found)
        EXPECT_NEAR(dot.nearness, 1 - (dot.vertex - held + 1) / 40.0, 1e-6) << dot.vertex;
    with_falloff(50);
    EXPECT_EQ(dots().size(), 50U) << "its own is larger";
    document_.handles.back().points = std::make_shared<const std::vector<Index>>(Index{held}, Index{0});
    with_falloff(0);
    EXPECT_TRUE(dots().empty()) << "they are of another handle";
}

TEST_F(Halo, IsNotThereWhereItIsNotWanted) {
    EXPECT_EQ(dots().size(), 20U);
    EXPECT_TRUE(dots(false).empty());
    EXPECT_EQ(dots().size(), 20U);
}

TEST_F(Halo, OfTheCloudBeforeIsDropped) {
    halo_.look_at(editor_, true);
    halo_.begin_anew();
    editor_.document.reset();
    EXPECT_TRUE(dots().empty());
}

} // namespace

} // namespace knead::test
