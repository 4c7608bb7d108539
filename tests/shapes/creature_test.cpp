#include "graph/neighbors.h"
#include "shapes/creature.h"
#include "shapes/made.h"
#include "shapes/random.h"

#include <cmath>

namespace knead::test {

namespace {

ShapeOptions clean(std::size_t points) {
    ShapeOptions options;
    options.points = points;
    options.noise = 0;
    options.outliers = 0;
    return options;
}

std::size_t largest_component(const PointCloud& cloud) {
    Workers workers(2);
    SilentProgress progress;
    const Graph graph = neighbor_graph(cloud.positions, 6, workers, progress);
    const Components components = find_components(graph, workers);
    return *std::max_element(components.size.begin(), components.size.end());
}

// Whether an edge of the graph of six neighbours joins a point of one part to a point of the other.
template<typename One, typename Other>
bool joined(const PointCloud& cloud, One&& one, Other&& other) {
    Workers workers(2);
    SilentProgress progress;
    const Graph graph = neighbor_graph(cloud.positions, 6, workers, progress);
    for (std::size_t v = 0; v < graph.size(); ++v)
        for (const Index u : graph.row(v))
            if (one(cloud.file_position(v)) && other(cloud.file_position(u))) return true;
    return false;
}

} // namespace

TEST(Creature, ItsPointsLieOnItsSurface) {
    const Creature creature = make_creature();
    const PointCloud cloud = made(Shape::creature, clean(20000));
    for (std::size_t i = 0; i < cloud.size(); ++i)
        ASSERT_LT(std::abs(creature_distance(creature, cloud.file_position(i))), 1e-5) << i;
}

TEST(Creature, AsScannedUsuallyFewPointsAreFarFromIt) {
    const Creature creature = make_creature();
    const PointCloud cloud = made(Shape::creature, 30000);
    std::size_t near = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i)
        if (std::abs(creature_distance(creature, cloud.file_position(i))) < 0.02 * 1.8) ++near;
    EXPECT_GT(near, 29850U); // 60 strays, half of them near silhouettes
    EXPECT_LT(near, 30000U);
}

TEST(Creature, FitsItsBox) {
    const Bounds bounds = bounds_of(made(Shape::creature, clean(50000)));
    const ScannedBody body = creature_body();
    EXPECT_GT((bounds.lowest - body.lowest).minCoeff(), -1e-6);
    EXPECT_LT((bounds.highest - body.highest).maxCoeff(), 1e-6);
    EXPECT_LT((bounds.lowest - body.lowest).maxCoeff(), 0.03);
    EXPECT_GT((bounds.highest - body.highest).minCoeff(), -0.03);
}

TEST(Creature, ItsNormalsAreUnitAndFaceOutward) {
    const Creature creature = make_creature();
    for (const bool noisy : {false, true}) {
        const PointCloud cloud = noisy ? made(Shape::creature, 10000) : made(Shape::creature, clean(10000));
        const std::vector<float> normals = read_normals(cloud);
        std::size_t outward = 0;
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            const Vec3d normal = normal_of(normals, i);
            ASSERT_NEAR(normal.norm(), 1, 1e-6);
            const Vec3d p = cloud.file_position(i);
            if (creature_distance(creature, p + 0.01 * normal) > creature_distance(creature, p)) ++outward;
        }
        EXPECT_GT(outward, noisy ? 9950U : 9990U); // a hair's breadth from a crease the step may cross it
    }
}

TEST(Creature, IsOrangeAndCreamAndStriped) {
    const PointCloud cloud = made(Shape::creature, clean(20000));
    const std::size_t red = find_attribute(cloud, "red").value();
    const std::size_t blue = find_attribute(cloud, "blue").value();
    std::size_t bright = 0;
    std::size_t dull = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        if (value_at(cloud.attributes[blue], i) > 190) ++bright;
        if (value_at(cloud.attributes[red], i) < 190) ++dull;
    }
    EXPECT_GT(bright, 1500U);
    EXPECT_GT(dull, 1500U);
    EXPECT_LT(bright + dull, 15000U);
}

TEST(Creature, HangsTogether) {
    for (const std::size_t points : {std::size_t{5000}, std::size_t{20000}, std::size_t{100000}})
        EXPECT_GT(largest_component(made(Shape::creature, points)), points * 97 / 100) << points;
}

TEST(Creature, ItsLimbsTouchOnlyWhereTheyGrow) {
    const PointCloud cloud = made(Shape::creature, clean(20000));
    const auto arm = [](const Vec3d& p) { return std::abs(p.y()) > 0.45; };
    const auto body = [](const Vec3d& p) { return std::abs(p.y()) < 0.3; };
    const auto tail = [](const Vec3d& p) { return p.x() < -0.4; };
    const auto in_front = [](const Vec3d& p) { return p.x() > -0.3; };
    const auto left_leg = [](const Vec3d& p) { return p.z() < 0.33 && p.y() > 0; };
    const auto right_leg = [](const Vec3d& p) { return p.z() < 0.33 && p.y() < 0; };
    const auto head = [](const Vec3d& p) { return p.z() > 1.16; };
    EXPECT_FALSE(joined(cloud, arm, body));
    EXPECT_FALSE(joined(cloud, arm, head));
    EXPECT_FALSE(joined(cloud, tail, in_front));
    EXPECT_FALSE(joined(cloud, left_leg, right_leg));
    EXPECT_TRUE(joined(cloud, head, body));
}

TEST(Creature, HasHolesUnderItsFeet) {
    const PointCloud cloud = made(Shape::creature, clean(50000));
    const std::vector<float> normals = read_normals(cloud);
    std::size_t soles = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i)
        if (cloud.file_position(i).z() < 0.01 && normal_of(normals, i).z() < -0.9) ++soles;
    EXPECT_EQ(soles, 0U);
}

TEST(Creature, GrowsDenserUpwardsWithAGradient) {
    const auto share_of_the_head = [](double gradient) {
        ShapeOptions options = clean(20000);
        options.gradient = gradient;
        const PointCloud cloud = made(Shape::creature, options);
        std::size_t head = 0;
        std::size_t feet = 0;
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            const double z = cloud.file_position(i).z();
            if (z > 1.45 && z < 1.55) ++head;
            if (z > 0.05 && z < 0.15) ++feet;
        }
        return static_cast<double>(head) / static_cast<double>(feet);
    };
    // The middles of the two slices are 1.4 of 1.8 apart.
    EXPECT_NEAR(share_of_the_head(10) / share_of_the_head(1) / std::pow(10, 1.4 / 1.8), 1, 0.15);
}

// The share of a box that lies within a small distance of the surface is twice the distance times the area.
TEST(Creature, ItsAreaIsTheOneThatSpacingsAreToldBy) {
    constexpr std::size_t draws = 400000;
    constexpr double width = 0.01;
    const Creature creature = make_creature();
    const ScannedBody body = creature_body();
    const Vec3d lowest = body.lowest - Vec3d::Constant(width);
    const Vec3d size = body.highest - body.lowest + Vec3d::Constant(2 * width);
    std::size_t near = 0;
    for (std::size_t i = 0; i < draws; ++i) {
        Random random(1, 100, i);
        const Vec3d p =
            lowest + size.cwiseProduct(Vec3d(random.uniform(), random.uniform(), random.uniform()));
        if (std::abs(creature_distance(creature, p)) < width) ++near;
    }
    const double area = static_cast<double>(near) / draws * size.prod() / (2 * width);
    EXPECT_NEAR(area, creature_area, 0.05 * creature_area);
}

TEST(Creature, LeavingOutFarPiecesDoesNotChangeTheField) {
    const Creature creature = make_creature();
    Creature unhurried = creature;
    for (Ball& ball : unhurried.around) ball.radius = 100;
    for (PieceGroup& group : unhurried.groups) group.around.radius = 100;
    for (std::size_t i = 0; i < 20000; ++i) {
        Random random(1, 101, i);
        const Vec3d p(random.between(-1, 1), random.between(-1.2, 1.2), random.between(-0.2, 2));
        ASSERT_DOUBLE_EQ(creature_distance(creature, p), creature_distance(unhurried, p));
    }
}

TEST(Creature, StraysUpToMostOfThePoints) {
    for (const double outliers : {0.5, 0.99}) {
        ShapeOptions options;
        options.points = 3000;
        options.noise = 0;
        options.outliers = outliers;
        const PointCloud cloud = made(Shape::creature, options);
        const Creature creature = make_creature();
        std::size_t on_it = 0;
        for (std::size_t i = 0; i < cloud.size(); ++i)
            if (std::abs(creature_distance(creature, cloud.file_position(i))) < 1e-5) ++on_it;
        EXPECT_NEAR(static_cast<double>(on_it), 3000 * (1 - outliers), 3) << outliers;
    }
}

TEST(Knot, IsOnePieceWhoseStrandsAreNotJoined) {
    const PointCloud cloud = made(Shape::knot, 20000);
    EXPECT_EQ(largest_component(cloud), 20000U);
    // An edge between two strands would be as long as the gap.
    Workers workers(2);
    SilentProgress progress;
    const Graph graph = neighbor_graph(cloud.positions, 6, workers, progress);
    for (std::size_t v = 0; v < graph.size(); ++v)
        for (const Index u : graph.row(v))
            ASSERT_LT((cloud.file_position(v) - cloud.file_position(u)).norm(), 0.8 * knot_gap);
}

} // namespace knead::test
