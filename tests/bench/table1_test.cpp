#include "bench/table1.h"

#include "base/error.h"
#include "bench/automatic_handles.h"
#include "bench/made_cloud.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {

using namespace knead;
using nlohmann::json;

// A table of one row on a small made cloud.
Table1 tiny_table() {
    Workers workers(2);
    SilentProgress progress;
    Table1Options options;
    options.repeats = 2;
    options.threads = 2;
    const PointCloud cloud = made_cloud(Shape::sphere, 2000, workers, progress);
    Table1 table;
    table.machine = this_machine();
    table.threads = 2;
    table.device = "a device";
    table.repeats = 2;
    Table1Result result;
    result.row = table1_rows()[1];
    result.figures = measure_row(cloud, 100, options, workers, progress, table.warnings);
    table.results.push_back(result);
    return table;
}

TEST(Table1, HasSevenRowsAndKnowsFiveOfThePapers) {
    ASSERT_EQ(table1_rows().size(), 7U);
    std::size_t known = 0;
    for (const Table1Row& row : table1_rows()) known += row.paper.set_up ? 1 : 0;
    EXPECT_EQ(known, 5U);
}

TEST(Table1, FindsRowsByModelAndByName) {
    EXPECT_EQ(rows_named({}).size(), 7U);
    const std::vector<std::string> names{"dragon/200", "bunny"};
    const std::vector<Table1Row> rows = rows_named(names);
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(name_of(rows[0]), "bunny/100");
    EXPECT_EQ(name_of(rows[2]), "dragon/200");
    const std::vector<std::string> unknown{"teapot"};
    try {
        rows_named(unknown);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.trouble(), Trouble::usage);
    }
}

TEST(Table1, MeasuresEveryColumn) {
    const Table1 table = tiny_table();
    const RowFigures& row = table.results[0].figures;
    EXPECT_EQ(row.points, 2000U);
    EXPECT_EQ(row.vertices, 2000U);
    EXPECT_GE(row.samples, 100U);
    EXPECT_LE(row.samples, 120U);
    for (const Summary& stage :
         {row.order, row.neighbors, row.sampling, row.geodesic, row.set_up, row.factorize}) {
        EXPECT_EQ(stage.count, 2U);
        EXPECT_GT(stage.lowest, 0);
        EXPECT_LE(stage.lowest, stage.median);
        EXPECT_LE(stage.median, stage.highest);
    }
    EXPECT_EQ(row.upsample.count, 30U);
    EXPECT_EQ(row.solve.count, 90U);
    EXPECT_TRUE(row.upsampling.with_normals);
    // Positions and normals in and out, what moves it, and a narrow row of influences for each point.
    // Rest shape and result, and of every sixteen points at least one entry and at most all of their places.
    EXPECT_GE(row.upsampling.bytes, 2000U * 4 * 12 + 2000U / 16 * (8 + 36));
    EXPECT_LE(row.upsampling.bytes, 2000U * 4 * 12 + 2000U / 16 * (8 + 128 * 36));
    EXPECT_LT(row.upsampling.largest_difference, 1e-5);
}

TEST(Table1, SaysAllOfItInBothForms) {
    const Table1 table = tiny_table();
    const std::string text = table1_text(table);
    EXPECT_NE(text.find("bunny/1000"), std::string::npos);
    EXPECT_NE(text.find("\n  faster by"), std::string::npos);
    const json told = json::parse(table1_json(table));
    const json& row = told.at("rows").at(0);
    EXPECT_EQ(row.at("row"), "bunny/1000");
    EXPECT_TRUE(row.at("missing").is_null());
    EXPECT_EQ(row.at("paper_seconds").at("set_up"), 0.5);
    EXPECT_GT(row.at("seconds").at("geodesic").at("median").get<double>(), 0);
    EXPECT_GT(row.at("factor_over_paper").at("factorize").get<double>(), 0);
    EXPECT_TRUE(row.at("holds").at("solve").is_null()); // the bunny has no floor
    EXPECT_FALSE(told.at("processor").get<std::string>().empty());
    EXPECT_FALSE(told.at("commit").get<std::string>().empty());
}

TEST(Table1, NeverInventsAFigureOfThePaper) {
    Table1 table = tiny_table();
    table.results[0].row = table1_rows()[0];
    EXPECT_EQ(table1_text(table).find("\n  faster by"), std::string::npos);
    const json row = json::parse(table1_json(table)).at("rows").at(0);
    EXPECT_TRUE(row.at("paper_seconds").at("upsample").is_null());
    EXPECT_TRUE(row.at("factor_over_paper").at("upsample").is_null());
}

TEST(Table1, HoldsFloorsAgainstFactors) {
    Table1 table;
    Table1Result result;
    result.row = table1_rows()[5]; // dragon/5000
    for (const double solve : {0.116 / 31, 0.116 / 29}) {
        result.figures.solve.median = solve;
        table.results.push_back(result);
    }
    const json rows = json::parse(table1_json(table)).at("rows");
    EXPECT_EQ(rows[0].at("holds").at("solve"), true);
    EXPECT_EQ(rows[1].at("holds").at("solve"), false);
    EXPECT_NE(table1_text(table).find("FAIL"), std::string::npos);
}

TEST(AutomaticHandles, SitAtTheEndsOfTheLongestSide) {
    Workers workers(2);
    SilentProgress progress;
    const PointCloud cloud = made_cloud(Shape::bar, 3000, workers, progress);
    const AutomaticHandles handles = automatic_handles(cloud);
    ASSERT_FALSE(handles.fixed.empty());
    ASSERT_FALSE(handles.moving.empty());
    for (const Index i : handles.fixed) EXPECT_LT(cloud.file_position(i).z(), -1.7);
    for (const Index i : handles.moving) EXPECT_GT(cloud.file_position(i).z(), 1.7);
    EXPECT_EQ(handles.axis.z(), 0);
}

TEST(AutomaticHandles, HoldAllOfAPointlikeCloud) {
    const std::vector<float> positions{1, 2, 3, 1, 2, 3};
    const AutomaticHandles handles = automatic_handles(make_cloud(positions));
    EXPECT_EQ(handles.fixed.size(), 2U);
    EXPECT_EQ(handles.moving.size(), 2U);
}

TEST(HandleLine, WritesRunsAsRanges) {
    const HandleLine line = handle_line("a", HandleRole::fixed, {1, 2, 3, 7});
    const auto& ranges = std::get<std::vector<IndexRange>>(line.points);
    ASSERT_EQ(ranges.size(), 2U);
    EXPECT_EQ(ranges[0].first, 1U);
    EXPECT_EQ(ranges[0].last, 3U);
    EXPECT_EQ(ranges[1].first, 7U);
    EXPECT_EQ(ranges[1].last, 7U);
}

} // namespace
