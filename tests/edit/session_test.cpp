// Reading sessions: what is accepted, and what each refusal says.

#include "base/error.h"
#include "edit/session.h"
#include "support/comparing.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <chrono>

namespace knead {
namespace {

using test::ScratchFolder;

constexpr const char* header = R"({"knead":1,"cloud":{"path":"a.ply"}})";

// A session of these lines after a plain header.
Session session_of(const std::string& lines) {
    return parse_session(std::string(header) + '\n' + lines + '\n', "dir/wave.knead");
}

template<typename Line>
Line line_of(const std::string& text) {
    return std::get<Line>(session_of(text).lines.at(0).action);
}

std::string refusal_of_session(const std::string& text) {
    try {
        parse_session(text, "dir/wave.knead");
    } catch (const Error& error) {
        EXPECT_EQ(error.trouble(), Trouble::input);
        return error.what();
    }
    return "accepted";
}

// What a line after a plain header is refused with, after its place.
std::string refusal(const std::string& line) {
    std::string words = refusal_of_session(std::string(header) + '\n' + line + '\n');
    const std::string place = "dir/wave.knead:2: ";
    if (words.starts_with(place)) words.erase(0, place.size());
    return words;
}

// --- What is accepted

TEST(Session, ReadsEveryKindOfLine) {
    const Session session = session_of(R"({"op":"handle","name":"feet","role":"fixed","points":[[0,411],987]}
{"op":"handle","name":"ear","role":"moving","region":{"sphere":{"center":[-0.07,0.17,0.0],"radius":0.02}}}
{"op":"drag","handle":"ear","pivot":[-0.07,0.15,0.0],"frames":[{"translate":[0,0.001,0],"rotate":[1,0,0,0],"scale":1}]}
{"op":"settle","iterations":20}
{"op":"check","positions":"posed.ply","tolerance":1e-4}
{"op":"commit"}
{"op":"set","samples":"all","weights":"paper"}
{"op":"rename","handle":"ear","to":"tip"}
{"op":"delete","handle":"tip"}
{"op":"undo"}
{"op":"redo"})");
    ASSERT_EQ(session.lines.size(), 11U);
    for (std::size_t i = 0; i < session.lines.size(); ++i) EXPECT_EQ(session.lines[i].number, i + 2);
    EXPECT_EQ(session.header_text, header);
    EXPECT_EQ(session.lines[5].text, R"({"op":"commit"})");

    const auto& feet = std::get<HandleLine>(session.lines[0].action);
    EXPECT_EQ(feet.role, HandleRole::fixed);
    const auto& points = std::get<std::vector<IndexRange>>(feet.points);
    ASSERT_EQ(points.size(), 2U);
    EXPECT_EQ(points[0].last, 411U);
    EXPECT_EQ(points[1].first, 987U);
    EXPECT_EQ(points[1].last, 987U);

    const auto& drag = std::get<DragLine>(session.lines[2].action);
    EXPECT_EQ(drag.pivot, Vec3d(-0.07, 0.15, 0));
    ASSERT_EQ(drag.frames.size(), 1U);
    EXPECT_EQ(drag.frames[0].translate.y(), 0.001);
    EXPECT_EQ(std::get<SettleLine>(session.lines[3].action).iterations, 20U);
    EXPECT_EQ(std::get<CheckLine>(session.lines[4].action).positions, "posed.ply");
    const SettingsChange& change = std::get<SetLine>(session.lines[6].action).change;
    ASSERT_TRUE(change.samples.has_value());
    EXPECT_FALSE(change.samples->has_value());
    EXPECT_EQ(change.weights, InfluenceWeights::paper);
    EXPECT_FALSE(change.neighbors.has_value());
    EXPECT_EQ(std::get<RenameLine>(session.lines[7].action).to, "tip");
}

TEST(Session, ReadsTheHeader) {
    const std::string digest(64, 'A');
    const Session session =
        parse_session(R"({"knead":1,"cloud":{"path":"scans/a b.ply","points":7,"sha256":")" + digest +
                          R"("},"settings":{"neighbors":8,"samples":"all","stiffness":1}})",
                      "dir/wave.knead");
    EXPECT_EQ(session.cloud, "scans/a b.ply");
    EXPECT_EQ(session.points, 7U);
    EXPECT_EQ(session.sha256, std::string(64, 'a'));
    EXPECT_EQ(session.settings.neighbors, 8U);
    EXPECT_FALSE(session.settings.samples.has_value());
    EXPECT_EQ(session.settings.stiffness, 1.0);
    EXPECT_EQ(session.settings.iterations, 3U);
    EXPECT_TRUE(session.lines.empty());
}

TEST(Session, LeavesOutMeansDefaults) {
    const Session session = parse_session(header, "wave.knead");
    EXPECT_EQ(session.settings, Settings{});
    EXPECT_FALSE(session.points.has_value());
    EXPECT_FALSE(session.sha256.has_value());

    const auto drag = line_of<DragLine>(R"({"op":"drag","handle":"a","frames":[{}]})");
    EXPECT_EQ(drag.pivot, Vec3d::Zero());
    EXPECT_EQ(drag.frames.at(0).rotate.coeffs(), Quatd::Identity().coeffs());
    EXPECT_EQ(drag.frames.at(0).scale, Vec3d::Ones());
}

TEST(Session, ReadsTheColorOfAHandle) {
    const std::string handle = R"({"op":"handle","name":"a","role":"roi","points":[1])";
    EXPECT_FALSE(line_of<HandleLine>(handle + "}").color.has_value());
    EXPECT_EQ(line_of<HandleLine>(handle + R"(,"color":"#0Faab1"})").color, 0x0faab1U);
    EXPECT_FALSE(line_of<HandleLine>(handle + "}").pivot.has_value());
    EXPECT_EQ(line_of<HandleLine>(handle + R"(,"pivot":[1,-2,0.5]})").pivot, Vec3d(1, -2, 0.5));
}

TEST(Session, ReadsEveryRegion) {
    const auto region = [](const std::string& text) {
        return std::get<Region>(
            line_of<HandleLine>(R"({"op":"handle","name":"a","role":"roi","region":)" + text + "}").points);
    };
    EXPECT_EQ(std::get<BoxRegion>(region(R"({"box":{"min":[0,1,2],"max":[0,5,6]}})")).highest,
              Vec3d(0, 5, 6));
    EXPECT_EQ(std::get<SphereRegion>(region(R"({"sphere":{"center":[0,1,2],"radius":0}})")).center,
              Vec3d(0, 1, 2));
    EXPECT_EQ(
        std::get<HalfspaceRegion>(region(R"({"halfspace":{"point":[1,2,3],"normal":[0,0,-2]}})")).normal,
        Vec3d(0, 0, -2));
    EXPECT_TRUE(std::holds_alternative<WholeRegion>(region("\"all\"")));
}

TEST(Session, KeepsRotationsAsWrittenAndTakesScalesOfBothKinds) {
    const auto drag = line_of<DragLine>(
        R"({"op":"drag","handle":"a","frames":[{"rotate":[-2,0,0,1],"scale":0.5},{"scale":[1,2,3],"axes":[0,3,0,0]}]})");
    EXPECT_EQ(drag.frames.at(0).rotate.w(), -2);
    EXPECT_EQ(drag.frames.at(0).scale, Vec3d(0.5, 0.5, 0.5));
    EXPECT_EQ(drag.frames.at(1).scale, Vec3d(1, 2, 3));
    EXPECT_EQ(drag.frames.at(1).axes.x(), 3);
}

TEST(Session, AcceptsTheBoundsOfEveryRange) {
    for (const char* line :
         {R"({"op":"set","neighbors":2})", R"({"op":"set","neighbors":64})", R"({"op":"set","samples":1})",
          R"({"op":"set","iterations":0})", R"({"op":"set","iterations":1000})",
          R"({"op":"set","poisson":0.0})", R"({"op":"set","stiffness":1e-300})",
          R"({"op":"set","strays":"freeze"})", R"({"op":"set","strays":"carry"})",
          R"({"op":"set","strays":"bridge"})", R"({"op":"settle","iterations":0})",
          R"({"op":"settle","iterations":1000000})", R"({"op":"check","positions":"a","tolerance":0})",
          R"({"op":"handle","name":"a","role":"roi","points":[9007199254740992]})",
          R"({"op":"handle","name":"a","role":"roi","points":[[3,3]],"rotation":"held","falloff":0})"})
        EXPECT_EQ(refusal(line), "accepted") << line;
}

TEST(Session, TakesAnyEndOfLineAndSkipsBlanks) {
    const Session session = parse_session(std::string("\xEF\xBB\xBF") + header +
                                              "\r\n\r\n  \n{\"op\":\"commit\"}\r\n{\"op\":\"undo\"}",
                                          "wave.knead");
    EXPECT_EQ(session.header_text, header);
    ASSERT_EQ(session.lines.size(), 2U);
    EXPECT_EQ(session.lines[0].number, 4U);
    EXPECT_EQ(session.lines[0].text, R"({"op":"commit"})");
    EXPECT_EQ(session.lines[1].number, 5U);
}

TEST(Session, PathsAreRelativeToTheSessionFile) {
    const Session session = session_of("");
    EXPECT_EQ(session.place(3), "dir/wave.knead:3");
    EXPECT_EQ(session.resolve("a.ply"), "dir/a.ply");
    EXPECT_EQ(session.resolve("/tmp/a.ply"), "/tmp/a.ply");
    EXPECT_EQ(parse_session(header, "wave.knead").resolve("a.ply"), "a.ply");
}

TEST(Session, IsReadFromAFile) {
    const ScratchFolder folder;
    test::write_text(folder / "s.knead", std::string(header) + "\n{\"op\":\"commit\"}\n");
    const Session session = read_session(folder / "s.knead");
    EXPECT_EQ(session.lines.size(), 1U);
    EXPECT_EQ(session.file, folder / "s.knead");
    EXPECT_THROW(read_session(folder / "missing.knead"), Error);
}

// --- What is refused

TEST(SessionRefuses, WhatIsNoSession) {
    EXPECT_SAYS(refusal_of_session(""), "dir/wave.knead: is empty");
    EXPECT_SAYS(refusal_of_session("\n \n"), "is empty");
    for (const char* text :
         {"ply\nformat ascii 1.0\n", "{\"op\":\"commit\"}\n", "[1]\n", "1\n", "{}\n", "\"knead\"\n"})
        EXPECT_SAYS(refusal_of_session(text),
                    "dir/wave.knead:1: is not a knead session: the first line must be");
    EXPECT_SAYS(refusal_of_session(R"({"knead":1,"cloud":{"path":"a.p)"),
                "dir/wave.knead:1: not JSON at byte ");
}

TEST(SessionRefuses, OtherVersions) {
    EXPECT_SAYS(
        refusal_of_session(R"({"knead":2,"clouds":[]})"),
        "\"knead\" is 2: this session was written by a newer knead; version 1 is what this one reads");
    for (const char* version : {"0", "-1", "1.0", "\"1\"", "null"})
        EXPECT_SAYS(refusal_of_session(std::string("{\"knead\":") + version + "}"),
                    "\"knead\" must be a whole number, 1 or more");
}

TEST(SessionRefuses, BrokenHeaders) {
    const auto with = [](const std::string& rest) {
        return refusal_of_session("{\"knead\":1," + rest + "}\n");
    };
    EXPECT_SAYS(with(R"("cloud":{"path":"a"},"op":"commit")"), "the line has an unknown key \"op\"");
    EXPECT_SAYS(with(R"("settings":{})"), "the line has no \"cloud\"");
    EXPECT_SAYS(with(R"("cloud":"a.ply")"), "\"cloud\" must be a JSON object, not \"a.ply\"");
    EXPECT_SAYS(with(R"("cloud":{})"), "\"cloud\" has no \"path\"");
    EXPECT_SAYS(with(R"("cloud":{"path":""})"), "\"cloud.path\" must not be empty");
    EXPECT_SAYS(with(R"("cloud":{"path":"a\u0000b"})"), "\"cloud.path\" holds a zero character");
    EXPECT_SAYS(with(R"("cloud":{"path":"a","points":1.5})"), "\"cloud.points\" must be a whole number");
    EXPECT_SAYS(with(R"("cloud":{"path":"a","sha256":"abc"})"),
                "\"cloud.sha256\" must be 64 hexadecimal digits");
    EXPECT_SAYS(with(R"("cloud":{"path":"a","size":3})"),
                "\"cloud\" has an unknown key \"size\"; what it may have: path, points, sha256");
    EXPECT_SAYS(with(R"("cloud":{"path":"a"},"settings":{"op":1})"),
                "\"settings\" has an unknown key \"op\"");
    EXPECT_SAYS(with(R"("cloud":{"path":"a"},"settings":{"neighbors":1})"), "\"settings.neighbors\" must be");
}

TEST(SessionRefuses, WhatIsNoJson) {
    EXPECT_SAYS(refusal("hello"), "not JSON at byte 1, after 'h': invalid literal");
    EXPECT_SAYS(refusal(R"({"op":"commit",})"), "not JSON at byte ");
    EXPECT_SAYS(refusal(R"({"op":"commit"} {"op":"commit"})"), "at byte 17");
    EXPECT_SAYS(refusal(R"({"op":"settle","iterations":NaN})"), "not JSON at byte ");
    EXPECT_SAYS(refusal("{\"op\":\"delete\",\"handle\":\"\xFF\"}"), "not JSON at byte ");
    EXPECT_SAYS(refusal(R"({"op":"check","positions":"a","tolerance":1e999})"),
                "the number 1e999 is too large");
    EXPECT_SAYS(refusal(std::string("{\"op\":\"commit\"}\0x", 17)), "not JSON at byte 16: a zero byte");
    EXPECT_SAYS(refusal("7"), "the line must be a JSON object, not 7");
    EXPECT_SAYS(refusal("[{}]"), "the line must be a JSON object, not a list of 1");
}

TEST(SessionRefuses, KeysGivenTwice) {
    EXPECT_SAYS(refusal(R"({"op":"commit","op":"commit"})"), "\"op\" is given twice");
    EXPECT_SAYS(refusal(R"({"op":"drag","handle":"a","frames":[{"scale":1,"scale":2}]})"),
                "\"scale\" is given twice");
}

TEST(SessionRefuses, DeepNesting) {
    EXPECT_SAYS(refusal(std::string(1'000'000, '[')), "nested too deeply");
}

TEST(SessionRefuses, UnknownOpsAndKeys) {
    EXPECT_SAYS(refusal(R"({"op":"explode"})"),
                "\"op\" must be \"handle\", \"drag\", \"settle\", \"check\", \"commit\", \"set\", "
                "\"delete\", \"rename\", \"undo\" or \"redo\", not \"explode\"");
    EXPECT_SAYS(refusal(R"({"op":3})"), "\"op\" must be");
    EXPECT_SAYS(refusal("{}"), "the line has no \"op\"");
    EXPECT_SAYS(refusal(R"({"op":"commit","all":true})"),
                "the line has an unknown key \"all\"; what it may have: op");
    EXPECT_SAYS(refusal(R"({"op":"drag","handle":"a","frames":[{},{"turn":1}]})"),
                "\"frames[1]\" has an unknown key \"turn\"; what it may have: translate, rotate, scale, "
                "axes, coarse");
    EXPECT_SAYS(refusal(R"({"op":"set","colour":1})"), "unknown key \"colour\"");
    EXPECT_SAYS(refusal(R"({"op":"set"})"), "must set something");
}

TEST(SessionRefuses, BrokenHandles) {
    const auto with = [](const std::string& rest) {
        return refusal(R"({"op":"handle","name":"a","role":"moving",)" + rest + "}");
    };
    EXPECT_SAYS(with(R"("falloff":0)"), "by either \"points\" or \"region\"");
    EXPECT_SAYS(with(R"("points":[1],"region":"all")"), "by either \"points\" or \"region\"");
    EXPECT_SAYS(with(R"("points":[])"), "\"points\" must name at least one point");
    EXPECT_SAYS(with(R"("points":7)"), "\"points\" must be a list, not 7");
    EXPECT_SAYS(with(R"("points":[1,-1])"),
                "\"points[1]\" must be a whole number, 0 or more, at most 2^53, not -1");
    EXPECT_SAYS(with(R"("points":[6.0])"), "\"points[0]\" must be a whole number");
    EXPECT_SAYS(with(R"("points":[9007199254740993])"), "at most 2^53, not 9007199254740993");
    EXPECT_SAYS(with(R"("points":[99999999999999999999999])"), "\"points[0]\" must be a whole number");
    EXPECT_SAYS(with(R"("points":[[1,2,3]])"),
                "\"points[0]\" must be a point or a range [first,last], not a list of 3");
    EXPECT_SAYS(with(R"("points":[[1,[2]]])"), "\"points[0][1]\" must be a whole number");
    EXPECT_SAYS(with(R"("points":[0,[5,4]])"), "\"points[1]\" ends before it begins");
    EXPECT_SAYS(with(R"("region":"some")"),
                "\"region\" must be \"all\" or an object of one box, sphere or halfspace");
    EXPECT_SAYS(with(R"("region":{})"), "\"region\" must be");
    EXPECT_SAYS(with(R"("region":{"cone":{}})"),
                "unknown key \"cone\"; what it may have: box, sphere, halfspace");
    EXPECT_SAYS(with(R"("region":{"box":{"min":[0,0,0]}})"), "\"region.box\" has no \"max\"");
    EXPECT_SAYS(with(R"("region":{"box":{"min":[0,0,1],"max":[0,0,0]}})"),
                "\"region.box\" has a min above its max");
    EXPECT_SAYS(with(R"("region":{"sphere":{"center":[0,0],"radius":1}})"),
                "\"region.sphere.center\" must be three numbers [x,y,z], not a list of 2");
    EXPECT_SAYS(with(R"("region":{"sphere":{"center":[0,0,"0"],"radius":1}})"),
                "\"region.sphere.center[2]\" must be a number, not \"0\"");
    EXPECT_SAYS(with(R"("region":{"sphere":{"center":[0,0,0],"radius":-1}})"),
                "\"region.sphere.radius\" must be zero or more, not -1");
    EXPECT_SAYS(with(R"("region":{"halfspace":{"point":[0,0,0],"normal":[0,-0.0,0]}})"),
                "\"region.halfspace.normal\" is zero");
    EXPECT_SAYS(with(R"("points":[1],"falloff":-1)"), "\"falloff\" must be zero or more");
    EXPECT_SAYS(refusal(R"({"op":"handle","name":"","role":"moving","points":[1]})"),
                "\"name\" must not be empty");
    EXPECT_SAYS(refusal(R"({"op":"handle","role":"moving","points":[1]})"), "has no \"name\"");
    EXPECT_SAYS(refusal(R"({"op":"handle","name":"a","points":[1]})"), "has no \"role\"");
    EXPECT_SAYS(refusal(R"({"op":"handle","name":"a","role":"pinned","points":[1]})"),
                "\"role\" must be \"fixed\", \"moving\" or \"roi\", not \"pinned\"");
}

// Whose squares are no numbers any more.
TEST(Session, TakesQuaternionsOfAnyLength) {
    for (const std::string length : {"1e-310", "1e-200", "3", "1e200"}) {
        const auto drag = line_of<DragLine>(R"({"op":"drag","handle":"a","frames":[{"rotate":[)" + length +
                                            ",0,0," + length + "]}]}");
        const Quatd turn = drag.frames.at(0).rotate.normalized();
        EXPECT_NEAR(turn.w(), std::sqrt(0.5), 1e-12) << length;
        EXPECT_NEAR(turn.z(), std::sqrt(0.5), 1e-12) << length;
    }
}

TEST(SessionRefuses, BrokenDrags) {
    const auto with = [](const std::string& frame) {
        return refusal(R"({"op":"drag","handle":"a","pivot":[0,0,0],"frames":[{},)" + frame + "]}");
    };
    EXPECT_SAYS(with("1"), "\"frames[1]\" must be a JSON object, not 1");
    EXPECT_SAYS(with(R"({"translate":[1,2,3,4]})"), "\"frames[1].translate\" must be three numbers");
    EXPECT_SAYS(with(R"({"rotate":[1,0,0]})"),
                "\"frames[1].rotate\" must be a quaternion [w,x,y,z], not a list of 3");
    EXPECT_SAYS(with(R"({"rotate":[0,0,0,0]})"), "\"frames[1].rotate\" is a zero quaternion");
    EXPECT_SAYS(with(R"({"axes":[0,0,-0.0,0]})"), "\"frames[1].axes\" is a zero quaternion");
    EXPECT_SAYS(with(R"({"scale":0})"), "\"frames[1].scale\" must be greater than zero");
    EXPECT_SAYS(with(R"({"scale":[1,1,-2]})"), "\"frames[1].scale\" must be greater than zero");
    EXPECT_SAYS(with(R"({"scale":true})"), "\"frames[1].scale\" must be a number, not true");
    EXPECT_SAYS(with(R"({"coarse":1})"), "\"frames[1].coarse\" must be true or false, not 1");
    EXPECT_SAYS(refusal(R"({"op":"drag","handle":"a","frames":[]})"),
                "\"frames\" must have at least one frame");
    EXPECT_SAYS(refusal(R"({"op":"drag","handle":"a"})"), "has no \"frames\"");
    EXPECT_SAYS(refusal(R"({"op":"drag","handle":"","frames":[{}]})"), "\"handle\" must not be empty");
}

TEST(SessionRefuses, OtherBrokenLines) {
    EXPECT_SAYS(refusal(R"({"op":"settle"})"), "has no \"iterations\"");
    EXPECT_SAYS(refusal(R"({"op":"settle","iterations":-1})"),
                "\"iterations\" must be a whole number, 0 to 1000000");
    EXPECT_SAYS(refusal(R"({"op":"settle","iterations":1000001})"), "0 to 1000000, not 1000001");
    EXPECT_SAYS(refusal(R"({"op":"settle","iterations":2e1})"), "\"iterations\" must be a whole number");
    EXPECT_SAYS(refusal(R"({"op":"check","positions":"a","tolerance":-1e-9})"),
                "\"tolerance\" must be zero or more");
    EXPECT_SAYS(refusal(R"({"op":"check","positions":"a"})"), "has no \"tolerance\"");
    EXPECT_SAYS(refusal(R"({"op":"check","positions":"","tolerance":1})"), "\"positions\" must not be empty");
    EXPECT_SAYS(refusal(R"({"op":"rename","handle":"a","to":""})"), "\"to\" must not be empty");
    EXPECT_SAYS(refusal(R"({"op":"delete","handle":3})"), "\"handle\" must be a text, not 3");
}

TEST(SessionRefuses, SettingsOutOfRange) {
    EXPECT_SAYS(refusal(R"({"op":"set","neighbors":65})"),
                "\"neighbors\" must be a whole number, 2 to 64, not 65");
    EXPECT_SAYS(refusal(R"({"op":"set","neighbors":6.0})"),
                "\"neighbors\" must be a whole number, 2 to 64, not 6.0");
    EXPECT_SAYS(refusal(R"({"op":"set","samples":0})"),
                "\"samples\" must be a whole number, 1 or more, or \"all\"");
    EXPECT_SAYS(refusal(R"({"op":"set","samples":"some"})"), "\"samples\" must be");
    EXPECT_SAYS(refusal(R"({"op":"set","iterations":1001})"), "0 to 1000, not 1001");
    EXPECT_SAYS(refusal(R"({"op":"set","stiffness":0})"), "\"stiffness\" must be greater than zero, not 0");
    for (const char* poisson : {"0.5", "-1", "-1e300"})
        EXPECT_SAYS(refusal(std::string(R"({"op":"set","poisson":)") + poisson + "}"),
                    "\"poisson\" must be between -1 and 0.5");
    EXPECT_SAYS(refusal(R"({"op":"set","weights":"flat"})"), "\"weights\" must be \"smooth\" or \"paper\"");
    EXPECT_SAYS(refusal(R"({"op":"set","strays":"lose"})"),
                "\"strays\" must be \"freeze\", \"carry\" or \"bridge\"");
}

TEST(SessionRefuses, HandlesThatHoldInNoKnownWay) {
    const std::string handle = R"({"op":"handle","name":"a","points":[1],"role":)";
    EXPECT_SAYS(refusal(handle + R"("moving","rotation":"loose"})"), "\"rotation\" must be");
    EXPECT_SAYS(refusal(handle + R"("moving","falloff":-1})"), "\"falloff\" must be");
    EXPECT_SAYS(refusal(handle + R"("roi","rotation":"free"})"),
                "\"rotation\" is for fixed and moving handles");
    EXPECT_SAYS(refusal(handle + R"("roi","falloff":0.5})"), "\"falloff\" is for fixed and moving handles");
}

TEST(SessionRefuses, WhatIsNoColor) {
    const std::string handle = R"({"op":"handle","name":"a","role":"roi","points":[1],"color":)";
    for (const char* color : {R"("#12345")", R"("#1234567")", R"("red")", R"("#12345g")", R"("1234567")",
                              R"("#-12345")", R"("")", "7", "[1,2,3]"})
        EXPECT_SAYS(refusal(handle + color + "}"), "\"color\" must ");
}

TEST(SessionRefuses, ATornLastLineSayingHowToMend) {
    const std::string whole = std::string(header) + "\n{\"op\":\"commit\"}\n";
    const std::string line = R"({"op":"settle","iterations":20})";
    for (std::size_t length = 1; length < line.size(); ++length) {
        const std::string words = refusal_of_session(whole + line.substr(0, length));
        EXPECT_SAYS(words, "dir/wave.knead:3: the last line was cut short while it was written");
        EXPECT_SAYS(words, "delete it to use the rest");
    }
    EXPECT_EQ(refusal_of_session(whole + line), "accepted");
    EXPECT_SAYS(refusal_of_session(whole + std::string(40, '\0')), "the last line was cut short");
    EXPECT_SAYS(refusal_of_session(whole + R"({"op":"settle"})"), "has no \"iterations\"");
}

TEST(SessionRefuses, WithWordsThatStayShortAndWhole) {
    std::string name;
    for (int i = 0; i < 1000; ++i) name += "é";
    const std::string words = refusal(R"({"op":")" + name + "\"}");
    EXPECT_LT(words.size(), 300U);
    EXPECT_SAYS(words, "é…");
}

// --- Size

TEST(Session, ReadsLongLinesInLinearTime) {
    std::string text =
        std::string(header) + "\n{\"op\":\"handle\",\"name\":\"a\",\"role\":\"moving\",\"points\":[0";
    for (int i = 1; i < 1'000'000; ++i) text += "," + std::to_string(2 * i);
    text += "]}\n{\"op\":\"drag\",\"handle\":\"a\",\"pivot\":[0,0,0],\"frames\":[{}";
    for (int i = 1; i < 100'000; ++i)
        text += ",{\"translate\":[0.001,0.002," + std::to_string(i) + "],\"rotate\":[0.9,0.1,0.2,0.3]}";
    text += "]}\n";
    const auto start = std::chrono::steady_clock::now();
    const Session session = parse_session(text, "wave.knead");
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const auto& handle = std::get<HandleLine>(session.lines.at(0).action);
    EXPECT_EQ(std::get<std::vector<IndexRange>>(handle.points).size(), 1'000'000U);
    EXPECT_EQ(std::get<DragLine>(session.lines.at(1).action).frames.size(), 100'000U);
    EXPECT_LT(seconds.count(), 30); // it takes half a second; quadratic time would take minutes
}

} // namespace
} // namespace knead
