// `knead bench` from outside.

#include "support/run_knead.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>

namespace {

using knead::test::Outcome;
using knead::test::run_knead;
using knead::test::ScratchFolder;
using nlohmann::json;

TEST(Bench, ReportsAMissingScanInItsRow) {
    const ScratchFolder empty;
    const Outcome outcome = run_knead({"bench", "--json", "--scans", empty.path().string(), "bunny"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json told = json::parse(outcome.out);
    ASSERT_EQ(told.at("rows").size(), 2U);
    for (const json& row : told.at("rows"))
        EXPECT_EQ(row.at("missing").get<std::string>(), "no bunny.ply in " + empty.path().string());
    EXPECT_GT(told.at("copy_gigabytes_per_second").get<double>(), 0);
}

TEST(Bench, SaysTheSameInWords) {
    const ScratchFolder empty;
    const Outcome outcome = run_knead({"bench", "--scans", empty.path().string(), "dragon/200"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("dragon/200  not run: no dragon.ply in"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("bunny"), std::string::npos);
}

TEST(Bench, RefusesAScanThatCannotBeRead) {
    const ScratchFolder folder;
    knead::test::write_text(folder / "bunny.ply", "no cloud");
    const Outcome outcome = run_knead({"bench", "--scans", folder.path().string(), "bunny"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_TRUE(outcome.out.empty());
    EXPECT_NE(outcome.err.find("bunny.ply"), std::string::npos) << outcome.err;
}

TEST(Bench, RefusesWrongUsage) {
    const std::vector<std::vector<std::string>> wrong = {
        {"bench", "teapot"},
        {"bench", "--files", ".", "bunny"},
        {"bench", "--growth", "10000", "bunny"},
        {"bench", "--growth", "9999"},
        {"bench", "--growth", "10000", "--scans", "."},
        {"bench", "--files", ".", "--device", "reference"},
        {"bench", "--picture", "growth.svg"},
        {"bench", "--handles", "99999"},
        {"bench", "--handles", "100000", "--growth", "10000"},
        {"bench", "--files", ".", "--window", "cloud.ply"},
        {"bench", "--repeat", "0", "bunny"},
        {"bench", "--threads", "0", "bunny"},
        {"bench", "--device", "no such device", "bunny"},
        {"bench", "--scans", "/nonexistent", "bunny"},
        {"bench", "--colour"},
    };
    for (const auto& arguments : wrong) {
        const Outcome outcome = run_knead(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments[1] << ": " << outcome.err;
        EXPECT_TRUE(outcome.out.empty());
        EXPECT_FALSE(outcome.err.empty());
    }
}

} // namespace
