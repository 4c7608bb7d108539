// Distances between poses: of one cloud, and of two clouds of one surface.

#include "bench/deviation.h"

#include "base/workers.h"
#include "bench/made_cloud.h"
#include "bench/posing.h"
#include "upsample/devices.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace knead;

TEST(Deviation, IsToldOverTheDiagonal) {
    const std::vector<float> a{0, 0, 0, 1, 1, 1};
    const std::vector<float> b{3, 4, 0, 1, 1, 1};
    const Deviation deviation = deviation_between(a, b, 10);
    EXPECT_DOUBLE_EQ(deviation.largest, 0.5);
    EXPECT_DOUBLE_EQ(deviation.rms, 0.5 / std::sqrt(2.0));
    EXPECT_EQ(deviation_between(a, a, 10).rms, 0);
    EXPECT_DOUBLE_EQ(deviation_between(a, b, 0).largest, 5);
}

TEST(Deviation, LeavesOutPointsThatAreNotFinite) {
    const std::vector<float> a{std::nanf(""), 0, 0, 1, 1, 1};
    EXPECT_EQ(deviation_between(a, a, 1).largest, 0);
}

// Points of a sheet, bent around a cylinder of radius 1.
struct Sheet {
    std::vector<float> rest, posed;
    std::size_t points = 0;
    PosedCloud seen() const { return {rest, posed, points}; }
};

Sheet bent_sheet(int across, float shift) {
    Sheet sheet;
    for (int i = 0; i < across; ++i)
        for (int j = 0; j < across; ++j) {
            const float x = (static_cast<float>(i) + shift) / static_cast<float>(across);
            const float y = (static_cast<float>(j) + shift) / static_cast<float>(across);
            sheet.rest.insert(sheet.rest.end(), {x, y, 0});
            sheet.posed.insert(sheet.posed.end(), {std::sin(x), y, 1 - std::cos(x)});
            ++sheet.points;
        }
    return sheet;
}

TEST(FieldDeviation, IsAlmostNothingBetweenTwoSamplingsOfOneField) {
    Workers workers(2);
    const Sheet sheet = bent_sheet(40, 0.2F), other = bent_sheet(50, 0.7F);
    // Half a spacing along the sheet, turned by as much as the neighbours differ: spacing² over the radius.
    EXPECT_LT(field_deviation(sheet.seen(), other.seen(), 1, workers).largest, 1e-3);
    EXPECT_LT(field_deviation(other.seen(), sheet.seen(), 1, workers).largest, 2e-3);
}

TEST(FieldDeviation, SeesADifference) {
    Workers workers(2);
    const Sheet sheet = bent_sheet(40, 0.2F);
    Sheet other = bent_sheet(50, 0.7F);
    for (std::size_t i = 2; i < other.posed.size(); i += 3) other.posed[i] += 0.1F;
    const Deviation deviation = field_deviation(sheet.seen(), other.seen(), 2, workers);
    EXPECT_NEAR(deviation.rms, 0.05, 1e-3);
    EXPECT_NEAR(deviation.largest, 0.05, 1e-3);
    Sheet spiked = bent_sheet(40, 0.2F);
    spiked.posed[2] += 1;
    PosedCloud seen = spiked.seen();
    EXPECT_GT(field_deviation(seen, bent_sheet(50, 0.7F).seen(), 1, workers).largest, 0.9);
    // What is not counted is not looked at: a stray at the end.
    spiked = bent_sheet(40, 0.2F);
    spiked.posed.back() += 1;
    seen = spiked.seen();
    --seen.points;
    EXPECT_LT(field_deviation(seen, bent_sheet(50, 0.7F).seen(), 1, workers).largest, 1e-3);
}

TEST(LinkNoise, IsThatOfTheStretch) {
    Workers workers(2);
    SilentProgress progress;
    const auto upsampler = make_reference_upsampler(workers);
    const DeformationTask task = bending_task("ball", made_cloud(Shape::sphere, 1500, workers, progress), 30);
    const auto document = open_task(task, with_samples(100), workers, *upsampler);
    document->drag(whole_motion(task), "", progress);
    const Pipeline& pipeline = document->pipeline();
    EXPECT_EQ(link_noise(pipeline, pipeline.opened().positions), 0);
    LineArray<float> twice = pipeline.opened().positions;
    for (float& value : twice) value *= 2;
    EXPECT_NEAR(link_noise(pipeline, twice), std::log(2.0), 1e-6);
    EXPECT_GT(link_noise(pipeline, document->shape(progress).positions), 1e-3);
}

} // namespace
