// A pipeline whose handles change one after the other is the one that had them from the start.

#include "edit/editing.h"
#include "edit/handle_motion.h"

#include <random>

namespace knead {
namespace {

using namespace test;

constexpr Index twins = 600; // so many points, the first ones, have a second at their place

std::vector<float> shape_of(Shape shape, std::size_t points) {
    Workers workers(2);
    SilentProgress progress;
    ShapeOptions options;
    options.points = points;
    return make_shape(shape, options, workers, progress).positions;
}

// One surface, which every handle holds a part of.
PointCloud one_shape() {
    std::vector<float> positions = shape_of(Shape::creature, 4000);
    positions.insert(positions.end(), positions.begin(), positions.begin() + twins);
    return make_cloud(positions);
}

// Two surfaces apart, and in the second some points twice.
PointCloud two_shapes() {
    std::vector<float> positions = shape_of(Shape::creature, 4000);
    const std::vector<float> second = shape_of(Shape::sphere, 900);
    for (std::size_t i = 0; i < second.size(); ++i)
        positions.push_back(second[i] + (i % 3 == 0 ? 9.0F : 0.0F));
    positions.insert(positions.end(), second.begin(), second.begin() + 300); // inside the creature
    positions.insert(positions.end(), positions.begin(), positions.begin() + twins);
    return make_cloud(positions);
}

Handle random_handle(const PointCloud& cloud, std::mt19937& random) {
    const auto any = [&](std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
    };
    const Vec3d center = point_at(cloud.positions, any(cloud.size()));
    const double radius = std::array{0.0, 0.2, 0.7, 2.0}.at(any(4));
    const Index first = any(3) == 0 ? twins : 0; // without one of two that are at the same place
    std::vector<Index> points;
    for (Index i = first; i < cloud.size(); ++i)
        if ((point_at(cloud.positions, i) - center).norm() <= radius) points.push_back(i);
    if (points.empty()) points.push_back(first);
    Handle handle;
    handle.role = any(6) == 0 ? HandleRole::region_of_interest : HandleRole::moving;
    handle.points = std::make_shared<const std::vector<Index>>(std::move(points));
    handle.free_rotation = any(4) == 0;
    handle.falloff = any(4) == 0 ? 0.5 : 0;
    return handle;
}

// One more, one less, another in its place, or one that holds in another way; at least one remains.
void change(std::vector<Handle>& handles, const PointCloud& cloud, std::mt19937& random) {
    const auto at = [&] { return handles.begin() + static_cast<std::ptrdiff_t>(random() % handles.size()); };
    const auto what = random() % 4;
    if (handles.empty() || (what == 0 && handles.size() < 12))
        handles.push_back(random_handle(cloud, random));
    else if (what == 1 && handles.size() > 1)
        handles.erase(at());
    else if (what == 2)
        at()->free_rotation ^= true;
    else
        *at() = random_handle(cloud, random);
}

RestShape posed(Pipeline& pipeline, std::size_t handles) {
    std::vector<HandleMotion> motions(handles);
    for (std::size_t h = 0; h < handles; ++h) {
        HandlePose pose;
        pose.translate = Vec3d(0.1 * static_cast<double>(h), 0, 0.05);
        pose.rotate = Eigen::AngleAxisd(0.3 + static_cast<double>(h), Vec3d::UnitX());
        motions[h] = motion_of(pose, Vec3d::Zero(), Vec3d::Zero(), {});
    }
    SampleState state = pipeline.rest_state();
    Acceleration acceleration;
    pipeline.follow_handles(motions, state);
    for (int i = 0; i < 2; ++i) pipeline.iterate(motions, state, acceleration);
    pipeline.upsample(motions, state);
    return pipeline.posed();
}

// By the handles' numbers in the list: a pipeline's own ones depend on what was there before.
std::vector<Index> held_by(const Pipeline& pipeline, std::vector<Index> labels) {
    for (Index& label : labels) label = pipeline.handle_of(label);
    return labels;
}
std::vector<Index> moved_by(const Pipeline& pipeline, const Influence& influence) {
    std::vector<Index> movers(influence.motion.begin(), influence.motion.begin() + influence.count);
    for (Index& mover : movers)
        if (mover >= pipeline.first_handle_motion())
            mover = static_cast<Index>(pipeline.samples().size()) +
                    pipeline.handle_of(mover - pipeline.first_handle_motion());
    return movers;
}

// To the last bit.
void expect_same(Pipeline& changed, Pipeline& fresh, std::size_t handles) {
    EXPECT_EQ(held_by(changed, changed.labels().point), held_by(fresh, fresh.labels().point));
    EXPECT_EQ(held_by(changed, changed.labels().vertex), held_by(fresh, fresh.labels().vertex));
    EXPECT_EQ(changed.samples(), fresh.samples());
    EXPECT_EQ(changed.sample_graph().graph.first, fresh.sample_graph().graph.first);
    EXPECT_EQ(changed.sample_graph().graph.neighbor, fresh.sample_graph().graph.neighbor);
    EXPECT_EQ(changed.sample_graph().contact, fresh.sample_graph().contact);
    EXPECT_EQ(words_about(changed.strays()), words_about(fresh.strays()));
    for (Index v = 0; v < fresh.order().vertices(); ++v) {
        const Influence one = changed.influence(v), other = fresh.influence(v);
        ASSERT_EQ(one.count, other.count) << "vertex " << v;
        ASSERT_EQ(moved_by(changed, one), moved_by(fresh, other)) << "vertex " << v;
        ASSERT_EQ(one.weight, other.weight) << "vertex " << v;
    }
    EXPECT_EQ(posed(changed, handles).positions, posed(fresh, handles).positions);
}

void expect_as_from_the_start(Pipeline& changed, const PointCloud& cloud, const PipelineInput& input,
                              Workers& workers) {
    SilentProgress progress;
    changed.prepare(input, progress);
    const auto upsampler = make_reference_upsampler(workers);
    Pipeline fresh(cloud, workers, *upsampler);
    fresh.prepare(input, progress);
    expect_same(changed, fresh, input.handles.size());
}

Strays other_than(Strays strays) {
    return strays == Strays::bridge ? Strays::carry : Strays::bridge;
}

void expect_nothing_left_behind(const PointCloud& cloud, std::size_t handles, Strays strays) {
    Workers workers(2);
    const auto upsampler = make_reference_upsampler(workers);
    Pipeline pipeline(cloud, workers, *upsampler);
    PipelineInput input;
    input.settings.samples = 300;
    input.settings.strays = strays;
    std::mt19937 random(5);
    for (std::size_t h = 1; h < handles; ++h) input.handles.push_back(random_handle(cloud, random));
    for (int step = 0; step < 25; ++step) {
        SCOPED_TRACE("step " + std::to_string(step));
        change(input.handles, cloud, random);
        if (step == 15) input.settings.samples = 500;
        if (step == 18) input.settings.samples.reset();
        if (step == 20) input.settings.samples = 400;
        if (step % 6 == 5)
            input.settings.strays = input.settings.strays == strays ? other_than(strays) : strays;
        expect_as_from_the_start(pipeline, cloud, input, workers);
    }
}

class HandleChanges : public testing::TestWithParam<Strays> {};

TEST_P(HandleChanges, LeaveNothingBehind) {
    expect_nothing_left_behind(two_shapes(), 1, GetParam());
}

TEST_P(HandleChanges, LeaveNothingBehindWhereEveryPartIsHeld) {
    expect_nothing_left_behind(one_shape(), 9, GetParam()); // so many that some share a flood
}

// What is so far from the first point.
Handle between(double nearest, double farthest, const PointCloud& cloud, Index first = 0) {
    std::vector<Index> points;
    for (Index i = first; i < cloud.size(); ++i) {
        const double distance = (point_at(cloud.positions, i) - point_at(cloud.positions, 0)).norm();
        if (nearest <= distance && distance <= farthest) points.push_back(i);
    }
    EXPECT_FALSE(points.empty());
    Handle handle;
    handle.points = std::make_shared<const std::vector<Index>>(std::move(points));
    return handle;
}

class TwoHandles : public testing::Test {
protected:
    TwoHandles() {
        input_.settings.samples = 300;
        input_.handles = {between(0, 0.4, cloud_, twins), between(2, 99, cloud_)}; // the first without twins
    }

    void expect_as_from_the_start() { knead::expect_as_from_the_start(pipeline_, cloud_, input_, workers_); }

    Workers workers_{2};
    const std::unique_ptr<Upsampler> upsampler_ = make_reference_upsampler(workers_);
    const PointCloud cloud_ = one_shape();
    Pipeline pipeline_{cloud_, workers_, *upsampler_};
    PipelineInput input_;
};

// Points at the place of held ones follow the handle, or the cloud where it leaves rotation free.
TEST_F(TwoHandles, FreeRotationReachesTwins) {
    for (const bool free_rotation : {false, true, false}) {
        input_.handles[0].free_rotation = free_rotation;
        expect_as_from_the_start();
    }
}

TEST_F(TwoHandles, AThirdGoesTogetherWithASettingOfTheGraph) {
    input_.handles.push_back(between(0.9, 1.4, cloud_));
    expect_as_from_the_start();
    input_.handles.pop_back();
    input_.settings.strays = Strays::bridge;
    expect_as_from_the_start();
}

INSTANTIATE_TEST_SUITE_P(Pipeline, HandleChanges,
                         testing::Values(Strays::freeze, Strays::carry, Strays::bridge));

} // namespace
} // namespace knead
