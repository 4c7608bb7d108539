// The lines of a session file, from values to text.

#include "base/error.h"
#include "base/quoted.h"
#include "base/require.h"
#include "edit/session.h"

#include <nlohmann/json.hpp>

#include <charconv>
#include <cmath>

namespace knead {

namespace {

// --- Values

// The shortest decimal that reads back as the same double.
void append_number(std::string& text, double value) {
    require(std::isfinite(value), "a number of a session is finite");
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    text.append(digits.data(), end);
    if (value == 0 && std::signbit(value))
        text += ".0"; // "-0" would be read as a whole number without a sign
}

void append_text(std::string& text, std::string_view value) {
    try {
        text += nlohmann::json(value).dump();
    } catch (const nlohmann::json::type_error&) {
        throw Error(Trouble::output, "",
                    "a session cannot hold the name " + quoted(std::string(value)) +
                        ", which is not UTF-8; rename it");
    }
}

// "#4aa8ff"
void append_color(std::string& text, std::uint32_t color) {
    constexpr std::string_view digits = "0123456789abcdef";
    text += "\"#";
    for (int shift = 20; shift >= 0; shift -= 4)
        text += digits[(color >> static_cast<unsigned>(shift)) & 15U];
    text += '"';
}

void append_list(std::string& text, std::initializer_list<double> values) {
    char separator = '[';
    for (const double value : values) {
        text += separator;
        append_number(text, value);
        separator = ',';
    }
    text += ']';
}

void append_vector(std::string& text, const Vec3d& value) {
    append_list(text, {value.x(), value.y(), value.z()});
}

void append_quaternion(std::string& text, const Quatd& value) {
    append_list(text, {value.w(), value.x(), value.y(), value.z()});
}

// Appends `"name":`, after a comma where something stands before it.
std::string& key(std::string& text, std::string_view name) {
    if (text.back() != '{') text += ',';
    return text.append(1, '"').append(name).append("\":");
}

// Identity up to the sign of zeros, which a replay that is bit for bit the same may depend on.
bool is_default(const Vec3d& value, double component) {
    for (const double one : value)
        if (one != component || std::signbit(one)) return false;
    return true;
}

bool is_default(const Quatd& value) {
    return value.w() == 1 && is_default(value.vec(), 0);
}

const char* word(HandleRole role) {
    switch (role) {
    case HandleRole::fixed:
        return "\"fixed\"";
    case HandleRole::moving:
        return "\"moving\"";
    case HandleRole::region_of_interest:
        return "\"roi\"";
    }
    return "";
}

const char* word(InfluenceWeights weights) {
    return weights == InfluenceWeights::smooth ? "\"smooth\"" : "\"paper\"";
}

const char* word(Strays strays) {
    switch (strays) {
    case Strays::freeze:
        return "\"freeze\"";
    case Strays::carry:
        return "\"carry\"";
    case Strays::bridge:
        return "\"bridge\"";
    }
    return "";
}

// --- Parts of lines

void append_points(std::string& text, const std::vector<IndexRange>& ranges) {
    char separator = '[';
    for (const IndexRange& range : ranges) {
        text += separator;
        separator = ',';
        if (range.first == range.last)
            text += std::to_string(range.first);
        else
            text.append("[")
                .append(std::to_string(range.first))
                .append(",")
                .append(std::to_string(range.last)) += ']';
    }
    text += ']';
}

void append_region(std::string& text, const Region& region) {
    if (const auto* box = std::get_if<BoxRegion>(&region)) {
        append_vector(text += R"({"box":{"min":)", box->lowest);
        append_vector(text += R"(,"max":)", box->highest);
        text += "}}";
    } else if (const auto* sphere = std::get_if<SphereRegion>(&region)) {
        append_vector(text += R"({"sphere":{"center":)", sphere->center);
        append_number(text += R"(,"radius":)", sphere->radius);
        text += "}}";
    } else if (const auto* halfspace = std::get_if<HalfspaceRegion>(&region)) {
        append_vector(text += R"({"halfspace":{"point":)", halfspace->point);
        append_vector(text += R"(,"normal":)", halfspace->normal);
        text += "}}";
    } else {
        text += "\"all\"";
    }
}

void append_frame(std::string& text, const HandlePose& pose) {
    text += '{';
    if (!is_default(pose.translate, 0)) append_vector(key(text, "translate"), pose.translate);
    if (!is_default(pose.rotate)) append_quaternion(key(text, "rotate"), pose.rotate);
    if (!is_default(pose.scale, 1)) {
        const bool is_uniform = pose.scale.x() == pose.scale.y() && pose.scale.y() == pose.scale.z();
        if (is_uniform)
            append_number(key(text, "scale"), pose.scale.x());
        else
            append_vector(key(text, "scale"), pose.scale);
    }
    if (!is_default(pose.axes)) append_quaternion(key(text, "axes"), pose.axes);
    if (pose.coarse) key(text, "coarse") += "true";
    text += '}';
}

void append_value(std::string& text, const std::optional<std::uint64_t>& samples) {
    text += samples ? std::to_string(*samples) : "\"all\"";
}
void append_value(std::string& text, unsigned number) {
    text += std::to_string(number);
}
void append_value(std::string& text, double number) {
    append_number(text, number);
}
void append_value(std::string& text, InfluenceWeights weights) {
    text += word(weights);
}
void append_value(std::string& text, Strays strays) {
    text += word(strays);
}

void append_settings(std::string& text, const SettingsChange& change) {
    for_each_setting([&](const auto& setting) {
        if (const auto& wanted = change.*setting.change) append_value(key(text, setting.key), *wanted);
    });
}

// --- Lines: all but their `{"op":"…"` and the closing brace

void append_line(std::string& text, const HandleLine& line) {
    append_text(key(text, "name"), line.name);
    key(text, "role") += word(line.role);
    if (const auto* points = std::get_if<std::vector<IndexRange>>(&line.points))
        append_points(key(text, "points"), *points);
    else
        append_region(key(text, "region"), std::get<Region>(line.points));
    if (line.free_rotation) key(text, "rotation") += "\"free\"";
    if (line.falloff != 0) append_number(key(text, "falloff"), line.falloff);
    if (line.color) append_color(key(text, "color"), *line.color);
    if (line.pivot) append_vector(key(text, "pivot"), *line.pivot);
}

void append_companion(std::string& text, const Companion& companion) {
    if (!companion.mirror) return append_text(text, companion.handle);
    append_text(text += "{\"handle\":", companion.handle);
    append_vector(key(text, "across"), companion.mirror->across);
    append_vector(key(text, "pivot"), companion.mirror->pivot);
    text += '}';
}

void append_companions(std::string& text, const std::vector<Companion>& companions) {
    if (companions.empty()) return;
    char separator = '[';
    key(text, "with");
    for (const Companion& companion : companions) {
        append_companion(text += separator, companion);
        separator = ',';
    }
    text += ']';
}

void append_line(std::string& text, const DragLine& line) {
    append_text(key(text, "handle"), line.handle);
    append_vector(key(text, "pivot"), line.pivot);
    append_companions(text, line.with);
    char separator = '[';
    key(text, "frames");
    for (const HandlePose& frame : line.frames) {
        append_frame(text += separator, frame);
        separator = ',';
    }
    text += ']';
}

void append_line(std::string& text, const SettleLine& line) {
    key(text, "iterations") += std::to_string(line.iterations);
}

void append_line(std::string& text, const CheckLine& line) {
    append_text(key(text, "positions"), line.positions.string());
    append_number(key(text, "tolerance"), line.tolerance);
}

void append_line(std::string& text, const SetLine& line) {
    append_settings(text, line.change);
}

void append_line(std::string& text, const DeleteLine& line) {
    append_text(key(text, "handle"), line.handle);
}

void append_line(std::string& text, const RenameLine& line) {
    append_text(key(text, "handle"), line.handle);
    append_text(key(text, "to"), line.to);
}

void append_line(std::string& /*text*/, const CommitLine& /*line*/) {}
void append_line(std::string& /*text*/, const UndoLine& /*line*/) {}
void append_line(std::string& /*text*/, const RedoLine& /*line*/) {}

// In the order of SessionAction.
constexpr std::array<std::string_view, std::variant_size_v<SessionAction>> op_names{
    "handle", "drag", "settle", "check", "commit", "set", "delete", "rename", "undo", "redo"};

} // namespace

std::string to_text(const SessionAction& action) {
    std::string text = "{";
    key(text, "op").append(1, '"').append(op_names.at(action.index())) += '"';
    std::visit([&text](const auto& line) { append_line(text, line); }, action);
    return text += '}';
}

std::string header_text(const Session& session) {
    std::string text = R"({"knead":1,"cloud":{"path":)";
    append_text(text, session.cloud.string());
    if (session.points) key(text, "points") += std::to_string(*session.points);
    if (session.sha256) append_text(key(text, "sha256"), *session.sha256);
    SettingsChange all;
    for_each_setting([&](const auto& setting) { all.*setting.change = session.settings.*setting.value; });
    append_settings(text += R"(},"settings":{)", all);
    return text += "}}";
}

} // namespace knead
