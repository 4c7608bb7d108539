// The lines of a session file, from text to values.

#include "base/lower_case.h"
#include "base/whole_file.h"
#include "edit/session.h"
#include "edit/session_settings.h"

#include <algorithm>
#include <charconv>
#include <set>

namespace knead {

namespace {

using namespace session_json;

constexpr std::uint64_t newest_version = 1;
constexpr std::uint64_t most_settling = 1'000'000;
constexpr std::size_t digits_of_sha256 = 64;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr std::string_view white_space = " \t\r\n";

std::string_view without_byte_order_mark(std::string_view text) {
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    return text;
}

bool is_blank(std::string_view text) {
    return text.find_first_not_of(white_space) == std::string_view::npos;
}

// --- Handles

std::vector<IndexRange> read_points(const Value& list) {
    const std::size_t count = length_of_list(list);
    if (count == 0) refuse(list, "must name at least one point");
    std::vector<IndexRange> ranges;
    ranges.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Value entry = element(list, i);
        if (!entry.json->is_array()) {
            const std::uint64_t point = whole_number(entry, 0, largest_whole_number);
            ranges.push_back({point, point});
            continue;
        }
        if (entry.json->size() != 2) refuse_as(entry, "a point or a range [first,last]");
        const IndexRange range{whole_number(element(entry, 0), 0, largest_whole_number),
                               whole_number(element(entry, 1), 0, largest_whole_number)};
        if (range.first > range.last) refuse(entry, "ends before it begins; a range is [first,last]");
        ranges.push_back(range);
    }
    return ranges;
}

BoxRegion read_box(const Value& box) {
    allow_keys(box, {"min", "max"});
    BoxRegion result{vector(member(box, "min")), vector(member(box, "max"))};
    if ((result.lowest.array() > result.highest.array()).any()) refuse(box, "has a min above its max");
    return result;
}

SphereRegion read_sphere(const Value& sphere) {
    allow_keys(sphere, {"center", "radius"});
    return {vector(member(sphere, "center")), number_at_least_zero(member(sphere, "radius"))};
}

HalfspaceRegion read_halfspace(const Value& halfspace) {
    allow_keys(halfspace, {"point", "normal"});
    return {vector(member(halfspace, "point")), direction(member(halfspace, "normal"))};
}

Region read_region(const Value& region) {
    if (region.json->is_string() && *region.json == "all") return WholeRegion{};
    if (!region.json->is_object() || region.json->size() != 1)
        refuse_as(region, "\"all\" or an object of one box, sphere or halfspace");
    allow_keys(region, {"box", "sphere", "halfspace"});
    if (const auto box = optional_member(region, "box")) return read_box(*box);
    if (const auto sphere = optional_member(region, "sphere")) return read_sphere(*sphere);
    return read_halfspace(member(region, "halfspace"));
}

// "#4aa8ff"
std::uint32_t read_color(const Value& value) {
    const std::string text = text_not_empty(value);
    const bool is_color = text.size() == 7 && text.front() == '#' &&
                          text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
    if (!is_color) refuse_as(value, "a colour in hexadecimal digits, as \"#4aa8ff\"");
    std::uint32_t color = 0;
    std::from_chars(text.data() + 1, text.data() + text.size(), color, 16);
    return color;
}

HandleLine read_handle(const Value& line) {
    allow_keys(line, {"op", "name", "role", "points", "region", "rotation", "falloff", "color", "pivot"});
    constexpr std::array<std::pair<std::string_view, HandleRole>, 3> roles{
        {{"fixed", HandleRole::fixed},
         {"moving", HandleRole::moving},
         {"roi", HandleRole::region_of_interest}}};
    constexpr std::array<std::pair<std::string_view, bool>, 2> rotations{{{"held", false}, {"free", true}}};

    HandleLine handle;
    handle.name = text_not_empty(member(line, "name"));
    handle.role = choice(member(line, "role"), roles);
    const auto points = optional_member(line, "points");
    const auto region = optional_member(line, "region");
    if (points.has_value() == region.has_value())
        refuse(line, "must say which points the handle has, by either \"points\" or \"region\"");
    if (points) handle.points = read_points(*points);
    if (region) handle.points = read_region(*region);
    const bool is_region = handle.role == HandleRole::region_of_interest;
    if (const auto rotation = optional_member(line, "rotation")) {
        handle.free_rotation = choice(*rotation, rotations);
        if (handle.free_rotation && is_region)
            refuse(*rotation, "is for fixed and moving handles, not for \"roi\"");
    }
    if (const auto falloff = optional_member(line, "falloff")) {
        handle.falloff = number_at_least_zero(*falloff);
        if (handle.falloff > 0 && is_region)
            refuse(*falloff, "is for fixed and moving handles, not for \"roi\"");
    }
    if (const auto color = optional_member(line, "color")) handle.color = read_color(*color);
    if (const auto pivot = optional_member(line, "pivot")) handle.pivot = vector(*pivot);
    return handle;
}

// --- Drags

Vec3d read_scale(const Value& scale) {
    const bool is_uniform = !scale.json->is_array();
    Vec3d result = is_uniform ? Vec3d::Constant(number(scale)) : vector(scale);
    if ((result.array() <= 0).any()) refuse(scale, "must be greater than zero");
    return result;
}

HandlePose read_frame(const Value& frame) {
    allow_keys(frame, {"translate", "rotate", "scale", "axes", "coarse"});
    HandlePose pose;
    if (const auto translate = optional_member(frame, "translate")) pose.translate = vector(*translate);
    if (const auto rotate = optional_member(frame, "rotate")) pose.rotate = quaternion(*rotate);
    if (const auto scale = optional_member(frame, "scale")) pose.scale = read_scale(*scale);
    if (const auto axes = optional_member(frame, "axes")) pose.axes = quaternion(*axes);
    if (const auto coarse = optional_member(frame, "coarse")) pose.coarse = truth(*coarse);
    return pose;
}

Companion read_companion(const Value& entry) {
    if (!entry.json->is_object()) return {text_not_empty(entry)};
    allow_keys(entry, {"handle", "across", "pivot"});
    return {text_not_empty(member(entry, "handle")),
            Companion::Mirror{direction(member(entry, "across")), vector(member(entry, "pivot"))}};
}

std::vector<Companion> read_companions(const Value& list, const std::string& handle) {
    std::vector<Companion> companions;
    std::set<std::string> dragged{handle};
    const std::size_t count = length_of_list(list);
    for (std::size_t i = 0; i < count; ++i) {
        const Value entry = element(list, i);
        companions.push_back(read_companion(entry));
        if (!dragged.insert(companions.back().handle).second)
            refuse(entry, "names a handle that is dragged already");
    }
    return companions;
}

DragLine read_drag(const Value& line) {
    allow_keys(line, {"op", "handle", "pivot", "frames", "with"});
    DragLine drag;
    drag.handle = text_not_empty(member(line, "handle"));
    if (const auto with = optional_member(line, "with")) drag.with = read_companions(*with, drag.handle);
    if (const auto pivot = optional_member(line, "pivot")) drag.pivot = vector(*pivot);
    const Value frames = member(line, "frames");
    const std::size_t count = length_of_list(frames);
    if (count == 0) refuse(frames, "must have at least one frame");
    drag.frames.reserve(count);
    for (std::size_t i = 0; i < count; ++i) drag.frames.push_back(read_frame(element(frames, i)));
    return drag;
}

// --- The other lines

std::filesystem::path read_path(const Value& value) {
    const std::string text = text_not_empty(value);
    if (text.find('\0') != std::string::npos) refuse(value, "holds a zero character, which no file name has");
    return text;
}

CheckLine read_check(const Value& line) {
    allow_keys(line, {"op", "positions", "tolerance"});
    return {read_path(member(line, "positions")), number_at_least_zero(member(line, "tolerance"))};
}

SettleLine read_settle(const Value& line) {
    allow_keys(line, {"op", "iterations"});
    return {static_cast<unsigned>(whole_number(member(line, "iterations"), 0, most_settling))};
}

SetLine read_set(const Value& line) {
    if (line.json->size() == 1) refuse(line, "must set something, as in {\"op\":\"set\",\"iterations\":5}");
    return {settings_change(line, {"op"})};
}

DeleteLine read_delete(const Value& line) {
    allow_keys(line, {"op", "handle"});
    return {text_not_empty(member(line, "handle"))};
}

RenameLine read_rename(const Value& line) {
    allow_keys(line, {"op", "handle", "to"});
    return {text_not_empty(member(line, "handle")), text_not_empty(member(line, "to"))};
}

template<typename Line>
Line read_bare(const Value& line) {
    allow_keys(line, {"op"});
    return {};
}

using ReadAction = SessionAction (*)(const Value& line);

// Wraps a reader of one kind of line.
template<auto read>
SessionAction as_action(const Value& line) {
    return read(line);
}

constexpr std::array<std::pair<std::string_view, ReadAction>, 10> all_ops{{
    {"handle", as_action<read_handle>},
    {"drag", as_action<read_drag>},
    {"settle", as_action<read_settle>},
    {"check", as_action<read_check>},
    {"commit", as_action<read_bare<CommitLine>>},
    {"set", as_action<read_set>},
    {"delete", as_action<read_delete>},
    {"rename", as_action<read_rename>},
    {"undo", as_action<read_bare<UndoLine>>},
    {"redo", as_action<read_bare<RedoLine>>},
}};

SessionAction read_action(std::string_view text, const Place& place, bool is_terminated) {
    const Parsed parsed = parse_json(text);
    if (!parsed.is_json && !is_terminated)
        throw Error(place.trouble, place.text,
                    "the last line was cut short while it was written (" + parsed.trouble +
                        "); delete it to use the rest of the session");
    if (!parsed.trouble.empty()) throw Error(place.trouble, place.text, parsed.trouble);
    const Value line{&parsed.value, &place};
    return choice(member(line, "op"), all_ops)(line);
}

// --- The header

std::string read_sha256(const Value& value) {
    std::string digits = text_not_empty(value);
    for (char& digit : digits)
        if (digit >= 'A' && digit <= 'F') digit = static_cast<char>(digit - 'A' + 'a');
    if (digits.size() != digits_of_sha256 ||
        digits.find_first_not_of("0123456789abcdef") != std::string::npos)
        refuse_as(value, "64 hexadecimal digits");
    return digits;
}

void check_version(const Value& version) {
    const std::uint64_t number = whole_number(version, 1, largest_whole_number);
    if (number > newest_version)
        refuse(version, "is " + std::to_string(number) +
                            ": this session was written by a newer knead; version 1 is what this one reads");
}

void read_header(std::string_view text, const Place& place, Session& session) {
    const Parsed parsed = parse_json(text);
    const bool is_header =
        parsed.trouble.empty() && parsed.value.is_object() && parsed.value.contains("knead");
    if (!is_header && (parsed.trouble.empty() || !looks_like_session(text)))
        throw Error(place.trouble, place.text,
                    "is not a knead session: the first line must be {\"knead\":1,\"cloud\":{\"path\":…}}");
    if (!parsed.trouble.empty()) throw Error(place.trouble, place.text, parsed.trouble);

    const Value header{&parsed.value, &place};
    check_version(member(header, "knead")); // first, as a newer version may have other keys
    allow_keys(header, {"knead", "cloud", "settings"});
    const Value cloud = member(header, "cloud");
    allow_keys(cloud, {"path", "points", "sha256"});
    session.cloud = read_path(member(cloud, "path"));
    if (const auto points = optional_member(cloud, "points"))
        session.points = whole_number(*points, 0, largest_whole_number);
    if (const auto sha256 = optional_member(cloud, "sha256")) session.sha256 = read_sha256(*sha256);
    if (const auto settings = optional_member(header, "settings"))
        session.settings = changed(Settings{}, settings_change(*settings));
    session.header_text = text;
}

} // namespace

std::string Session::place(std::size_t line_number) const {
    return file.string() + ':' + std::to_string(line_number);
}

std::filesystem::path Session::resolve(const std::filesystem::path& written) const {
    return file.parent_path() / written; // which is `written` where that is absolute
}

bool has_session_extension(const std::filesystem::path& file) {
    return lower_case(file.extension().string()) == ".knead";
}

bool looks_like_session(std::string_view first_bytes) {
    constexpr std::size_t far_enough = 1024;
    constexpr std::string_view key = "\"knead\"";
    std::string_view text = without_byte_order_mark(first_bytes.substr(0, far_enough));
    const std::size_t first = text.find_first_not_of(white_space);
    if (first == std::string_view::npos || text[first] != '{') return false;
    for (std::size_t at = text.find(key); at != std::string_view::npos; at = text.find(key, at + 1)) {
        const std::size_t colon = text.find_first_not_of(white_space, at + key.size());
        if (colon != std::string_view::npos && text[colon] == ':') return true;
    }
    return false;
}

Session parse_session(std::string_view text, const std::filesystem::path& file) {
    Session session;
    session.file = file;
    text = without_byte_order_mark(text);
    bool has_header = false;
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const bool is_terminated = end < text.size();
        std::string_view line = text.substr(0, end);
        text.remove_prefix(is_terminated ? end + 1 : end);
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (is_blank(line)) continue;
        const Place place{Trouble::input, session.place(number)};
        if (has_header)
            session.lines.push_back({number, std::string(line), read_action(line, place, is_terminated)});
        else
            read_header(line, place, session), session.header_line = number;
        has_header = true;
    }
    if (!has_header)
        throw Error(Trouble::input, file.string(),
                    "is empty; the first line of a knead session is {\"knead\":1,\"cloud\":{\"path\":…}}");
    return session;
}

Session read_session(const std::filesystem::path& path) {
    SilentProgress silent;
    const std::vector<std::byte> bytes = read_whole_file(path, silent);
    return parse_session({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
}

} // namespace knead
