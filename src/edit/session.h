#pragma once
// Session files, version 1: what a person did to a cloud, one JSON object a line (src/README.md describes the
// format).
//
// This room's file knows the text; what the lines mean is edit/document.h. Reading checks everything that can
// be checked without the cloud: JSON, keys, types, ranges, names. A value is refused by file, line and key.

#include "base/types.h"
#include "graph/influences.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

namespace knead {

// --- Settings ---

enum class Strays { freeze, carry, bridge };

struct Settings {
    unsigned neighbors = 6;                      // 2 … 64
    std::optional<std::uint64_t> samples = 1000; // ≥ 1; nothing: every point
    unsigned iterations = 3;                     // a frame, 0 … 1000
    double stiffness = 0.01;                     // α > 0
    double poisson = 0.0;                        // -1 < ν < 0.5
    InfluenceWeights weights = InfluenceWeights::smooth;
    Strays strays = Strays::freeze;

    bool operator==(const Settings&) const = default;
};

// A `set` line, the header's settings, and --set: only the keys that were given.
struct SettingsChange {
    std::optional<unsigned> neighbors;
    std::optional<std::optional<std::uint64_t>> samples;
    std::optional<unsigned> iterations;
    std::optional<double> stiffness;
    std::optional<double> poisson;
    std::optional<InfluenceWeights> weights;
    std::optional<Strays> strays;
};

// A setting, by which all code goes that is the same for each of them.
template<typename Value>
struct Setting {
    std::string_view key; // in a session
    Value Settings::*value;
    std::optional<Value> SettingsChange::*change;
};
template<typename Value> // which clang-tidy 14 does not see by itself
Setting(const char*, Value Settings::*, std::optional<Value> SettingsChange::*)->Setting<Value>;
inline constexpr std::tuple all_settings{
    Setting{"neighbors", &Settings::neighbors, &SettingsChange::neighbors},
    Setting{"samples", &Settings::samples, &SettingsChange::samples},
    Setting{"iterations", &Settings::iterations, &SettingsChange::iterations},
    Setting{"stiffness", &Settings::stiffness, &SettingsChange::stiffness},
    Setting{"poisson", &Settings::poisson, &SettingsChange::poisson},
    Setting{"weights", &Settings::weights, &SettingsChange::weights},
    Setting{"strays", &Settings::strays, &SettingsChange::strays}};

template<typename Function>
void for_each_setting(Function&& function) {
    std::apply([&](const auto&... setting) { (function(setting), ...); }, all_settings);
}

Settings changed(Settings settings, const SettingsChange& change);
// Both changes, `later` winning.
SettingsChange merged(SettingsChange earlier, const SettingsChange& later);

// --- Handles and poses ---

enum class HandleRole { fixed, moving, region_of_interest };

struct IndexRange {
    std::uint64_t first = 0;
    std::uint64_t last = 0; // inclusive
};
struct BoxRegion {
    Vec3d lowest, highest; // inclusive
};
struct SphereRegion {
    Vec3d center;
    double radius = 0; // inclusive
};
struct HalfspaceRegion {
    Vec3d point, normal; // the side that the normal points to, the plane included
};
struct WholeRegion {};
// In the file's coordinates.
using Region = std::variant<BoxRegion, SphereRegion, HalfspaceRegion, WholeRegion>;

// One frame of a drag: p → pivot + R S (p - pivot) + translate, from the rest shape. What was read can be
// normalised: the squares of its quaternions neither vanish nor overflow.
struct HandlePose {
    Vec3d translate = Vec3d::Zero();
    Quatd rotate = Quatd::Identity(); // as written; normalised and sign-aligned by the document
    Vec3d scale = Vec3d::Ones();      // along `axes`
    Quatd axes = Quatd::Identity();
    // Whether few samples answer for all (deform/coarse_level.h), where there are enough for that: a frame
    // that had to be quick.
    bool coarse = false;
};

// --- The lines ---

struct HandleLine {
    std::string name;
    HandleRole role = HandleRole::moving;
    std::variant<std::vector<IndexRange>, Region> points;
    bool free_rotation = false; // "rotation":"free"
    double falloff = 0;
    std::optional<std::uint32_t> color = {}; // 0xrrggbb, where the user chose one
    // Where the user put its joint, which the window turns it about: on the rest shape, as a region is told,
    // in the file's coordinates. Nothing: its middle.
    std::optional<Vec3d> pivot = {};
};
// Another moving handle that goes along in a drag: what takes the dragged one from where it was before to a
// frame's pose takes this one from where it was; or what a mirror shows of that does.
struct Companion {
    std::string handle;
    struct Mirror {
        Vec3d across; // the normal of its plane, of any length but 0
        Vec3d pivot;  // where the drag's pivot is in it
    };
    std::optional<Mirror> mirror = {};
};
struct DragLine {
    std::string handle;
    Vec3d pivot = Vec3d::Zero();
    std::vector<HandlePose> frames;   // at least one
    std::vector<Companion> with = {}; // each handle once
};
struct SettleLine {
    unsigned iterations = 0;
};
struct CheckLine {
    std::filesystem::path positions; // as written, relative to the session file
    double tolerance = 0;            // ≥ 0, of D
};
struct CommitLine {};
struct SetLine {
    SettingsChange change;
};
struct DeleteLine {
    std::string handle;
};
struct RenameLine {
    std::string handle, to;
};
struct UndoLine {};
struct RedoLine {};

using SessionAction = std::variant<HandleLine, DragLine, SettleLine, CheckLine, CommitLine, SetLine,
                                   DeleteLine, RenameLine, UndoLine, RedoLine>;

struct SessionLine {
    std::size_t number = 0; // in the file, from 1
    std::string text;       // as it stood there, without its end of line
    SessionAction action;
};

struct Session {
    std::filesystem::path file;          // as opened, for errors and relative paths
    std::filesystem::path cloud;         // as written in the header
    std::optional<std::uint64_t> points; // of the cloud, where given
    std::optional<std::string> sha256;   // lower case, where given
    Settings settings;
    std::size_t header_line = 1; // its number in the file
    std::string header_text;
    std::vector<SessionLine> lines;

    // "FILE:LINE", the place of an Error.
    std::string place(std::size_t line_number) const;
    // A path of the session, made relative to the working folder.
    std::filesystem::path resolve(const std::filesystem::path& written) const;
};

// Whether a file that begins with these bytes (a kilobyte will do) is meant to be a session, whatever its
// name: an object whose first kilobyte has the key "knead". It may still be refused when read.
bool looks_like_session(std::string_view first_bytes);

// Whether a file is a session by its name, which then ends in .knead, letter case aside.
bool has_session_extension(const std::filesystem::path& file);

// Reads a session file. Throws Error (input) with file, line and key. Lines end in LF or CRLF; blank ones and
// a byte order mark are skipped. A last line without an end of line counts if it parses, and is refused if
// not. Names that no line declared, points that the cloud does not have, and empty edits are left to the
// document.
Session read_session(const std::filesystem::path& path);

// The same from text; `file` stands in for the name in errors.
Session parse_session(std::string_view text, const std::filesystem::path& file);

// "key=value" of --set, the value in JSON or a bare word ("samples=all", "stiffness=0.02"). Throws Error
// (usage), its place the assignment itself.
SettingsChange parse_setting(std::string_view assignment);

// The text of a line, without an end of line. parse_session reads it back to equal values, to the last bit of
// every number; what a frame may leave out is left out. Numbers must be finite, names valid UTF-8 (else Error
// (output)).
std::string to_text(const SessionAction& action);
// The header's text, all settings written out; the lengths and digest of the cloud where the session has
// them.
std::string header_text(const Session& session);

} // namespace knead
