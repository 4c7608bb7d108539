#include "graph/solid_links.h"

#include "graph/clouds.h"
#include "graph/edge_weights.h"
#include "graph/symmetric_graph.h"

namespace knead {
namespace {

using test::Cloud;
using test::Machine;

Graph solid_links_of(const Cloud& cloud, unsigned threads = 2) {
    Machine machine(threads);
    return with_solid_links(cloud.graph, cloud.positions, machine.workers);
}

Cloud lattice(int edge) {
    std::vector<float> positions;
    for (int x = 0; x < edge; ++x)
        for (int y = 0; y < edge; ++y)
            for (int z = 0; z < edge; ++z) test::append(positions, Vec3d(x, y, z));
    return test::cloud_of(positions);
}

Cloud noisy(Shape shape, double noise) {
    Machine machine;
    ShapeOptions options;
    options.points = 10'000;
    options.noise = noise;
    return test::cloud_of(make_shape(shape, options, machine.workers, machine.progress).positions);
}

TEST(SolidLinks, OfSurfacesStayWhatTheyWere) {
    for (const Shape shape : {Shape::bar, Shape::cylinder, Shape::plane, Shape::knot, Shape::creature}) {
        SCOPED_TRACE(static_cast<int>(shape));
        const Cloud cloud = test::cloud_of(test::shape_positions(shape, 6000));
        EXPECT_TRUE(test::same_graph(solid_links_of(cloud), cloud.graph));
    }
    const Cloud tube = noisy(Shape::cylinder, 0.5);
    EXPECT_TRUE(test::same_graph(solid_links_of(tube), tube.graph));
}

TEST(SolidLinks, OfALatticeAreAllThatAreEquallyNear) {
    const Cloud cloud = lattice(12);
    const Graph graph = solid_links_of(cloud);
    for (Index v = 0; v < cloud.size(); ++v) {
        const Vec3d from_middle = cloud.at(v) - Vec3d::Constant(5.5);
        if (from_middle.cwiseAbs().maxCoeff() > 2) continue;
        EXPECT_EQ(graph.row(v).size(), 18U); // 6 at 1, 12 at √2
        for (const Index u : graph.row(v)) EXPECT_LT((cloud.at(u) - cloud.at(v)).norm(), 1.42);
    }
}

TEST(SolidLinks, OfASolidAreMoreAndOneBody) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::solid_bar, 8000));
    const Graph graph = solid_links_of(cloud);
    EXPECT_GT(graph.neighbor.size(), 12 * graph.size());
    EXPECT_LT(graph.neighbor.size(), 18 * graph.size());
    EXPECT_EQ(test::components_of(graph).component, cloud.components.component);
    test::expect_well_formed(graph);
    for (Index v = 0; v < graph.size(); ++v)
        EXPECT_TRUE(std::ranges::includes(graph.row(v), cloud.graph.row(v)));
    for (const unsigned threads : {1U, 5U})
        EXPECT_TRUE(test::same_graph(solid_links_of(cloud, threads), graph));
}

// What they are for: how much of its pulls a vertex inside is left with, the mean of |Σ w e| / Σ w |e|.
double imbalance(const Cloud& cloud, const Graph& graph) {
    Machine machine;
    std::vector<Vec3d> position;
    for (std::size_t v = 0; v < cloud.size(); ++v) position.push_back(cloud.at(v));
    const std::vector<float> contact(graph.neighbor.size(), 1.0F);
    const std::vector<double> weight =
        isotropic_weights(graph, position, contact, of_points, {}, machine.workers);
    double sum = 0, count = 0;
    for (Index v = 0; v < graph.size(); ++v) {
        if (cloud.at(v).head<2>().cwiseAbs().maxCoeff() > 0.35) continue;
        Vec3d pull = Vec3d::Zero();
        double effort = 0;
        for (Index link = graph.first[v]; link < graph.first[v + 1]; ++link) {
            const Vec3d edge = cloud.at(graph.neighbor[link]) - cloud.at(v);
            pull += weight[link] * edge;
            effort += weight[link] * edge.norm();
        }
        sum += pull.norm() / effort;
        count += 1;
    }
    return sum / count;
}

TEST(SolidLinks, LetPullsCancelInside) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::solid_bar, 8000));
    const double before = imbalance(cloud, cloud.graph), after = imbalance(cloud, solid_links_of(cloud));
    EXPECT_LT(after, 0.6 * before);
}

TEST(SolidLinks, LeaveAloneWhatHangsOnOneLink) {
    Cloud cloud = test::cloud_of(test::random_positions(3000, 5));
    const auto middle = static_cast<Index>(cloud.size());
    Index nearest = 0;
    for (Index v = 0; v < cloud.size(); ++v)
        if (cloud.at(v).norm() < cloud.at(nearest).norm()) nearest = v;
    test::append(cloud.positions, 1.01 * cloud.at(nearest));
    cloud.graph.first.push_back(cloud.graph.first.back());
    const std::pair<Index, Index> hanging(nearest, middle);
    Machine machine;
    cloud.graph = with_edges(cloud.graph, {&hanging, 1}, machine.workers);
    const Graph graph = solid_links_of(cloud);
    EXPECT_GT(graph.row(nearest).size(), cloud.graph.row(nearest).size());
    EXPECT_EQ(graph.row(middle).size(), 1U);
}

TEST(SolidLinks, OfNothingAndLittle) {
    Machine machine;
    EXPECT_EQ(with_solid_links({}, {}, machine.workers).size(), 0U);
    for (const std::size_t points : {1U, 2U, 5U}) {
        const Cloud cloud = test::cloud_of(test::random_positions(points, 3));
        EXPECT_TRUE(test::same_graph(solid_links_of(cloud), cloud.graph));
    }
}

} // namespace
} // namespace knead
