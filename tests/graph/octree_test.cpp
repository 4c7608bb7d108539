#include "graph/clouds.h"
#include "graph/octree.h"

#include <cmath>
#include <numeric>

namespace knead {
namespace {

using test::Cloud;

std::vector<Index> all_of(const Cloud& cloud) {
    std::vector<Index> all(cloud.size());
    std::iota(all.begin(), all.end(), Index{0});
    return all;
}

std::vector<Index> samples_of(const Cloud& cloud, std::size_t count) {
    return octree_samples(cloud.cube, cloud.positions, all_of(cloud), count);
}

TEST(OctreeSamples, AreAsManyAsAskedForAndAscend) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 3000));
    for (const std::size_t count : {1U, 2U, 3U, 50U, 200U, 1000U, 2999U}) {
        const std::vector<Index> samples = samples_of(cloud, count);
        EXPECT_EQ(samples.size(), count);
        EXPECT_TRUE(std::ranges::adjacent_find(samples, std::ranges::greater_equal()) == samples.end());
        EXPECT_LT(samples.back(), cloud.size());
    }
}

TEST(OctreeSamples, AreAllWhereThereAreNoMore) {
    const Cloud cloud = test::cloud_of(test::random_positions(50, 1));
    EXPECT_EQ(samples_of(cloud, 50), all_of(cloud));
    EXPECT_EQ(samples_of(cloud, 5000), all_of(cloud));
    EXPECT_TRUE(samples_of(cloud, 0).empty());
    EXPECT_TRUE(octree_samples(cloud.cube, cloud.positions, {}, 10).empty());
}

TEST(OctreeSamples, ComeFromTheVerticesGivenOnly) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::sphere, 2000));
    std::vector<Index> among;
    for (Index v = 0; v < cloud.size(); ++v)
        if (cloud.at(v).x() > 0.3) among.push_back(v);
    const std::vector<Index> samples = octree_samples(cloud.cube, cloud.positions, among, 40);
    EXPECT_EQ(samples.size(), 40U);
    EXPECT_TRUE(std::ranges::includes(among, samples));
}

TEST(OctreeSamples, AreMoreWhereThePointsAreDenser) {
    // Density 1 : 20 along x. Halved is what has most vertices times edge, so a fifth of the plane gets
    // samples by the two thirds' power of its points; cells are halved, so some more or less.
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::plane, 20000, 20));
    const std::vector<Index> samples = samples_of(cloud, 500);
    const auto fifth = [&](Index v) { return std::min(4, static_cast<int>((cloud.at(v).x() + 0.5) * 5)); };
    std::array<double, 5> points{};
    std::array<double, 5> sampled{};
    for (Index v = 0; v < cloud.size(); ++v) points.at(static_cast<std::size_t>(fifth(v))) += 1;
    for (const Index v : samples) sampled.at(static_cast<std::size_t>(fifth(v))) += 1;
    double sum = 0;
    for (const double count : points) sum += std::cbrt(count * count);
    for (std::size_t f = 0; f < 5; ++f) {
        const double expected = 500 * std::cbrt(points.at(f) * points.at(f)) / sum;
        EXPECT_GT(sampled.at(f), expected / 1.25) << "fifth " << f;
        EXPECT_LT(sampled.at(f), expected * 1.25) << "fifth " << f;
    }
    EXPECT_GT(std::max(points[0], points[4]), 5 * std::min(points[0], points[4])) << "the cloud is uneven";
}

TEST(OctreeSamples, LeaveNoPartOfAnEvenCloudWithout) {
    // 400 samples of a square lie 0.05 apart if they are even; cells are at most twice as long as wide.
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::plane, 10000));
    const std::vector<Index> samples = samples_of(cloud, 400);
    for (Index v = 0; v < cloud.size(); ++v) {
        double nearest = 1;
        for (const Index s : samples) nearest = std::min(nearest, (cloud.at(s) - cloud.at(v)).norm());
        ASSERT_LT(nearest, 0.1);
    }
}

TEST(OctreeSamples, AreFoundWhereThePointsShareACellOfTheCurve) {
    // All but one vertex within 2^-21 of the cloud's edge: their codes are equal, and tell nothing apart.
    std::vector<float> positions{1, 1, 1};
    for (int i = 0; i < 64; ++i) test::append(positions, Vec3d(1e-9 * i, 0, 0));
    const Cloud cloud = test::cloud_of(positions);
    const std::vector<Index> samples = samples_of(cloud, 20);
    EXPECT_EQ(samples.size(), 20U);
    EXPECT_TRUE(std::ranges::adjacent_find(samples, std::ranges::greater_equal()) == samples.end());
}

// How many of these vertices of a plane, whose edge is 1, have another one in the same row: less than a
// twentieth of their spacing farther along `axis`, where evenly scattered ones have it by chance.
double share_in_rows(const Cloud& cloud, const std::vector<Index>& samples, int axis) {
    const double spacing = 1 / std::sqrt(static_cast<double>(samples.size()));
    std::size_t in_rows = 0;
    for (const Index s : samples) {
        const auto is_beside = [&](Index t) {
            const Vec3d way = cloud.at(t) - cloud.at(s);
            return t != s && way.norm() < 2.5 * spacing && std::abs(way[axis]) < 0.05 * spacing;
        };
        in_rows += std::ranges::any_of(samples, is_beside) ? 1 : 0;
    }
    return static_cast<double>(in_rows) / static_cast<double>(samples.size());
}

TEST(OctreeSamples, AsideOfTheMiddlesLieInNoRows) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::plane, 40000));
    const std::vector<Index> all = all_of(cloud);
    for (const std::size_t count : {256U, 512U}) {
        const auto sampled = [&](OfCell which) {
            const auto samples = octree_samples(cloud.cube, cloud.positions, all, count, which);
            EXPECT_EQ(samples.size(), count);
            EXPECT_TRUE(std::ranges::adjacent_find(samples, std::ranges::greater_equal()) == samples.end());
            return samples;
        };
        for (const int axis : {0, 1}) {
            EXPECT_GT(share_in_rows(cloud, sampled(OfCell::middle), axis), 0.75);
            EXPECT_LT(share_in_rows(cloud, sampled(OfCell::aside), axis), 0.65);
        }
    }
}

TEST(OctreeSamples, AreTheSameEveryTime) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::knot, 3000));
    EXPECT_EQ(samples_of(cloud, 333), samples_of(cloud, 333));
}

} // namespace
} // namespace knead
