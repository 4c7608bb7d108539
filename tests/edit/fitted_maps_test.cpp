#include "deform/fitted_maps.h"

#include "editing.h"
#include "graph/clouds.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace knead::test {
namespace {

// A bar with few samples, built by the pipeline, and a pose of it.
struct Bent {
    Machine machine;
    SampleSystem system;
    SampleState state;
    std::vector<HandleMotion> handles;

    Bent() {
        Settings settings;
        settings.samples = 60;
        Desk desk(made(Shape::bar, 6000), settings);
        desk.play(R"({"op":"handle","name":"low","role":"fixed","region":{"halfspace":{"point":[0,0,-2],)"
                  R"("normal":[0,0,-1]}}})"
                  "\n"
                  R"({"op":"handle","name":"top","role":"moving","region":{"halfspace":{"point":[0,0,2],)"
                  R"("normal":[0,0,1]}}})"
                  "\n" +
                  drag("{}"));
        const SampleRest& rest = desk.pipeline().system().rest;
        EXPECT_TRUE(build_system(rest, system, machine.workers).solved);
        handles.resize(rest.energy.handles());
        state = rest_state(system);
    }

    std::size_t highest() const {
        const auto height = [](const Vec3d& place) { return place.z(); };
        const std::vector<Vec3d>& places = system.rest.position;
        return static_cast<std::size_t>(std::ranges::max_element(places, {}, height) - places.begin());
    }

    // All of it by one motion, or the upper end alone.
    void move(const HandleMotion& motion, bool all) {
        if (all) std::ranges::fill(handles, motion);
        handles[system.rest.handle[highest()]] = motion;
        follow_handles(system, handles, state, machine.workers);
        for (int k = 0; k < 10; ++k) iterate(system, handles, state, machine.workers);
        find_maps(system, handles, state, machine.workers);
    }
};

HandleMotion turned(double angle, const Vec3d& shift) {
    HandleMotion motion;
    motion.rotation = Quatd(Eigen::AngleAxisd(angle, Vec3d::UnitX()));
    motion.linear = motion.rotation.toRotationMatrix();
    motion.offset = shift;
    return motion;
}

// The system that the maps solve, all of it: what is on its left, and on its right.
struct Dense {
    Eigen::MatrixXd matrix, right, found;

    explicit Dense(const Bent& bent) {
        const SampleSystem& system = bent.system;
        const PointEnergy& energy = system.rest.energy;
        const auto rows = static_cast<Eigen::Index>(3 * system.free_sample.size());
        matrix = Eigen::MatrixXd::Zero(rows, rows);
        right = found = Eigen::MatrixXd::Zero(rows, 3);
        for (std::size_t row = 0; row < system.free_sample.size(); ++row) {
            const Index t = system.free_sample[row];
            const auto own = static_cast<Eigen::Index>(3 * row);
            matrix.diagonal().segment<3>(own).array() += system.fit.preference[row];
            found.block<3, 3>(own, 0) = (bent.state.rotation[t] * system.stretch[row]).transpose();
            for (Index at = energy.first[t]; at < energy.first[t + 1]; ++at) {
                const Index s = energy.body[at];
                if (s >= energy.samples + energy.handles()) continue; // no handle grows
                const bool is_sample = s < energy.samples;
                if (is_sample && system.unknown[s] != no_index)
                    matrix.block<3, 3>(own, 3 * system.unknown[s]) += energy.map_products[at].transpose();
                const HandleMotion rest;
                const HandleMotion& handle = is_sample ? rest : bent.handles[s - energy.samples];
                const Mat3d map =
                    is_sample ? Mat3d(bent.state.rotation[s].toRotationMatrix()) : handle.linear;
                const Vec3d way = is_sample ? bent.state.displacement[s] : handle.offset;
                const Mat3d beyond = map - Mat3d::Identity();
                const Mat3d side = beyond * (energy.fits[at].target - energy.map_products[at]) -
                                   way * energy.fits[at].way.transpose();
                right.block<3, 3>(own, 0) += side.transpose();
            }
        }
    }

    double energy_of(const Eigen::MatrixXd& maps) const {
        return 0.5 * maps.cwiseProduct(matrix * maps).sum() - maps.cwiseProduct(right).sum();
    }
};

TEST(FittedMaps, ComeNearToTheLeastEnergyInAFewSteps) {
    Bent bent;
    bent.move(turned(1, {0, 1, 0}), false);
    const Dense dense(bent);
    EXPECT_LT((dense.matrix - dense.matrix.transpose()).norm(), 1e-12 * dense.matrix.norm());
    const Eigen::LDLT<Eigen::MatrixXd> factor(dense.matrix);
    ASSERT_TRUE(factor.isPositive());
    const double least = dense.energy_of(factor.solve(dense.right)), now = dense.energy_of(dense.found);
    EXPECT_LT(least, 0); // of no maps at all it is 0
    EXPECT_LT(now, 0.85 * least);
    EXPECT_GT(now, least);
}

TEST(FittedMaps, AreTurnsWhereAllIsMovedByOneMotion) {
    Bent bent;
    bent.move(turned(2, {3, 1, 7}), true);
    for (const Mat3d& stretch : bent.system.stretch) EXPECT_LT(stretch.norm(), 1e-6);
}

TEST(FittedMaps, AreNothingAtRest) {
    Bent bent;
    bent.move({}, true);
    for (const Mat3d& stretch : bent.system.stretch) EXPECT_EQ(stretch, Mat3d(Mat3d::Zero()));
}

// A sample that moves hardly any point but its own says nothing of its map. Outliers that hang there, far
// off the surface, would be where its columns point.
TEST(FittedMaps, FlingNoOutliersAway) {
    Workers workers(2);
    SilentProgress progress;
    ShapeOptions options;
    options.points = 20'000;
    options.outliers = 0.1;
    Settings settings;
    settings.samples = 500;
    Desk desk(make_shape(Shape::sphere, options, workers, progress), settings);
    desk.play(R"({"op":"handle","name":"low","role":"fixed","region":{"halfspace":{"point":[0,0,-0.8],)"
              R"("normal":[0,0,-1]}}})"
              "\n"
              R"({"op":"handle","name":"top","role":"moving","region":{"halfspace":{"point":[0,0,0.8],)"
              R"("normal":[0,0,1]}}})"
              "\n"
              R"({"op":"drag","handle":"top","pivot":[0,0,0],"frames":[{"rotate":[0.94,0.342,0,0]}]})"
              "\n"
              R"({"op":"settle","iterations":30})");
    for (const float coordinate : desk.shape()) EXPECT_LT(std::abs(coordinate), 2);
}

// A hand that holds still: the next frame begins with the maps of the last one.
TEST(FittedMaps, OutlastTheBeginningOfAFrame) {
    Bent bent;
    HandleMotion pulled;
    pulled.offset = {0, 0, 2};
    bent.move(pulled, false);
    for (int k = 0; k < 300; ++k) iterate(bent.system, bent.handles, bent.state, bent.machine.workers);
    const std::vector<Vec3d> before = bent.state.displacement;
    follow_handles(bent.system, bent.handles, bent.state, bent.machine.workers);
    for (std::size_t s = 0; s < before.size(); ++s)
        EXPECT_LT((bent.state.displacement[s] - before[s]).norm(), 1e-6) << s;
}

} // namespace
} // namespace knead::test
