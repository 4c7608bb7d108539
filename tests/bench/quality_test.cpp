// Quality and properties, on generated shapes.

#include "base/error.h"
#include "bench/evaluation.h"
#include "bench/made_cloud.h"
#include "support/scratch_folder.h"
#include "upsample/devices.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace {

using namespace knead;
using nlohmann::json;

TEST(TurnsAlongZ, CountsEveryTurn) {
    std::vector<float> rest, posed;
    for (int i = 0; i <= 1000; ++i) {
        const double z = i / 1000.0;
        for (const double around : {0.0, 2.0, 4.0}) {
            const double twist = z * 5 * std::numbers::pi; // 900° in all
            for (const double value : {std::cos(around), std::sin(around), z})
                rest.push_back(static_cast<float>(value));
            for (const double value : {std::cos(around + twist), std::sin(around + twist), z})
                posed.push_back(static_cast<float>(value));
        }
    }
    const std::vector<double> turns = turns_along_z(rest, posed, 100);
    ASSERT_EQ(turns.size(), 100U);
    EXPECT_NEAR(turns.back() - turns.front(), 900 * 0.99, 0.5); // between the middles of the end slices
    EXPECT_NEAR(turns_along_z(rest, rest, 100).back(), 0, 1e-9);
}

TEST(Properties, HoldOnASmallSphere) {
    Workers workers(2);
    SilentProgress progress;
    // Of so many points that 1000 samples ask those between.
    const PointCloud cloud = made_cloud(Shape::sphere, 12'000, workers, progress);
    const CloudProperties result = evaluate_cloud("ball", cloud, "reference", 2, progress);
    EXPECT_EQ(result.points, 12'000U);
    EXPECT_EQ(result.strays, 0U);
    EXPECT_LT(result.rigid, rigid_bar);
    EXPECT_LT(result.rigid_in_turns, rigid_in_turns_bar);
    EXPECT_EQ(result.moved_by_nothing, 0U);
    EXPECT_LT(result.handle_error, rigid_bar);
    EXPECT_TRUE(result.same_again);
    EXPECT_TRUE(result.same_for_threads);
}

TEST(Evaluation, ComparesNumbersOfSamplesOnALikeness) {
    Workers workers(2);
    SilentProgress progress;
    const UpsamplerChoice choice = make_upsampler("reference", workers, 2);
    const DeformationTask task = generated_task("made-bar", workers, progress);
    const TaskQuality quality = evaluate_task(task, workers, *choice.upsampler, progress);
    ASSERT_EQ(quality.counts.size(), 4U);
    EXPECT_EQ(quality.counts[0].samples, task.cloud.size());
    EXPECT_EQ(quality.counts[0].deviation.rms, 0);
    for (const SampleQuality& count : quality.counts) {
        EXPECT_TRUE(count.at_rest);
        EXPECT_LT(count.handle_error, 1e-5);
        EXPECT_LT(count.deviation.rms, 0.05);
        EXPECT_FALSE(count.bar); // those are the survey's
    }
    for (const Convergence& convergence : quality.convergence)
        EXPECT_LT(convergence.steps.back().deviation.largest, convergence.steps.front().deviation.largest);
}

TEST(Evaluation, StandsOnLikenessesWithoutASurvey) {
    const test::ScratchFolder folder;
    EvaluationOptions options;
    options.scans = scan_folders(folder.path().string());
    options.survey = survey_folders(folder.path().string());
    options.device = "reference";
    options.shapes = {"made-cylinder"};
    SilentProgress progress;
    const Evaluation evaluation = evaluate(options, progress);
    EXPECT_FALSE(evaluation.has_survey);
    EXPECT_NE(evaluation.remark.find("survey"), std::string::npos);
    ASSERT_EQ(evaluation.tasks.size(), 1U);
    EXPECT_TRUE(evaluation.clouds.empty());
    EXPECT_FALSE(evaluation.twist);
    EXPECT_NE(evaluation_text(evaluation).find("every point"), std::string::npos);
    const json told = json::parse(evaluation_json(evaluation));
    EXPECT_EQ(told.at("tasks").at(0).at("samples").at(0).at("asked"), "all");
    const json& steps = told.at("tasks").at(0).at("convergence").at(0).at("steps");
    ASSERT_EQ(steps.size(), 5U);
    EXPECT_TRUE(steps.at(3).at("bar").is_null()); // what is aimed at is the survey's

    options.shapes = {"teapot"};
    EXPECT_THROW(evaluate(options, progress), Error);
}

} // namespace
