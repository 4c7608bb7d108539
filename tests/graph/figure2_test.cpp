// The paper's Figure 2: parts that come close in space but not along the surface must not move each other.

#include "graph/clouds.h"
#include "graph/octree.h"
#include "graph/relaxing.h"
#include "graph/sampling.h"

#include <cmath>
#include <numeric>

namespace knead {
namespace {

using test::Cloud;
using test::Machine;

// Where on the knot's tube a vertex lies: the length along the spine to the place nearest to it.
class AlongTube {
public:
    AlongTube() : place_(steps), length_(steps + 1, 0) {
        for (std::size_t i = 0; i < steps; ++i) place_[i] = knot_spine(t(i));
        for (std::size_t i = 0; i < steps; ++i)
            length_[i + 1] = length_[i] + (place_[(i + 1) % steps] - place_[i]).norm();
    }

    // The surface is 0.45 from its own strand's spine and at least 0.75 from another's: no mistake is made.
    double of(const Vec3d& p) const {
        const auto nearest =
            std::ranges::min_element(place_, {}, [&](const Vec3d& q) { return (q - p).squaredNorm(); });
        return length_[static_cast<std::size_t>(nearest - place_.begin())];
    }

    // The way along the tube, the shorter way round.
    double between(double a, double b) const {
        const double way = std::abs(a - b);
        return std::min(way, length_.back() - way);
    }

private:
    static constexpr std::size_t steps = 1000;
    static double t(std::size_t i) { return 2 * std::numbers::pi * static_cast<double>(i) / steps; }
    std::vector<Vec3d> place_;
    std::vector<double> length_;
};

std::vector<Index> nearest_in_space(const Cloud& cloud, const std::vector<Index>& samples, Index v) {
    std::vector<std::pair<double, Index>> distances;
    for (Index s = 0; s < samples.size(); ++s)
        distances.emplace_back((cloud.at(samples[s]) - cloud.at(v)).norm(), s);
    std::ranges::partial_sort(distances, distances.begin() + influences_per_row);
    std::vector<Index> nearest;
    for (std::size_t place = 0; place < influences_per_row; ++place)
        nearest.push_back(distances[place].second);
    return nearest;
}

TEST(Figure2, StrandsThatPassCloseNeverInfluenceEachOther) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::knot, 20000));
    ASSERT_EQ(cloud.components.size.size(), 1U);
    const AlongTube tube;
    std::vector<double> along(cloud.size());
    // set_positions_from_columns() moved the middle of the box to the origin.
    Vec3d lowest = Vec3d::Constant(1e9);
    Vec3d highest = -lowest;
    for (int i = 0; i < 100000; ++i) {
        const Vec3d p = knot_spine(2 * std::numbers::pi * i / 100000);
        lowest = lowest.cwiseMin(p);
        highest = highest.cwiseMax(p);
    }
    const Vec3d middle = 0.5 * (lowest + highest); // of the spine's box, and within 0.01 of the tube's
    for (Index v = 0; v < cloud.size(); ++v) along[v] = tube.of(cloud.at(v) + middle);

    std::vector<Index> all(cloud.size());
    std::iota(all.begin(), all.end(), Index{0});
    for (const std::size_t count : {200U, 1000U}) {
        Machine machine;
        const auto samples =
            relaxed(test::shuffled_in_runs(octree_samples(cloud.cube, cloud.positions, all, count)),
                    cloud.graph, cloud.lengths, cloud.positions, {}, 3, machine.workers, machine.progress);
        const auto nearest = flood(cloud.graph, cloud.lengths, samples, machine.workers, machine.progress);
        // The eight nearest of evenly spaced samples reach 1.6 spacings far (their circle has eight
        // spacings² of area); four leave room for uneven ones. Strands that meet are 9 apart along the tube.
        const double area = 2 * std::numbers::pi * knot_tube_radius * 27.65;
        const double few_spacings = 4 * std::sqrt(area / static_cast<double>(count));
        ASSERT_LT(few_spacings, 4);
        std::size_t wrong_in_space = 0;
        for (Index v = 0; v < cloud.size(); ++v) {
            ASSERT_EQ(nearest[v].count(), influences_per_row);
            for (const Index s : nearest[v].sample)
                ASSERT_LT(tube.between(along[v], along[samples[s]]), few_spacings)
                    << "a sample of another strand moves vertex " << v;
            if (v % 10 != 0) continue; // enough to see that the test can fail
            for (const Index s : nearest_in_space(cloud, samples, v))
                if (tube.between(along[v], along[samples[s]]) > few_spacings) ++wrong_in_space;
        }
        EXPECT_GT(wrong_in_space, 20U) << "the strands come too far apart for this test to say anything";

        const SampleGraph graph = sample_graph(nearest, samples, cloud.graph, machine.workers);
        for (Index s = 0; s < samples.size(); ++s)
            for (const Index other : graph.graph.row(s))
                ASSERT_LT(tube.between(along[samples[s]], along[samples[other]]), few_spacings);
    }
}

} // namespace
} // namespace knead
