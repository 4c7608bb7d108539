#include "bench/handle_timing.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {

using namespace knead;
using nlohmann::json;

TEST(HandleTiming, MeasuresEveryStage) {
    Table1Options options;
    options.repeats = 1;
    options.threads = 2;
    options.device = "reference";
    SilentProgress progress;
    const HandleTiming timing = measure_handle_timing(100'000, options, progress);
    // Few samples and more, a handle at the end and at the beginning, and where little is free.
    ASSERT_EQ(timing.rows.size(), 6U);
    EXPECT_TRUE(timing.rows[4].is_first);
    EXPECT_TRUE(timing.rows[5].is_in_disc);
    for (const HandleTimingRow& row : std::span(timing.rows).last(3)) {
        EXPECT_GT(row.samples, 5000U);
        EXPECT_LE(row.samples, 6003U); // a fifth more, and one a handle
    }
    const HandleTimingRow& row = timing.rows.front();
    EXPECT_FALSE(row.is_first);
    EXPECT_EQ(row.points, 100'000U);
    EXPECT_GT(row.samples, 1000U);
    EXPECT_LE(row.samples, 1203U);
    EXPECT_GT(row.in_handle, 100U);
    double stages = 0;
    for (const Summary& stage : {row.sampling, row.geodesic, row.factorize, row.device, row.frame}) {
        EXPECT_EQ(stage.count, 2U); // once coming, once going
        EXPECT_GT(stage.lowest, 0);
        stages += stage.lowest;
    }
    EXPECT_GE(row.live.highest, stages);

    const json all = json::parse(handle_timing_json(timing));
    EXPECT_EQ(all["rows"][0]["points"], 100'000);
    EXPECT_EQ(all["rows"][1]["place"], "first");
    EXPECT_EQ(all["rows"][0]["seconds"]["live"]["median"], row.live.median);
    const std::string text = handle_timing_text(timing);
    for (const char* words : {"100,000", "geodesic", "live again"})
        EXPECT_NE(text.find(words), std::string::npos) << words;
}

} // namespace
