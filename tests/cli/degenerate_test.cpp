// Clouds with next to nothing in them, and handles that hold all or nothing of them.

#include "support/run_knead.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace knead::test {
namespace {

struct Shape {
    const char* name;
    std::vector<std::string> points; // "x y z"
};

std::string line_of_points(std::size_t count) {
    std::string all;
    for (std::size_t i = 0; i < count; ++i) all += std::to_string(i) + " 0 0\n";
    return all;
}

std::vector<std::string> rows(const std::string& text) {
    std::vector<std::string> all;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) all.push_back(line);
    return all;
}

std::vector<std::string> sheet() {
    std::vector<std::string> all;
    for (int x = 0; x < 8; ++x)
        for (int y = 0; y < 8; ++y) all.push_back(std::to_string(x) + " " + std::to_string(y) + " 1");
    return all;
}

const std::vector<Shape>& shapes() {
    static const std::vector<Shape> all = {
        {"one point", {"1 2 3"}},
        {"two points", {"1 2 3", "2 2 3"}},
        {"all equal", std::vector<std::string>(50, "1 2 3")},
        {"on a line", rows(line_of_points(40))},
        {"fewer than neighbours", rows(line_of_points(5))},
        {"in a plane", sheet()},
        {"some not finite", {"nan 0 0", "0 0 0", "1 -inf 0", "1 0 0", "0 1 0", "2 0 inf", "0 0 1"}},
        {"one finite", {"nan 0 0", "0 0 0", "inf inf inf"}},
    };
    return all;
}

std::string ply(const std::vector<std::string>& points) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(points.size()) +
                       "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
    for (const std::string& point : points) text += point + "\n";
    return text;
}

bool is_finite_row(const std::string& row) {
    return row.find("nan") == std::string::npos && row.find("inf") == std::string::npos;
}

class Degenerate : public testing::Test {
protected:
    Outcome replay(const std::vector<std::string>& points, const std::string& lines,
                   const std::vector<std::string>& more = {}) {
        write_text(folder / "cloud.ply", ply(points));
        write_text(folder / "s.knead", R"({"knead":1,"cloud":{"path":"cloud.ply"}})"
                                       "\n" +
                                           lines);
        // What opens no device starts at once.
        std::vector<std::string> arguments{"replay", "s.knead", "--out", "out.ply", "--device", "reference"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_knead(arguments, folder.path());
    }

    // The rows of points that were written.
    std::vector<std::string> written() const {
        std::vector<std::string> all = rows(read_text(folder / "out.ply"));
        all.erase(all.begin(), all.begin() + 7);
        return all;
    }

    void expect_refusal(const Outcome& outcome, const std::string& words) const {
        EXPECT_EQ(outcome.code, 3) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
        const std::vector<std::string> said = rows(outcome.err);
        EXPECT_EQ(std::ranges::count_if(said, [](const auto& line) { return line.starts_with("knead: "); }),
                  1)
            << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "out.ply"));
    }

    const ScratchFolder folder;
};

const std::string all = R"({"op":"handle","name":"all","role":"moving","region":"all"})"
                        "\n";
std::string first(const std::string& role, int last = 0) {
    return R"({"op":"handle","name":"first","role":")" + role + R"(","points":[[0,)" + std::to_string(last) +
           "]]}\n";
}
std::string drag(const std::string& handle) {
    return R"({"op":"drag","handle":")" + handle +
           R"(","frames":[{},{"rotate":[0.8,0,0,0.6],"translate":[0,0,1]}]})"
           "\n";
}

TEST_F(Degenerate, InfoTellsOfEveryCloud) {
    for (const Shape& shape : shapes()) {
        SCOPED_TRACE(shape.name);
        write_text(folder / "cloud.ply", ply(shape.points));
        const Outcome table = run_knead({"info", "cloud.ply"}, folder.path());
        EXPECT_EQ(table.code, 0) << table.err;
        EXPECT_NE(table.out, "");
        const Outcome outcome = run_knead({"info", "cloud.ply", "--json"}, folder.path());
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(nlohmann::json::parse(outcome.out)["points"], shape.points.size());
    }
}

TEST_F(Degenerate, AHandleMayHoldEverythingThereIs) {
    for (const Shape& shape : shapes()) {
        SCOPED_TRACE(shape.name);
        const Outcome outcome = replay(shape.points, all + drag("all") + "{\"op\":\"commit\"}\n", {"--json"});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_LT(nlohmann::json::parse(outcome.out)["handle_error"].get<double>(), 1e-5);
        const std::vector<std::string> out = written();
        ASSERT_EQ(out.size(), shape.points.size());
        for (std::size_t i = 0; i < out.size(); ++i) {
            EXPECT_EQ(is_finite_row(out[i]), is_finite_row(shape.points[i])) << out[i];
            if (!is_finite_row(shape.points[i])) {
                EXPECT_EQ(out[i], shape.points[i]);
            }
        }
    }
}

TEST_F(Degenerate, AFixedPointAndAMovingRestBendWhatThereIs) {
    for (const Shape& shape : shapes()) {
        SCOPED_TRACE(shape.name);
        if (!is_finite_row(shape.points[0]) || shape.points.size() < 2) continue;
        const std::string last = std::to_string(shape.points.size() - 1);
        const std::string rest = R"({"op":"handle","name":"end","role":"moving","points":[)" + last + "]}\n";
        for (const char* settings : {R"({"op":"set","samples":"all"})",
                                     R"({"op":"set","samples":2,"neighbors":64,"strays":"carry"})",
                                     R"({"op":"set","neighbors":2,"strays":"bridge","weights":"paper"})"}) {
            const Outcome outcome =
                replay(shape.points, settings + std::string("\n") + first("fixed") + rest + drag("end") +
                                         "{\"op\":\"settle\",\"iterations\":20}\n");
            ASSERT_EQ(outcome.code, 0) << outcome.err;
            const std::vector<std::string> out = written();
            ASSERT_EQ(out.size(), shape.points.size());
            EXPECT_EQ(out[0], shape.points[0]) << settings;
            for (const std::string& row : out) EXPECT_TRUE(is_finite_row(row)) << row;
        }
    }
}

// Floats hold the points, but not what a pose makes of them.
TEST_F(Degenerate, ACloudOfAbsurdSizeOpensAndIsNotBent) {
    for (const auto& points : {std::vector<std::string>{"-1e30 0 0", "0 0 0", "1e30 0 0", "0 1e30 0"},
                               {"0 0 0", "1e-30 0 0", "0 1e-30 0", "0 0 1e-30"}}) {
        expect_refusal(replay(points, all + drag("all")), "s.knead:3: \"frames\": frame");
        EXPECT_EQ(run_knead({"info", "cloud.ply"}, folder.path()).code, 0);
        ASSERT_EQ(replay(points, all).code, 0);
        EXPECT_EQ(written(), points);
        std::filesystem::remove(folder / "out.ply");
    }
}

TEST_F(Degenerate, ACloudWithoutAFinitePointIsRefused) {
    for (const auto& points : {std::vector<std::string>{}, {"nan nan nan"}, {"0 0 inf", "nan 1 1"}})
        expect_refusal(replay(points, all + drag("all")),
                       "cloud.ply: holds no point with finite coordinates");
}

TEST_F(Degenerate, InfoTellsOfACloudWithoutAFinitePoint) {
    for (const auto& points : {std::vector<std::string>{}, {"nan nan nan"}, {"0 0 inf", "nan 1 1"}}) {
        write_text(folder / "cloud.ply", ply(points));
        const Outcome outcome = run_knead({"info", "cloud.ply", "--json"}, folder.path());
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(nlohmann::json::parse(outcome.out)["points"], points.size());
    }
}

TEST_F(Degenerate, AHandleThatHoldsNothingIsRefused) {
    const std::vector<std::string> points{"0 0 0", "nan 0 0", "1 0 0"};
    const auto handle = [](const std::string& which) {
        return R"({"op":"handle","name":"none","role":"moving",)" + which + "}\n";
    };
    const std::string far = handle(R"("region":{"sphere":{"center":[9,9,9],"radius":1}})");
    expect_refusal(replay(points, far + drag("none")), "s.knead:2");
    expect_refusal(replay(points, handle(R"("points":[])") + drag("none")), "s.knead:2");
    expect_refusal(replay(points, handle(R"("points":[1])") + drag("none")), "s.knead:2");
    expect_refusal(replay(points, handle(R"("points":[3])") + drag("none")), "s.knead:2");
}

TEST_F(Degenerate, WhatAnotherHandleTookAwayLeavesOneThatHoldsNothing) {
    const std::vector<std::string> points{"0 0 0", "1 0 0", "2 0 0"};
    const Outcome outcome = replay(points, first("moving", 2) + all + drag("first"));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(written(), points) << "the later handle holds them all, and was not dragged";
}

} // namespace
} // namespace knead::test
