#include "bench/drag_speed.h"

#include "bench/made_cloud.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {

using namespace knead;

TEST(DragSpeed, FewSamplesComeToTheSameRest) {
    Workers workers(2);
    SilentProgress progress;
    Table1Options options;
    options.device = "reference";
    const std::uint64_t samples[] = {2000, 1'000'000};
    const DragSpeeds speeds =
        measure_drags("a bar", made_cloud(Shape::bar, 8000, workers, progress), samples, options, progress);
    ASSERT_EQ(speeds.rows.size(), 1U) << "of more samples than points there is none";
    const DragSpeed& row = speeds.rows[0];
    EXPECT_GE(row.samples, 2000U);
    for (const DraggedWay& way : {row.full, row.coarse}) {
        EXPECT_EQ(way.frame.count, 29U);
        EXPECT_GT(way.last_step.largest, 0);
    }
    EXPECT_GT(row.coarse.first_at_rest.rms, row.full.first_at_rest.rms) << "they are not all of them";
    EXPECT_LT(row.coarse.to_rest.rms, row.coarse.last_step.rms) << "no jump";
    EXPECT_LT(row.apart.largest, 1e-3);

    EXPECT_EQ(speeds.region.points, 400U); // 5 %
    for (const RegionSpeed::Frames& way : {speeds.region.whole, speeds.region.region}) {
        EXPECT_GE(way.samples, 2000U);
        EXPECT_EQ(way.upsample.count, 39U);
        EXPECT_GT(way.frame.median, way.upsample.median);
    }

    const auto json = nlohmann::json::parse(drag_speeds_json(speeds));
    EXPECT_EQ(json["rows"][0]["coarse"]["last_step"]["rms"].get<double>(), row.coarse.last_step.rms);
    EXPECT_EQ(json["region"]["with"]["upsample_seconds"]["median"].get<double>(),
              speeds.region.region.upsample.median);
    EXPECT_NE(drag_speeds_text(speeds).find("8,000 points"), std::string::npos);
}

} // namespace
