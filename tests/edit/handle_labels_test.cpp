// Who holds a point.

#include "edit/handle_labels.h"

#include "graph/point_order.h"

#include <gtest/gtest.h>

#include <numeric>

namespace knead {
namespace {

Handle holding(std::vector<Index> points, HandleRole role = HandleRole::moving) {
    Handle handle;
    handle.role = role;
    handle.points = std::make_shared<const std::vector<Index>>(std::move(points));
    return handle;
}

struct Labelled {
    PointOrder order;
    HandleLabels labels;

    Labelled(const std::vector<Handle>& handles, const std::vector<float>& positions) {
        Workers workers(2);
        SilentProgress progress;
        order = order_points(positions, workers, progress);
        label_points(handles, order, positions.size() / 3, workers, labels);
    }
};

TEST(HandleLabels, AreTheSameForAnyNumberOfHandles) {
    constexpr Index points = 300;
    std::vector<float> positions(3 * points, 0);
    for (Index i = 0; i < points; ++i) positions[3 * i] = static_cast<float>(i);
    for (const Index count : {2U, 254U, 255U, 256U}) {
        std::vector<Index> region(280);
        std::iota(region.begin(), region.end(), Index{0});
        std::vector<Handle> handles{holding(region, HandleRole::region_of_interest)};
        for (Index h = 1; h < count; ++h) handles.push_back(holding({h}));
        const Labelled found(handles, positions);
        EXPECT_EQ(found.labels.outside, count);
        for (Index i = 0; i < points; ++i) {
            const Index point = found.order.file_index[i];
            const bool is_held = point >= 1 && point < count;
            const Index expected = is_held ? point : point < 280 ? no_index : found.labels.outside;
            ASSERT_EQ(found.labels.point[i], expected) << "point " << point << " of " << count << " handles";
        }
    }
}

TEST(HandleLabels, OfAHandleBeatTheOutsideWherePointsCoincide) {
    const std::vector<Handle> handles{holding({2}, HandleRole::region_of_interest),
                                      holding({0}, HandleRole::fixed)};
    const Labelled found(handles, {1, 0, 0, 1, 0, 0, 5, 0, 0});
    ASSERT_EQ(found.order.vertices(), 2U);
    EXPECT_EQ(found.labels.vertex[found.order.file_index[0] == 2 ? 1 : 0], 1U);
}

} // namespace
} // namespace knead
