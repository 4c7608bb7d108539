#include "graph/clouds.h"
#include "graph/edge_weights.h"
#include "graph/symmetric_graph.h"
#include "graph/vertex_areas.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <numeric>

namespace knead {
namespace {

using test::Cloud;
using test::Machine;

std::vector<Vec3d> places(const Cloud& cloud) {
    std::vector<Vec3d> position;
    for (std::size_t v = 0; v < cloud.size(); ++v) position.push_back(cloud.at(v));
    return position;
}

std::vector<double> weights_for(const Graph& graph, const std::vector<Vec3d>& position,
                                unsigned threads = 2) {
    Machine machine(threads);
    const std::vector<float> contact(graph.neighbor.size(), 1.0F);
    return isotropic_weights(graph, position, contact, of_points, {}, machine.workers);
}

void expect_symmetric_and_positive(const Graph& graph, const std::vector<double>& weight) {
    ASSERT_EQ(weight.size(), graph.neighbor.size());
    for (Index v = 0; v < graph.size(); ++v) {
        for (Index link = graph.first[v]; link < graph.first[v + 1]; ++link) {
            ASSERT_TRUE(std::isfinite(weight[link]));
            ASSERT_GT(weight[link], 0);
            ASSERT_EQ(weight[link], weight[*find_link(graph, graph.neighbor[link], v)]);
        }
    }
}

TEST(IsotropicWeights, AreSymmetricAndPositive) {
    for (const auto& [name, cloud] : test::several_clouds()) {
        SCOPED_TRACE(name);
        expect_symmetric_and_positive(cloud.graph, weights_for(cloud.graph, places(cloud)));
    }
}

// A lattice in the plane, `aspect` times as wide in y as in x, linked to its eight neighbours.
struct Lattice {
    static constexpr int edge = 15;
    Graph graph;
    std::vector<Vec3d> position;

    explicit Lattice(double aspect) {
        graph.first.assign(edge * edge + 1, 0);
        std::vector<std::pair<Index, Index>> edges;
        for (int x = 0; x < edge; ++x) {
            for (int y = 0; y < edge; ++y) {
                position.emplace_back(x, aspect * y, 0);
                for (const auto& [dx, dy] : {std::pair(1, 0), {0, 1}, {1, 1}, {1, -1}})
                    if (x + dx < edge && y + dy >= 0 && y + dy < edge)
                        edges.emplace_back(x * edge + y, (x + dx) * edge + y + dy);
            }
        }
        test::Machine machine;
        graph = with_edges(graph, edges, machine.workers);
    }

    // Largest over smallest eigenvalue of Σ w e eᵀ in the plane, at the middle of the lattice.
    double anisotropy(const std::vector<double>& weight) const {
        constexpr std::size_t middle = (edge / 2) * edge + edge / 2;
        Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
        for (Index link = graph.first[middle]; link < graph.first[middle + 1]; ++link) {
            const Eigen::Vector2d e = (position[graph.neighbor[link]] - position[middle]).head<2>();
            spread += weight[link] * e * e.transpose();
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(spread);
        return solver.eigenvalues()[1] / solver.eigenvalues()[0];
    }
};

TEST(IsotropicWeights, PullEvenlyWhereSamplesLieInRows) {
    const Lattice lattice(3);
    const std::vector<double> uniform(lattice.graph.neighbor.size(), 1);
    // 9 for uniform weights: six of the eight links are 3 or √10 long, and none as long along x. A few
    // updates need not arrive at 1.
    EXPECT_GT(lattice.anisotropy(uniform), 5);
    EXPECT_LT(lattice.anisotropy(weights_for(lattice.graph, lattice.position)), 1.3);
}

TEST(IsotropicWeights, StayEvenWhereTheLatticeIsSquare) {
    const Lattice lattice(1);
    EXPECT_NEAR(lattice.anisotropy(weights_for(lattice.graph, lattice.position)), 1, 1e-9); // by symmetry
}

// The mean of |Σ w e| over Σ w |e| along the surface.
double unevenness(const Cloud& cloud, const std::vector<double>& weight) {
    double sum = 0;
    for (Index v = 0; v < cloud.graph.size(); ++v) {
        Vec3d pull = Vec3d::Zero();
        double effort = 0;
        for (Index link = cloud.graph.first[v]; link < cloud.graph.first[v + 1]; ++link) {
            const Vec3d edge = cloud.at(cloud.graph.neighbor[link]) - cloud.at(v);
            pull += weight[link] * edge;
            effort += weight[link] * edge.norm();
        }
        const Vec3d outward = cloud.at(v).normalized(); // of a sphere about the origin
        sum += (pull - pull.dot(outward) * outward).norm() / effort;
    }
    return sum / static_cast<double>(cloud.graph.size());
}

TEST(IsotropicWeights, LetPullsCancelOnASurfaceWithoutBorder) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::sphere, 3000));
    const std::vector<double> uniform(cloud.graph.neighbor.size(), 1);
    // Not to nothing: a vertex has about seven links, and each weight serves both its ends.
    EXPECT_LT(unevenness(cloud, weights_for(cloud.graph, places(cloud))), 0.6 * unevenness(cloud, uniform));
}

TEST(IsotropicWeights, AddUpAlikeForAnyNumberOfLinksAndToHalfOnAStraightBorder) {
    const Lattice lattice(1);
    const std::vector<double> weight = weights_for(lattice.graph, lattice.position);
    const auto sum_of = [&](Index v) {
        const auto first = weight.begin() + lattice.graph.first[v];
        return std::accumulate(first, weight.begin() + lattice.graph.first[v + 1], 0.0);
    };
    const Index middle = Lattice::edge / 2;
    const double inside = sum_of(middle * Lattice::edge + middle);
    EXPECT_NEAR(inside, 6, 0.1); // of eight
    EXPECT_NEAR(sum_of(middle) / inside, 0.5, 0.1);
}

// Σ w |e|² of each vertex.
std::vector<double> areas_of(const Cloud& cloud, const std::vector<double>& weight) {
    std::vector<double> area(cloud.size(), 0.0);
    for (Index v = 0; v < cloud.size(); ++v)
        for (Index link = cloud.graph.first[v]; link < cloud.graph.first[v + 1]; ++link)
            area[v] += weight[link] * (cloud.at(cloud.graph.neighbor[link]) - cloud.at(v)).squaredNorm();
    return area;
}

std::vector<double> weights_for_areas(const Cloud& cloud, const std::vector<double>& area,
                                      const WeightsOf& of = {0.5, false}) {
    Machine machine;
    const std::vector<float> contact(cloud.graph.neighbor.size(), 1.0F);
    return isotropic_weights(cloud.graph, places(cloud), contact, of, area, machine.workers);
}

TEST(IsotropicWeights, StandForTheAreasThatTheyAreTold) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::sphere, 2000));
    const std::vector<double> own = areas_of(cloud, weights_for(cloud.graph, places(cloud)));
    std::vector<double> wanted = own;
    for (std::size_t v = 0; v < cloud.size(); ++v) wanted[v] *= 2 + cloud.at(v).z();
    const std::vector<double> weight = weights_for_areas(cloud, wanted);
    expect_symmetric_and_positive(cloud.graph, weight);
    const std::vector<double> area = areas_of(cloud, weight);
    for (std::size_t v = 0; v < cloud.size(); ++v)
        EXPECT_NEAR(area[v], wanted[v], 0.2 * wanted[v]); // a link serves both its ends
    const std::vector<double> uniform(cloud.graph.neighbor.size(), 1);
    EXPECT_LT(unevenness(cloud, weight), 0.7 * unevenness(cloud, uniform));
}

TEST(IsotropicWeights, GoByTheRatioOfAreasAndTakeTheMeanWhereNoneIsKnown) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 2000));
    const std::vector<double> own = areas_of(cloud, weights_for(cloud.graph, places(cloud)));
    std::vector<double> known = own;
    for (std::size_t v = 0; v < known.size(); v += 3) known[v] = 0;
    std::vector<double> tenfold = known;
    for (double& area : tenfold) area *= 10;
    const std::vector<double> weight = weights_for_areas(cloud, known);
    const std::vector<double> heavy = weights_for_areas(cloud, tenfold);
    expect_symmetric_and_positive(cloud.graph, weight);
    for (std::size_t link = 0; link < weight.size(); ++link)
        ASSERT_NEAR(heavy[link], 10 * weight[link], 1e-9 * heavy[link]);
    const std::vector<double> area = areas_of(cloud, weight);
    for (std::size_t v = 0; v < known.size(); v += 3) EXPECT_NEAR(area[v], own[v], 0.5 * own[v]);
}

// What a sheet of these points resists when its rim is stretched along x and all else finds its place, over
// what an even stretch of as large a surface takes.
double resistance(const std::vector<float>& positions, double edge, bool with_areas) {
    Machine machine;
    const Cloud cloud = test::cloud_of(positions);
    const AskedVertices asked =
        ask_vertices(cloud.graph, cloud.positions, Numbering::as_they_stand(cloud.size()), {},
                     choose_by_number(cloud.size(), cloud.size()), 1, machine.workers);
    const std::vector<double> area(asked.area.begin(), asked.area.end());
    const std::vector<double> weight =
        with_areas ? weights_for_areas(cloud, area, of_points) : weights_for(cloud.graph, places(cloud));
    std::vector<double> x(cloud.size());
    for (std::size_t v = 0; v < cloud.size(); ++v) x[v] = cloud.at(v).x();
    const auto is_held = [&](std::size_t v) {
        return cloud.at(v).head<2>().minCoeff() < 2 || cloud.at(v).head<2>().maxCoeff() > edge - 2;
    };
    for (int sweep = 0; sweep < 200; ++sweep)
        for (Index v = 0; v < cloud.size(); ++v) {
            double pull = 0, sum = 0;
            for (Index link = cloud.graph.first[v]; link < cloud.graph.first[v + 1]; ++link) {
                pull += weight[link] * x[cloud.graph.neighbor[link]];
                sum += weight[link];
            }
            if (!is_held(v)) x[v] = pull / sum;
        }
    double resists =
        0; // of links within, each seen from both ends; Σ w |e|² is six times the area, half along x
    for (Index v = 0; v < cloud.size(); ++v)
        for (Index link = cloud.graph.first[v]; link < cloud.graph.first[v + 1]; ++link)
            if (!is_held(v)) resists += weight[link] * std::pow(x[cloud.graph.neighbor[link]] - x[v], 2);
    return resists / (3 * (edge - 4) * (edge - 4));
}

TEST(IsotropicWeights, MakeASheetResistByItsAreaHoweverItsPointsLie) {
    constexpr double edge = 40;
    std::mt19937 random(11);
    std::vector<float> even, thrown;
    for (int i = 0; i < 1600; ++i) {
        Vec3d p = Vec3d(i % 40 + 0.5, i / 40 + 0.5, 0) + 0.2 * test::random_vector(random);
        p.z() = 0;
        test::append(even, p);
        p = 0.5 * edge * (test::random_vector(random) + Vec3d::Ones());
        p.z() = 0;
        test::append(thrown, p);
    }
    EXPECT_NEAR(resistance(even, edge, true), 1, 0.04);
    EXPECT_NEAR(resistance(thrown, edge, true), 1, 0.06);
    EXPECT_LT(resistance(thrown, edge, false), 0.75); // by the sum 6 c
}

TEST(IsotropicWeights, DoNotDependOnTheUnit) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 1000));
    std::vector<Vec3d> scaled = places(cloud);
    for (Vec3d& p : scaled) p *= 1000;
    const auto weight = weights_for(cloud.graph, places(cloud));
    const auto other = weights_for(cloud.graph, scaled);
    for (std::size_t link = 0; link < weight.size(); ++link)
        ASSERT_NEAR(other[link], weight[link], 1e-9 * weight[link]); // rounding only
}

TEST(IsotropicWeights, AreFiniteWhereSamplesCoincide) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::sphere, 400));
    std::vector<Vec3d> position = places(cloud);
    for (std::size_t v = 0; v < 50; ++v) position[v] = position[60]; // whole stars without extent
    expect_symmetric_and_positive(cloud.graph, weights_for(cloud.graph, position));
    std::ranges::fill(position, Vec3d(1, 2, 3));
    expect_symmetric_and_positive(cloud.graph, weights_for(cloud.graph, position));
}

TEST(IsotropicWeights, AreTheSameForAnyNumberOfThreads) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 5000));
    const auto one = weights_for(cloud.graph, places(cloud), 1);
    EXPECT_EQ(weights_for(cloud.graph, places(cloud), 2), one);
    EXPECT_EQ(weights_for(cloud.graph, places(cloud), 5), one);
}

TEST(IsotropicWeights, AcceptAGraphWithoutLinks) {
    const Cloud cloud = test::cloud_of({1, 2, 3});
    EXPECT_TRUE(weights_for(cloud.graph, places(cloud)).empty());
}

} // namespace
} // namespace knead
