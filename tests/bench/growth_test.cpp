#include "bench/growth.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace {

using namespace knead;
using nlohmann::json;

TEST(Growth, FindsTheExponentOfAPowerLaw) {
    std::vector<RowFigures> rows;
    for (const std::size_t points : {10U, 300U, 7000U}) {
        RowFigures row;
        row.points = points;
        row.samples = 100;
        row.order = summarize({2e-6 * std::pow(points, 1.25)});
        rows.push_back(row);
    }
    const Stage order = growth_stages()[0];
    EXPECT_NEAR(fitted_exponent(rows, &RowFigures::points, order).value(), 1.25, 1e-9);
    EXPECT_FALSE(fitted_exponent(rows, &RowFigures::samples, order)); // all of one size
    const Stage upsample = growth_stages().back();
    EXPECT_FALSE(fitted_exponent(rows, &RowFigures::points, upsample)); // never measured
}

TEST(Growth, MeasuresEverySizeAndStage) {
    Table1Options options;
    options.repeats = 1;
    options.threads = 2;
    options.device = "reference";
    SilentProgress progress;
    const Growth growth = measure_growth(30'000, options, progress);
    ASSERT_EQ(growth.by_points.size(), 2U);
    EXPECT_EQ(growth.by_points[1].points, 30'000U);
    ASSERT_EQ(growth.by_samples.size(), 4U); // 100, 300, 1000, 3000
    EXPECT_GT(growth.by_samples[3].samples, 2500U);
    for (const RowFigures& row : growth.by_samples)
        for (const Stage& stage : growth_stages()) EXPECT_GT((row.*stage.seconds).lowest, 0) << stage.name;
    for (const RowFigures& row : growth.by_points) {
        EXPECT_FALSE(row.upsampling.with_normals);
        EXPECT_GE(row.memory_peak, row.memory_held);
        // Rest, posed, and file-order positions, an order of 12 bytes and a row of 32 are the least there is.
        if (row.memory_peak > 0) {
            EXPECT_GT(row.memory_peak, row.points * (3 * 12 + 12 + 32));
        }
    }

    const json all = json::parse(growth_json(growth));
    EXPECT_EQ(all["by_points"]["rows"].size(), 2U);
    EXPECT_TRUE(all["by_samples"]["exponents"]["factorize"].is_number());
    const std::string text = growth_text(growth), picture = growth_picture(growth);
    EXPECT_NE(text.find("30,000"), std::string::npos);
    EXPECT_EQ(picture.find("nan"), std::string::npos);
    for (const Stage& stage : growth_stages()) {
        EXPECT_NE(text.find(stage.name), std::string::npos);
        EXPECT_NE(picture.find(std::string(">") + stage.name + "<"), std::string::npos);
    }
}

} // namespace
