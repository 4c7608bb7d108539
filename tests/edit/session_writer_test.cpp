// Writing sessions: every line reads back to the last bit of every number.

#include "base/error.h"
#include "edit/same_session.h"
#include "edit/session.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace knead {
namespace {

using test::same;

// --- Random lines

class RandomLines {
public:
    std::uint64_t below(std::uint64_t end) { return random_() % end; }
    bool coin() { return below(2) == 0; }

    // Any finite double, the special ones often.
    double number() {
        using Limits = std::numeric_limits<double>;
        static constexpr std::array special{0.0,
                                            -0.0,
                                            1.0,
                                            -1.0,
                                            Limits::max(),
                                            Limits::lowest(),
                                            Limits::min(),
                                            Limits::denorm_min(),
                                            Limits::epsilon(),
                                            0.1,
                                            1e15,
                                            1e22,
                                            9007199254740993.0,
                                            1.8e19,
                                            18446744073709551616.0};
        if (below(4) == 0) return special.at(below(special.size()));
        if (coin()) return static_cast<double>(below(2001)) / 1000 - 1;
        const auto any = std::bit_cast<double>(random_());
        return std::isfinite(any) ? any : 2.5;
    }
    double positive() {
        const double value = std::abs(number());
        return value == 0 ? 1 : value;
    }
    Vec3d vector() { return {number(), number(), number()}; }
    // What a reader takes for a direction: its length can be divided by.
    Vec3d direction() {
        Vec3d result;
        do result = vector();
        while (!std::isnormal(result.squaredNorm()));
        return result;
    }
    Quatd quaternion() {
        Quatd result;
        do result = Quatd(number(), number(), number(), number());
        while (!std::isnormal(result.squaredNorm()));
        return result;
    }
    std::string name() {
        static const std::array<std::string, 6> names{
            "ear", "\"quoted\\\"", "line\nbreak", "größe ✓ 🦎", std::string("zero\0in", 7), " "};
        return names.at(below(names.size())) + std::to_string(below(10));
    }

    HandlePose pose() {
        HandlePose result;
        if (coin()) result.translate = vector();
        if (coin()) result.rotate = quaternion();
        if (coin()) result.scale = Vec3d(positive(), positive(), positive());
        if (below(3) == 0) result.scale.setConstant(positive());
        if (coin()) result.axes = quaternion();
        result.coarse = coin();
        return result;
    }

    Region region() {
        switch (below(4)) {
        case 0: {
            const Vec3d a = vector();
            const Vec3d b = vector();
            return BoxRegion{a.cwiseMin(b), a.cwiseMax(b)};
        }
        case 1:
            return SphereRegion{vector(), std::abs(number())};
        case 2:
            return HalfspaceRegion{vector(), direction()};
        default:
            return WholeRegion{};
        }
    }

    HandleLine handle() {
        HandleLine line;
        line.name = name();
        line.role =
            std::array{HandleRole::fixed, HandleRole::moving, HandleRole::region_of_interest}.at(below(3));
        if (coin()) line.color = static_cast<std::uint32_t>(below(0x1000000));
        if (coin()) line.pivot = vector();
        if (line.role != HandleRole::region_of_interest) {
            line.free_rotation = coin();
            if (coin()) line.falloff = std::abs(number());
        }
        if (coin()) {
            line.points = region();
            return line;
        }
        std::vector<IndexRange> ranges(1 + below(5));
        for (IndexRange& range : ranges) {
            range.first = below((std::uint64_t{1} << 53) - 10);
            range.last = range.first + (coin() ? 0 : below(10));
        }
        line.points = ranges;
        return line;
    }

    DragLine drag() {
        DragLine line{name(), vector(), {}};
        for (std::size_t more = below(3); more > 0; --more) {
            line.with.push_back({name() + std::to_string(more)});
            if (coin()) line.with.back().mirror = {direction(), vector()};
        }
        line.frames.resize(1 + below(4));
        for (HandlePose& frame : line.frames) frame = pose();
        return line;
    }

    SetLine set() {
        SettingsChange change;
        change.neighbors = static_cast<unsigned>(2 + below(63));
        if (coin())
            change.samples = coin() ? std::optional<std::uint64_t>() : std::optional(1 + below(1'000'000));
        if (coin()) change.iterations = static_cast<unsigned>(below(1001));
        if (coin()) change.stiffness = positive();
        if (coin()) change.poisson = coin() ? 0 : static_cast<double>(below(149)) / 100 - 0.99;
        if (coin()) change.weights = coin() ? InfluenceWeights::smooth : InfluenceWeights::paper;
        if (coin()) change.strays = std::array{Strays::freeze, Strays::carry, Strays::bridge}[below(3)];
        return {change};
    }

    SessionAction action() {
        switch (below(10)) {
        case 0:
            return handle();
        case 1:
            return drag();
        case 2:
            return SettleLine{static_cast<unsigned>(below(1'000'001))};
        case 3:
            return CheckLine{"päth/" + std::to_string(below(100)) + ".ply", std::abs(number())};
        case 4:
            return CommitLine{};
        case 5:
            return set();
        case 6:
            return DeleteLine{name()};
        case 7:
            return RenameLine{name(), name()};
        case 8:
            return UndoLine{};
        default:
            return RedoLine{};
        }
    }

private:
    std::mt19937_64 random_{20240229};
};

Session session_of_a_cloud() {
    Session session;
    session.cloud = "a.ply";
    return session;
}

Session read_back(const Session& session, const std::vector<std::string>& lines) {
    std::string text = header_text(session) + '\n';
    for (const std::string& line : lines) text += line + '\n';
    return parse_session(text, "wave.knead");
}

// --- The tests

TEST(SessionWriter, EveryLineReadsBack) {
    RandomLines random;
    std::vector<SessionAction> actions;
    std::vector<std::string> texts;
    for (int i = 0; i < 20'000; ++i) {
        actions.push_back(random.action());
        texts.push_back(to_text(actions.back()));
    }
    const Session session = read_back(session_of_a_cloud(), texts);
    ASSERT_EQ(session.lines.size(), actions.size());
    for (std::size_t i = 0; i < actions.size(); ++i) {
        ASSERT_TRUE(same(actions[i], session.lines[i].action)) << texts[i];
        ASSERT_EQ(session.lines[i].text, texts[i]);
        ASSERT_EQ(to_text(session.lines[i].action), texts[i]);
    }
}

TEST(SessionWriter, HeadersReadBack) {
    Session session;
    session.cloud = "scans/größe \"1\".ply";
    EXPECT_EQ(read_back(session, {}).cloud, session.cloud);
    EXPECT_EQ(read_back(session, {}).settings, session.settings);
    EXPECT_FALSE(read_back(session, {}).points.has_value());

    session.points = 35947;
    session.sha256 = std::string(64, 'f');
    session.settings = {8, std::nullopt, 0, 0.1, 0.0, InfluenceWeights::paper, Strays::freeze};
    const Session back = read_back(session, {});
    EXPECT_EQ(back.points, session.points);
    EXPECT_EQ(back.sha256, session.sha256);
    EXPECT_EQ(back.settings, session.settings);
    EXPECT_EQ(header_text(back), header_text(session));
}

TEST(SessionWriter, IsCompact) {
    DragLine drag{"ear", Vec3d(-0.07, 0.15, 0), {HandlePose{}, HandlePose{}, HandlePose{}}};
    drag.frames[1].translate.y() = 0.001;
    drag.frames[2].scale.setConstant(2);
    EXPECT_EQ(to_text(drag), R"({"op":"drag","handle":"ear","pivot":[-0.07,0.15,0],)"
                             R"("frames":[{},{"translate":[0,0.001,0]},{"scale":2}]})");
    HandleLine handle{"feet", HandleRole::fixed, std::vector<IndexRange>{{0, 411}, {987, 987}}};
    EXPECT_EQ(to_text(handle), R"({"op":"handle","name":"feet","role":"fixed","points":[[0,411],987]})");
    handle.color = 0x0faab1;
    EXPECT_EQ(to_text(handle), R"({"op":"handle","name":"feet","role":"fixed","points":[[0,411],987],)"
                               R"("color":"#0faab1"})");
    handle.color.reset();
    handle.pivot = Vec3d(1, 0, -0.5);
    EXPECT_EQ(to_text(handle), R"({"op":"handle","name":"feet","role":"fixed","points":[[0,411],987],)"
                               R"("pivot":[1,0,-0.5]})");
    EXPECT_EQ(to_text(CommitLine{}), R"({"op":"commit"})");
    EXPECT_EQ(
        header_text(session_of_a_cloud()),
        R"({"knead":1,"cloud":{"path":"a.ply"},"settings":{"neighbors":6,"samples":1000,"iterations":3,)"
        R"("stiffness":0.01,"poisson":0,"weights":"smooth","strays":"freeze"}})");
}

TEST(SessionWriter, KeepsTheSignOfZeros) {
    DragLine drag{"ear", Vec3d::Zero(), {HandlePose{}}};
    drag.frames[0].translate.x() = -0.0;
    drag.frames[0].rotate.y() = -0.0;
    const Session back = read_back(session_of_a_cloud(), {to_text(drag)});
    EXPECT_TRUE(same(back.lines.at(0).action, drag)) << back.lines.at(0).text;
}

TEST(SessionWriter, RefusesAPathThatJsonCannotHold) {
    EXPECT_THROW(to_text(CheckLine{"caf\xE9.ply", 0}), Error);
}

} // namespace
} // namespace knead
