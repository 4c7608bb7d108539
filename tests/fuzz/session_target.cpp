// The reader of session files, and the writer of their lines.

#include "base/error.h"
#include "base/require.h"
#include "edit/same_session.h"
#include "edit/session.h"
#include "fuzz/target.h"

namespace knead::fuzz {

namespace {

constexpr const char* shown = "wave.knead";

// Nothing where the text is refused as it should be.
std::optional<Session> parsed(std::string_view text) {
    try {
        return parse_session(text, shown);
    } catch (const Error& error) {
        require(error.trouble() == Trouble::input, "a session that is refused is an error of input");
        require_showable(error.what(), shown);
        return std::nullopt;
    }
}

// Both are the same session, but for the numbers and texts of their lines.
void require_same(const Session& a, const Session& b, std::size_t lines) {
    require(a.cloud == b.cloud && a.points == b.points && a.sha256 == b.sha256, "the cloud is the same");
    require(a.settings == b.settings, "the settings are the same");
    require(a.lines.size() >= lines && b.lines.size() == lines, "there are as many lines");
    for (std::size_t i = 0; i < lines; ++i)
        require(test::same(a.lines[i].action, b.lines[i].action), "the lines are the same");
}

// What the writer makes of a session is read as the same session, and written as the same text again.
void check_written(const Session& session) {
    std::string text = header_text(session) + '\n';
    for (const SessionLine& line : session.lines) text += to_text(line.action) + '\n';
    const auto again = parsed(text);
    require(again.has_value(), "what was written can be read");
    require_same(session, *again, session.lines.size());
    require(header_text(*again) == again->header_text, "a header is written as it was written");
    for (const SessionLine& line : again->lines)
        require(to_text(line.action) == line.text, "a line is written as it was written");
}

// What a crash leaves of the file, its whole lines, is read as the same acts.
void check_whole_lines(std::string_view text, const Session& session) {
    const std::size_t whole = text.rfind('\n') + 1;
    const std::string_view rest = text.substr(whole);
    const bool last_counts = rest.find_first_not_of(" \t\r") != std::string_view::npos;
    if (!last_counts || session.lines.empty()) return;
    const auto again = parsed(text.substr(0, whole));
    require(again.has_value(), "whole lines of a session can be read");
    require_same(session, *again, session.lines.size() - 1);
}

} // namespace

bool run_target(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto session = parsed(text);
    if (!session) return false;
    check_written(*session);
    check_whole_lines(text, *session);
    return true;
}

std::vector<Seed> seeds() {
    const std::string header = R"({"knead":1,"cloud":{"path":"a.ply"}})";
    const std::string full_header =
        R"({"knead":1,"cloud":{"path":"a b.ply","points":9,"sha256":")" + std::string(64, 'A') +
        R"("},"settings":{"neighbors":8,"samples":"all","iterations":5,"stiffness":0.02,"poisson":0.3,)"
        R"("weights":"paper","strays":"bridge"}})";
    std::vector<Seed> result{
        {"header", header},
        {"every setting", full_header + "\n"},
        {"byte-order mark", "\xEF\xBB\xBF" + header + "\r\n\r\n{\"op\":\"commit\"}\r\n"},
        {"bad json", header + "\n{\"op\":\n{}\n"},
        {"bad key", header + "\n{\"op\":\"undo\",\"now\":true}\n"},
        {"bad torn", header + "\n{\"op\":\"handle\",\"name\":\"ear\",\"ro"},
        {"bad version", R"({"knead":2,"cloud":{"path":"a.ply"}})"},
    };
    const std::pair<const char*, const char*> lines[] = {
        {"points", R"({"op":"handle","name":"feet","role":"fixed","points":[[0,411],987]})"},
        {"box", R"({"op":"handle","name":"b","role":"roi","region":{"box":{"min":[0,1,2],"max":[0,5,6]}}})"},
        {"sphere",
         R"({"op":"handle","name":"\u00e4","role":"moving","region":{"sphere":{"center":[-0.07,0.17,0.0],"radius":0.02}},"rotation":"free"})"},
        {"halfspace",
         R"({"op":"handle","name":"h","role":"moving","region":{"halfspace":{"point":[1,2,3],"normal":[0,0,-2]}},"rotation":"held","falloff":0.5})"},
        {"whole", R"({"op":"handle","name":"\ud83e\udd8e","role":"roi","region":"all"})"},
        {"drag",
         R"({"op":"drag","handle":"ear","pivot":[-0.07,0.15,0.0],"frames":[{"translate":[0,0.001,0],"rotate":[1,0,0,0],"scale":1},{"scale":[1,2,3],"axes":[0,3e-5,-0.0,0]},{}]})"},
        {"settle", R"({"op":"settle","iterations":20})"},
        {"check", R"({"op":"check","positions":"posed.ply","tolerance":1e-4})"},
        {"commit", R"({"op":"commit"})"},
        {"set", R"({"op":"set","samples":2000,"iterations":0,"strays":"carry","weights":"smooth"})"},
        {"rename", R"({"op":"rename","handle":"ear","to":"tip \"1\"\n"})"},
        {"delete", R"({"op":"delete","handle":"tip"})"},
        {"undo and redo", "{\"op\":\"undo\"}\n{\"op\":\"redo\"}"},
    };
    std::string all = header + "\n";
    for (const auto& [name, line] : lines) {
        result.push_back({std::string("line ") + name, header + "\n" + line + "\n"});
        all += std::string(line) + "\n";
    }
    result.push_back({"every line", all});
    result.push_back({"last line without its end", all + R"({"op":"commit"})"});
    return result;
}

} // namespace knead::fuzz
