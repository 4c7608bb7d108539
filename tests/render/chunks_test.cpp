// Which chunks of points a change reaches.

#include "render/chunks.h"

#include <gtest/gtest.h>

#include <set>

namespace knead::test {
namespace {

TEST(Chunks, WithChangedPointsAreThoseTheyLieInEachOnce) {
    const std::vector<std::vector<PointRange>> cases = {{},
                                                        {{0, 1}},
                                                        {{1023, 1024}, {1024, 1025}},
                                                        {{0, 3000}, {3000, 3100}, {3101, 3102}, {9000, 9001}},
                                                        {{100, 100}, {5000, 5000}},
                                                        {{512, 20'000}}};
    std::vector<Index> numbers = {7, 8, 9}; // written over
    for (const std::vector<PointRange>& ranges : cases) {
        std::set<Index> expected;
        for (const PointRange& range : ranges)
            for (std::size_t i = range.first; i < range.end; ++i)
                expected.insert(static_cast<Index>(i / points_in_chunk));
        chunks_with(ranges, numbers);
        EXPECT_EQ(numbers, std::vector<Index>(expected.begin(), expected.end()));
    }
}

TEST(Chunks, AreJoinedFromBoxesOfFewerPoints) {
    std::vector<std::array<float, 6>> boxes(9,
                                            {1e30F, 1e30F, 1e30F, -1e30F, -1e30F, -1e30F}); // of 256 points
    boxes[0] = {0, 1, 2, 3, 4, 5};
    boxes[3] = {-1, 2, 2, 0, 9, 3};
    boxes[8] = {7, 7, 7, 8, 8, 8};
    std::vector<Chunk> chunks(3, Chunk{glm::vec3(0), glm::vec3(1)});
    join_boxes(boxes, 256, chunks);
    EXPECT_EQ(chunks[0].lowest, glm::vec3(-1, 1, 2));
    EXPECT_EQ(chunks[0].highest, glm::vec3(3, 9, 5));
    EXPECT_TRUE(chunks[1].empty());
    EXPECT_EQ(chunks[2].lowest, glm::vec3(7));
    EXPECT_EQ(chunks[2].highest, glm::vec3(8));
}

} // namespace
} // namespace knead::test
