#pragma once
// A recorded session, carried out from its first line to its last with no window.

#include "base/outputs.h"
#include "edit/document.h"
#include "edit/extent_change.h"
#include "edit/session.h"
#include "upsample/devices.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace knead {

// Looks at a shape on the way. `shape` is in the order of computation, document.pipeline().order(), and good
// until it returns.
using ShapeSeen = std::function<void(const Document& document, const RestShape& shape)>;

struct ReplayOptions {
    std::optional<std::filesystem::path> cloud; // instead of the session's, relative to the working folder
    std::optional<std::filesystem::path> out;   // where the last shape is written
    SettingsChange overrides;                   // win over the header and over every `set` line
    std::string device;                         // as make_upsampler() takes it; empty: the default
    UpsamplerMaker make_upsampler = knead::make_upsampler; // another one, for tests of failing devices
    unsigned threads = 0;                                  // 0: one a core
    bool record_checks =
        false;             // writes the session again with a check after each edit, and the clouds beside it
    bool rehearse = false; // checks everything that can be checked without computing a shape

    bool measure_extent = false; // fills ReplayReport::extent

    // For pictures; either may be empty, and none is called in a rehearsal.
    ShapeSeen after_frame; // after every frame of a drag and every settling
    ShapeSeen after_last;  // after the last line, before anything is written
    // Adds what else takes its place together with everything that the replay writes; may be empty.
    std::function<void(Outputs&)> add_outputs;
};

struct CheckResult {
    std::size_t line = 0; // of the session
    std::optional<double>
        distance; // the largest of a point, over D; nothing when the clouds cannot be compared
    bool held = false;
    std::string words; // what is wrong, if it does not hold
};

// What a replay did; durations in seconds. The fields are those of `replay --json`.
struct ReplayReport {
    std::size_t points = 0;
    std::size_t components = 0; // after bridging, if `strays` asks for it; 0 if no stage ran
    std::size_t strays = 0;     // components without a handle, at the last drag
    std::size_t samples = 0;    // at the last drag
    std::size_t frames = 0;
    std::size_t iterations = 0;
    unsigned threads = 0;
    std::string device;
    std::uint64_t peak_memory = 0; // bytes
    double handle_error = 0;       // over D
    double diagonal = 0;           // D
    ExtentChange extent;           // of the last shape against the one opened
    std::vector<CheckResult> checks;
    std::vector<std::string> warnings;
    std::vector<std::filesystem::path> written;

    double read = 0, write = 0, total = 0;
    StageSeconds stages;
    double solve = 0;    // median of an iteration
    double upsample = 0; // median of a frame

    bool all_checks_held() const;
};

// `warn` hears every warning when it comes up, once. Throws Error as the command line's exit codes have it
// (input, output, numeric, and usage for a device that is not there) and Cancelled; a failed check is no
// Error. Nothing is written before the last line was carried out, and then all outputs or none.
ReplayReport replay(const Session& session, const ReplayOptions& options, Progress& progress,
                    const std::function<void(const std::string&)>& warn);

} // namespace knead
