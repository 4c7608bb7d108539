// The studies of the evaluation, on small generated shapes.

#include "base/workers.h"
#include "bench/demands.h"
#include "bench/made_cloud.h"
#include "bench/posing.h"
#include "bench/report.h"
#include "bench/sampling.h"
#include "bench/scan_samples.h"
#include "bench/small_handles.h"
#include "bench/stiffness.h"
#include "bench/turns.h"
#include "support/scratch_folder.h"
#include "upsample/devices.h"

#include <gtest/gtest.h>

namespace {

using namespace knead;

class Studies : public testing::Test {
protected:
    Workers workers{2};
    std::unique_ptr<Upsampler> upsampler = make_reference_upsampler(workers);
    SilentProgress progress;

    DeformationTask small_task(Shape shape, std::size_t points) {
        return bending_task("small", made_cloud(shape, points, workers, progress), 45);
    }
};

TEST_F(Studies, FewSamplesAreMeasuredFromAllOfThem) {
    constexpr std::uint64_t counts[] = {5000, 400, 100}; // the first is more than there are
    const ScanSamples result =
        evaluate_scan_samples(small_task(Shape::bar, 2000), counts, workers, *upsampler, progress);
    ASSERT_EQ(result.counts.size(), 3U);
    EXPECT_FALSE(result.counts[0].asked);
    EXPECT_EQ(result.counts[0].samples, 2000U);
    EXPECT_EQ(result.counts[0].rms, 0);
    for (const ScanSampleCount& count : result.counts) {
        EXPECT_TRUE(count.at_rest);
        EXPECT_GT(count.noise, 0);
        EXPECT_LT(count.rms, 0.02);
        EXPECT_LE(count.rms, count.largest);
    }
    const std::string text = scan_samples_text({&result, 1});
    EXPECT_NE(text.find("aim 1.2"), std::string::npos);
    const ReportJson told = scan_samples_json({&result, 1});
    EXPECT_EQ(told.at(0).at("samples").at(0).at("asked"), "all");
    EXPECT_EQ(told.at(0).at("samples").at(0).at("noise_times"), 1);
}

TEST_F(Studies, AScanThatIsNotThereIsSaid) {
    const test::ScratchFolder folder;
    const ScanSamples result = evaluate_scan_samples(
        scans_of_the_paper()[0], scan_folders(folder.path().string()), workers, *upsampler, progress);
    EXPECT_NE(result.missing.find("bunny.ply"), std::string::npos);
    EXPECT_NE(scan_samples_text({&result, 1}).find("no bunny.ply"), std::string::npos);
}

TEST_F(Studies, ASamplingAgreesWithItselfAndWithAnother) {
    ShapeOptions sampling;
    sampling.points = 2000;
    const DeformationTask task = generated_task("made-cylinder", sampling, workers, progress);
    sampling.seed = 2;
    const DeformationTask twin = generated_task("made-cylinder", sampling, workers, progress);
    const SamplingResult same =
        compare_samplings(task, task.cloud.size(), task, 300, Strays::freeze, workers, *upsampler, progress);
    EXPECT_LT(same.deviation.largest, 1e-6);
    const SamplingResult other =
        compare_samplings(task, task.cloud.size(), twin, 300, Strays::freeze, workers, *upsampler, progress);
    EXPECT_GT(other.deviation.rms, 0);
    EXPECT_LT(other.deviation.rms, 0.01);
    EXPECT_TRUE(other.at_rest);
    EXPECT_NE(sampling_text({&other, 1}).find("aim rms 0.4"), std::string::npos);
    EXPECT_EQ(sampling_json({&other, 1}).at(0).at("asked_samples"), 300);
}

TEST_F(Studies, WaysToOnePoseMeet) {
    ShapeOptions sampling;
    sampling.points = 1500;
    Course course;
    course.name = "tube";
    course.task = generated_task("made-cylinder", sampling, workers, progress);
    course.axis = Vec3d::UnitY();
    course.degrees = 120;
    course.translate = course.task.pose.translate;
    constexpr std::size_t frames[] = {1, 10};
    const auto results = go_course(course, frames, workers, *upsampler, progress);
    ASSERT_EQ(results.size(), 2U);
    for (const TurnResult& result : results) {
        EXPECT_TRUE(result.aimed);
        EXPECT_TRUE(result.at_rest);
        EXPECT_LT(result.settled.largest, turn_bar);
    }
    EXPECT_EQ(results[1].settled.largest, 0); // the yardstick itself
    course.degrees = 180;
    course.ambiguous = true;
    const auto half_turn = go_course(course, std::span(frames).first(1), workers, *upsampler, progress);
    EXPECT_FALSE(half_turn[0].aimed);
    EXPECT_NE(turns_text(half_turn).find("ambiguous"), std::string::npos);
    EXPECT_TRUE(turns_json(half_turn).at(0).at("settled").at("holds").is_null());
}

TEST_F(Studies, ATwistThatSlippedIsNoneThatAgrees) {
    Course course;
    course.name = "bar";
    course.task = generated_task("made-long-bar", workers, progress);
    course.axis = Vec3d::UnitZ();
    course.degrees = 360;
    course.twists = true;
    constexpr std::size_t frames[] = {18, 1}; // in one frame a whole turn is none
    const auto results = go_course(course, frames, workers, *upsampler, progress);
    EXPECT_NEAR(results[0].twist.value(), 360, twist_bar);
    EXPECT_NEAR(results[1].twist.value(), 0, twist_bar);
    const ReportJson json = turns_json(results);
    EXPECT_TRUE(json.at(0).at("twist").at("holds"));
    EXPECT_FALSE(json.at(1).at("twist").at("holds"));
}

TEST_F(Studies, ImpossibleDemandsAreSharedOutAndSaid) {
    ShapeOptions sampling;
    sampling.points = 1500;
    DemandCase pulled{"pulled", generated_task("made-bar", sampling, workers, progress), true, true};
    pulled.task.pose = {};
    const auto evaluated = [&] { return evaluate_demand(pulled, workers, *upsampler, progress); };
    const DemandResult still = evaluated();
    EXPECT_EQ(still.words, "");
    EXPECT_NE(demands_text({&still, 1}).find("FAIL"), std::string::npos); // it should have said something
    pulled.task.pose.translate = Vec3d(0, 0, 12);
    const DemandResult result = evaluated();
    EXPECT_NE(result.words, "");
    EXPECT_LT(result.handle_error, 1e-6);
    ASSERT_TRUE(result.uneven);
    EXPECT_LT(*result.uneven, 0.5); // coarse slabs, of 1500 points
    EXPECT_EQ(demands_json({&result, 1}).at(0).at("said"), result.words);
}

TEST_F(Studies, SmallHandlesAreSeenBesideEveryPointASample) {
    ShapeOptions sampling;
    sampling.points = 4000;
    DeformationTask task = generated_task("made-plane", sampling, workers, progress);
    constexpr std::uint64_t samples[] = {200};
    const auto results = pose_small(task, samples, workers, *upsampler, progress);
    ASSERT_EQ(results.size(), 2U);
    EXPECT_FALSE(results[0].asked);
    EXPECT_EQ(results[0].deviation.largest, 0); // the yardstick itself
    EXPECT_GT(results[1].deviation.rms, 0);
    EXPECT_LT(results[1].deviation.rms, 0.01);
    for (const SmallResult& result : results) {
        EXPECT_TRUE(result.at_rest);
        EXPECT_GT(result.askew.half, 0);
        EXPECT_LT(result.askew.tenth, 10);
        EXPECT_GE(result.askew.tenth, result.askew.half);
    }
    const ReportJson json = small_handles_json(results);
    EXPECT_EQ(json.at(1).at("asked_samples"), 200);
    EXPECT_TRUE(json.at(0).at("holds").is_null());
    EXPECT_NE(small_handles_text(results).find("every point"), std::string::npos);
}

TEST_F(Studies, StiffnessLooksTheSameAtEverySize) {
    constexpr double stiffnesses[] = {0.01, 1};
    constexpr std::uint64_t samples[] = {200};
    const auto results =
        evaluate_stiffness(small_task(Shape::bar, 1500), stiffnesses, samples, workers, *upsampler, progress);
    ASSERT_EQ(results.size(), 2U);
    EXPECT_EQ(results[0].from_usual.rms, 0); // it is the usual one
    EXPECT_GT(results[1].from_usual.rms, 0);
    for (const StiffnessResult& result : results) {
        ASSERT_EQ(result.counts.size(), 1U);
        EXPECT_LT(result.counts[0].at_scale.largest, scale_bar);
        EXPECT_LT(result.counts[0].deviation.rms, 0.02);
    }
    EXPECT_NE(stiffness_text(results).find("pass"), std::string::npos);
    EXPECT_EQ(stiffness_json(results).at(0).at("samples").at(0).at("asked"), 200);
}

} // namespace
