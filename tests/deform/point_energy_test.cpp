#include "deform/point_energy.h"

#include "deform/stretch.h"
#include "graph/clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace knead {
namespace {

// A bar with samples between two handles, and its rows of influences.
struct Held {
    test::Machine machine;
    test::Cloud cloud;
    std::vector<Index> label, vertices, asked;
    std::vector<double> each;
    std::vector<Vec3d> sample;
    std::vector<bool> turning;
    InfluenceRows nearest;
    std::vector<std::uint8_t> hanging;
    std::vector<float> of_links;
    Numbering point;

    explicit Held(std::size_t points = 3000)
        : cloud(test::cloud_of(test::shape_positions(Shape::bar, points))), each(cloud.size(), 1.0),
          point(Numbering::as_they_stand(cloud.size())) {
        asked.resize(cloud.size());
        std::iota(asked.begin(), asked.end(), Index{0});
        for (Index v = 0; v < cloud.size(); ++v) {
            const double z = cloud.at(v).z();
            label.push_back(z < -2 ? 0 : z > 2 ? 1 : no_index);
        }
        for (const Index v : test::octree_of(cloud, 60))
            if (label[v] == no_index) vertices.push_back(v);
        for (const Index v : vertices) sample.push_back(cloud.at(v));
        nearest = flood(cloud.graph, cloud.lengths, vertices, machine.workers, machine.progress);
        nearest.first_handle = static_cast<Index>(sample.size());
    }

    PointsBetween between(InfluenceWeights weights) const {
        return {cloud.graph, cloud.positions, point, asked,   each, nearest, weights,
                of_links,    hanging,         label, turning, {},   sample,  2};
    }

    PointEnergy energy(InfluenceWeights weights, unsigned threads) const {
        Workers workers(threads);
        return point_energy(between(weights), workers);
    }
};

// What bodies do that all follow p → p + map p + shift.
struct Bodies {
    std::vector<Vec3d> way;
    std::vector<Mat3d> map;

    Bodies(const Held& held, const Mat3d& all, const Vec3d& shift) : map(held.sample.size() + 2, all) {
        for (const Vec3d& p : held.sample) way.emplace_back(all * p + shift);
        way.resize(map.size(), shift);             // handles: about the origin
        map.resize(map.size() + 2, Mat3d::Zero()); // which do not grow
        way.resize(map.size(), Vec3d::Zero());
    }
};

// -∂E/∂u of sample t, over ω, and what pulls where nothing resists, for scale.
Vec3d force(const PointEnergy& energy, const Bodies& bodies, Index t, double& effort) {
    Vec3d sum = Vec3d::Zero();
    for (Index at = energy.first[t]; at < energy.first[t + 1]; ++at) {
        const BodyPair& pair = energy.pair[at];
        const Index s = energy.body[at];
        sum += pair.way * bodies.way[s] + bodies.map[s] * (pair.map_force - pair.target_force);
        effort += std::abs(pair.way) * bodies.way[s].norm();
    }
    return sum;
}

TEST(PointEnergy, KnowsNoForceWhereAllIsMovedByOneLinearMap) {
    const Held held;
    std::mt19937 random(1);
    for (const InfluenceWeights weights : {InfluenceWeights::smooth, InfluenceWeights::paper}) {
        const PointEnergy energy = held.energy(weights, 2);
        Mat3d map;
        for (int k = 0; k < 3; ++k) map.col(k) = test::random_vector(random);
        const Bodies bodies(held, map, test::random_vector(random));
        for (Index t = 0; t < energy.samples; ++t) {
            double effort = 0;
            const double left = force(energy, bodies, t, effort).norm();
            EXPECT_LT(left, 1e-12 * effort);
        }
    }
}

TEST(PointEnergy, KnowsNoResidualOfTurnsWhereAllIsMovedByOneLinearMap) {
    const Held held;
    const PointEnergy energy = held.energy(InfluenceWeights::smooth, 2);
    const Mat3d map = 0.3 * Mat3d::Ones();
    const Bodies bodies(held, map, {1, 2, 3});
    for (Index t = 0; t < energy.samples; ++t) {
        Mat3d sum = Mat3d::Zero(), target = Mat3d::Zero();
        for (Index at = energy.first[t]; at < energy.first[t + 1]; ++at) {
            const PairSlopes& slopes = energy.slopes[at];
            const Index s = energy.body[at];
            sum += bodies.way[s] * slopes.way_slope.transpose() + bodies.map[s] * slopes.map_slope;
            target += bodies.map[s] * slopes.target_spread;
        }
        EXPECT_LT((sum - target).norm(), 1e-11 * target.norm());
        EXPECT_LT((target - map * energy.spread[t]).norm(), 1e-12 * target.norm()); // weights sum to 1
    }
}

// E/2 of ways alone, at every point by least squares over its neighbours, beside the sum over pairs.
TEST(PointEnergy, IsTheSumOverThePoints) {
    const Held held;
    const PointEnergy energy = held.energy(InfluenceWeights::paper, 2);
    std::mt19937 random(2);
    std::vector<Vec3d> way(energy.bodies, Vec3d::Zero()); // handles rest
    for (Index s = 0; s < energy.samples; ++s) way[s] = test::random_vector(random);
    const auto blended = [&](Index v) -> Vec3d {
        Vec3d sum = Vec3d::Zero();
        if (held.label[v] != no_index) return sum;
        const Influence influence = influence_of(held.nearest, InfluenceWeights::paper, v);
        double weights = 0;
        for (std::size_t k = 0; k < influence.count; ++k) {
            const auto weight = static_cast<double>(influence.weight[k]);
            sum += weight * way[influence.motion[k]];
            weights += weight;
        }
        return sum / weights;
    };
    double of_points = 0;
    for (Index v = 0; v < held.cloud.size(); ++v) {
        Mat3d spread = Mat3d::Zero(), moved = Mat3d::Zero();
        Vec3d pull = Vec3d::Zero();
        double effort = 0;
        for (const Index other : held.cloud.graph.row(v)) {
            const Vec3d edge = held.cloud.at(other) - held.cloud.at(v);
            spread += edge * edge.transpose();
            moved += (blended(other) - blended(v)) * edge.transpose();
            pull += edge;
            effort += edge.norm();
        }
        const Surroundings surroundings = surroundings_of(spread);
        const double square = spread.trace() / static_cast<double>(held.cloud.graph.row(v).size());
        const double share = 1 - std::numbers::pi / 4 * pull.norm() / effort;
        const double dimension = std::max(1.0, 3 - surroundings.open.trace());
        of_points += 3 / dimension * square * share * (moved * surroundings.inverse).squaredNorm();
    }
    double of_pairs = 0;
    for (Index t = 0; t < energy.samples; ++t)
        for (Index at = energy.first[t]; at < energy.first[t + 1]; ++at)
            of_pairs += energy.pair[at].way * way[t].dot(way[energy.body[at]]);
    EXPECT_NEAR(of_pairs, of_points, 1e-9 * of_points);
}

TEST(PointEnergy, CountsAreasAsTheBaseSamplesSay) {
    Held held;
    const PointEnergy plain = held.energy(InfluenceWeights::smooth, 2);
    held.of_links.assign(held.sample.size(), 2.0F);
    const PointEnergy twice = held.energy(InfluenceWeights::smooth, 2);
    ASSERT_EQ(twice.body, plain.body);
    for (std::size_t s = 0; s < held.sample.size(); ++s)
        EXPECT_NEAR(twice.confidence[s], 2 * plain.confidence[s], 1e-6 * plain.confidence[s]);
    // One alone counts for the points that are nearest to it.
    std::ranges::fill(held.of_links, 1.0F);
    held.of_links[7] = 3;
    const PointEnergy one = held.energy(InfluenceWeights::smooth, 2);
    const auto more = [&](std::size_t s) { return one.confidence[s] / plain.confidence[s]; };
    EXPECT_GT(more(7), 1.3);
    EXPECT_LT(more(7), 3);
    for (std::size_t s = 0; s < held.sample.size(); ++s)
        if ((held.sample[s] - held.sample[7]).norm() > 1.5) {
            EXPECT_EQ(more(s), 1);
        }
}

// Of many points some are asked, and evenly: no part of the bar tells more than where all its points are.
TEST(PointEnergy, AsksSomeOfManyPointsEverywhere) {
    const Held few(6000), many(60'000);
    const auto shares = [](const Held& held) { // of the confidence, along the bar
        const PointEnergy energy = held.energy(InfluenceWeights::smooth, 2);
        std::array<double, 4> share{};
        double sum = 0;
        for (Index t = 0; t < energy.samples; ++t) {
            const double z = std::clamp(held.sample[t].z(), -2.0, 1.999);
            share.at(static_cast<std::size_t>(z + 2)) += energy.confidence[t];
            sum += energy.confidence[t];
        }
        for (double& each : share) each /= sum;
        return share;
    };
    const std::array<double, 4> of_all = shares(few), of_some = shares(many);
    for (std::size_t part = 0; part < of_all.size(); ++part)
        EXPECT_NEAR(of_some.at(part), of_all.at(part), 0.05) << part;
}

// Though smooth weights blend it when it is moved: so the energy knows of turns that blends hide.
TEST(PointEnergy, LetsASamplesOwnPointGoWithTheSampleAlone) {
    Held held, beside;
    for (NarrowRow& row : std::get<0>(beside.nearest.rows))
        if (row.distance[0] == 0) row.distance[0] = 1; // no point is at a sample then
    const PointEnergy energy = held.energy(InfluenceWeights::smooth, 2);
    const PointEnergy blended = beside.energy(InfluenceWeights::smooth, 2);
    std::mt19937 random(3);
    std::vector<Vec3d> turn(energy.bodies, Vec3d::Zero());
    for (Index s = 0; s < energy.samples; ++s) turn[s] = test::random_vector(random);
    const auto seen = [&](const PointEnergy& of) { // Σ 2ω dim |Σ_s w_s turn_s|²
        double sum = 0;
        for (Index t = 0; t < of.samples; ++t)
            for (Index at = of.first[t]; at < of.first[t + 1]; ++at)
                sum += of.slopes[at].target_spread.trace() * turn[t].dot(turn[of.body[at]]);
        return sum;
    };
    EXPECT_GT(seen(energy), 1.02 * seen(blended));
}

Graph without_links_of(const Graph& graph, Index vertex) {
    Graph result;
    result.first.assign(1, 0);
    for (Index v = 0; v < graph.size(); ++v) {
        for (const Index other : graph.row(v))
            if (v != vertex && other != vertex) result.neighbor.push_back(other);
        result.first.push_back(static_cast<Index>(result.neighbor.size()));
    }
    return result;
}

// Of one half of the bar every second vertex, for two each, and of the other all: that is about what all
// tell.
TEST(PointEnergy, IsThatOfAllWhereSomeStandForMore) {
    Held held;
    const PointEnergy all = held.energy(InfluenceWeights::smooth, 2);
    held.asked.clear();
    held.each.clear();
    for (Index v = 0; v < held.cloud.size(); ++v) {
        const bool is_sparse = held.cloud.at(v).x() < 0;
        if (is_sparse && v % 2 == 1) continue;
        held.asked.push_back(v);
        held.each.push_back(is_sparse ? 2 : 1);
    }
    ASSERT_LT(held.asked.size(), 0.8 * static_cast<double>(held.cloud.size()));
    const PointEnergy some = held.energy(InfluenceWeights::smooth, 2);
    const auto own = [](const PointEnergy& energy, Index t) {
        for (Index at = energy.first[t]; at < energy.first[t + 1]; ++at)
            if (energy.body[at] == t) return energy.pair[at].way;
        return 0.0;
    };
    double confidence = 0, of_all = 0, way = 0, way_of_all = 0;
    for (Index t = 0; t < all.samples; ++t) {
        confidence += some.confidence[t];
        of_all += all.confidence[t];
        way += own(some, t);
        way_of_all += own(all, t);
    }
    EXPECT_NEAR(confidence, of_all, 0.05 * of_all);
    EXPECT_NEAR(way, way_of_all, 0.05 * way_of_all);
}

TEST(PointEnergy, KnowsNothingOfOutliersThatHang) {
    Held held, alone;
    Index outlier = 0;
    while (held.label[outlier] != no_index) ++outlier;
    held.hanging.assign(held.cloud.size(), 0);
    held.hanging[outlier] = 1;
    alone.cloud.graph = without_links_of(alone.cloud.graph, outlier);
    const PointEnergy energy = held.energy(InfluenceWeights::smooth, 2);
    const PointEnergy expected = alone.energy(InfluenceWeights::smooth, 2);
    ASSERT_EQ(energy.body, expected.body);
    for (std::size_t at = 0; at < energy.pair.size(); ++at)
        EXPECT_NEAR(energy.pair[at].way, expected.pair[at].way, 1e-12);
    EXPECT_NE(energy.confidence, Held().energy(InfluenceWeights::smooth, 2).confidence);
}

TEST(PointEnergy, HasLessOfAShareTheMoreSamplesThereAre) {
    EXPECT_EQ(share_of_points(0, 0), 0);
    for (const std::size_t vertices : {2000U, 10'000U, 100'000U}) {
        EXPECT_EQ(share_of_points(300, vertices), 1);
        EXPECT_EQ(share_of_points(4000, vertices), 0);
        double before = 1;
        for (std::size_t samples = 300; samples <= 4000; ++samples) {
            const double share = share_of_points(samples, vertices);
            EXPECT_LE(share, before);
            EXPECT_LT(before - share, 0.01); // no step
            EXPECT_LE(share, share_of_points(samples, 2 * vertices));
            before = share;
        }
    }
    EXPECT_EQ(share_of_points(500, 2500), 0); // five points a sample
    EXPECT_EQ(share_of_points(300, 300), 0);  // nothing lies between them
    EXPECT_EQ(share_of_points(40, 40), 0);
    EXPECT_EQ(share_of_points(40, 200), 1);
}

TEST(PointEnergy, IsTheSameForAnyNumberOfWorkers) {
    const Held held;
    const PointEnergy one = held.energy(InfluenceWeights::smooth, 1);
    const PointEnergy two = held.energy(InfluenceWeights::smooth, 2);
    ASSERT_EQ(one.first, two.first);
    ASSERT_EQ(one.body, two.body);
    for (std::size_t at = 0; at < one.pair.size(); ++at) {
        EXPECT_EQ(one.pair[at].way, two.pair[at].way);
        EXPECT_EQ(one.pair[at].turn, two.pair[at].turn);
        EXPECT_EQ(one.slopes[at].map_slope, two.slopes[at].map_slope);
    }
}

TEST(PointEnergy, OfNoSamplesIsNone) {
    Held held;
    held.sample.clear();
    EXPECT_TRUE(held.energy(InfluenceWeights::smooth, 2).pair.empty());
}

} // namespace
} // namespace knead
