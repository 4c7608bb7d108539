// knead replay SESSION: carries out a recorded session with no window.

#include "edit/replay.h"
#include "base/counts.h"
#include "base/error.h"
#include "cli/commands.h"
#include "cli/replay_pictures.h"
#include "edit/json_text.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace knead {

namespace {

struct Arguments {
    std::string session, cloud, out, samples, device;
    ReplayPictureOptions pictures;
    std::vector<std::string> settings;
    unsigned threads = 0;
    bool record_checks = false, dry_run = false, json = false;
};

ReplayOptions options_from(const Arguments& arguments) {
    ReplayOptions options;
    if (!arguments.cloud.empty()) options.cloud = arguments.cloud;
    if (!arguments.out.empty()) options.out = arguments.out;
    for (const std::string& assignment : arguments.settings)
        options.overrides = merged(options.overrides, parse_setting(assignment));
    if (!arguments.samples.empty())
        options.overrides = merged(options.overrides, parse_setting("samples=" + arguments.samples));
    options.device = arguments.device;
    options.threads = arguments.threads;
    options.record_checks = arguments.record_checks;
    options.rehearse = arguments.dry_run;
    options.measure_extent = arguments.json;
    return options;
}

bool overrides_settings(const Arguments& arguments) {
    return !arguments.settings.empty() || !arguments.samples.empty();
}

nlohmann::ordered_json number_or_null(const std::optional<double>& number) {
    return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json to_json(const ReplayReport& report) {
    nlohmann::ordered_json checks = nlohmann::ordered_json::array();
    for (const CheckResult& check : report.checks) {
        nlohmann::ordered_json entry{{"line", check.line}, {"distance", nullptr}, {"held", check.held}};
        if (check.distance) entry["distance"] = *check.distance;
        checks.push_back(std::move(entry));
    }
    const StageSeconds& stages = report.stages;
    return {
        {"cloud", {{"points", report.points}, {"components", report.components}, {"strays", report.strays}}},
        {"samples", report.samples},
        {"frames", report.frames},
        {"iterations", report.iterations},
        {"threads", report.threads},
        {"device", report.device},
        {"peak_rss_bytes", report.peak_memory},
        {"handle_error", report.handle_error},
        {"area_change", number_or_null(report.extent.area)},
        {"volume_change", number_or_null(report.extent.volume)},
        {"checks", checks},
        {"warnings", report.warnings},
        {"seconds",
         {{"read", report.read},
          {"order", stages.order},
          {"neighbors", stages.neighbors},
          {"sampling", stages.sampling},
          {"geodesic", stages.geodesic},
          {"factorize", stages.factorize},
          {"solve", report.solve},
          {"upsample", report.upsample},
          {"device", stages.device},
          {"write", report.write},
          {"total", report.total}}}};
}

// A duration in the unit that reads best.
std::string duration(double seconds) {
    char text[32];
    if (seconds < 0.001)
        std::snprintf(text, sizeof text, "%.0f µs", seconds * 1e6);
    else if (seconds < 1)
        std::snprintf(text, sizeof text, seconds < 0.1 ? "%.1f ms" : "%.0f ms", seconds * 1e3);
    else
        std::snprintf(text, sizeof text, "%.2f s", seconds);
    return text;
}

// What a replay did, in plain words; stages that did not run are left out.
void tell(const ReplayReport& report, const Arguments& arguments, Terminal& terminal) {
    const StageSeconds& stages = report.stages;
    terminal.say("Replayed " + arguments.session + ": " + counted(report.points, "point") + ", " +
                 counted(report.samples, "sample") + ", " + counted(report.frames, "frame") +
                 " of dragging, " + counted(report.iterations, "iteration") + ", on " +
                 counted(report.threads, "thread") + "; points moved by " + report.device + ".");
    const std::pair<const char*, double> lines[] = {
        {"reading the cloud", report.read},
        {"ordering the points", stages.order},
        {"finding neighbours", stages.neighbors},
        {"choosing samples", stages.sampling},
        {"measuring along the surface", stages.geodesic},
        {"weighing links, factorising", stages.factorize},
        {"preparing the device", stages.device},
        {"an iteration (median)", report.solve},
        {"moving all points (median)", report.upsample},
        {"writing", report.write},
        {"in all", report.total},
    };
    for (const auto& [what, seconds] : lines) {
        if (seconds == 0) continue;
        std::string line = std::string("  ") + what;
        line.resize(31, ' ');
        terminal.say(line + duration(seconds));
    }
    for (const std::filesystem::path& path : report.written) terminal.say("Wrote " + path.string());
    if (arguments.out.empty()) terminal.say("The shape was not saved; --out FILE saves it");
}

// What a rehearsal was asked for and does not do.
std::string words_about_unused(const Arguments& arguments) {
    const std::pair<const char*, bool> asked[] = {{"--out", !arguments.out.empty()},
                                                  {"--record-checks", arguments.record_checks},
                                                  {"--picture", !arguments.pictures.picture.empty()},
                                                  {"--frames", !arguments.pictures.frames.empty()}};
    std::string words;
    for (const auto& [option, is_asked] : asked)
        if (is_asked) words += (words.empty() ? ", so not used: " : ", ") + std::string(option);
    return words;
}

// Of a rehearsal, too. A session may have any name, that of a picture as well.
void refuse_bad_pictures(const Arguments& arguments) {
    const auto refuse_if_session = [&](const std::filesystem::path& target) {
        std::error_code ignored;
        if (std::filesystem::equivalent(target, arguments.session, ignored))
            throw Error(Trouble::output, target.string(),
                        "is the session itself; give the picture another name");
    };
    if (!arguments.pictures.picture.empty()) {
        refuse_bad_picture(arguments.pictures.picture);
        refuse_if_session(arguments.pictures.picture);
    }
    const std::filesystem::path name = std::filesystem::path(arguments.session).filename();
    if (!arguments.pictures.frames.empty() && is_name_of_frame(name))
        refuse_if_session(arguments.pictures.frames / name);
}

int run_replay(const Arguments& arguments, Terminal& terminal) {
    ReplayOptions options = options_from(arguments);
    const Session session = read_session(arguments.session);
    refuse_bad_pictures(arguments);
    std::optional<ReplayPictures> pictures;
    if (arguments.pictures.wanted() && !arguments.dry_run) {
        pictures.emplace(arguments.pictures, terminal);
        options.after_frame = pictures->after_frame();
        options.after_last = pictures->after_last();
        options.add_outputs = pictures->adding();
    }
    ReplayReport report =
        replay(session, options, terminal, [&](const std::string& words) { terminal.warn(words); });
    const auto warn_of_checks = [&](const char* words) {
        report.warnings.emplace_back(std::string("the checks were recorded with ") + words);
        terminal.warn(report.warnings.back());
    };
    if (arguments.record_checks && !arguments.dry_run) {
        if (overrides_settings(arguments))
            warn_of_checks("other settings than the session has; it holds them only with the same --set or "
                           "--samples");
        if (options.cloud)
            warn_of_checks(
                "the cloud of --cloud; the session holds them only with a cloud of the same points");
    }
    if (pictures) {
        for (std::filesystem::path& path : pictures->targets()) report.written.push_back(std::move(path));
        if (const std::string words = pictures->words_about_other_frames(); !words.empty()) {
            report.warnings.push_back(words);
            terminal.warn(words);
        }
    }
    terminal.clear_bar();
    if (arguments.dry_run)
        terminal.say(arguments.session + ": " + counted(session.lines.size() + 1, "line") +
                     " in order; nothing was computed or written" + words_about_unused(arguments));
    else if (!arguments.json)
        tell(report, arguments, terminal);
    for (const CheckResult& check : report.checks)
        if (!check.held)
            terminal.say("knead: " + session.place(check.line) + ": check failed: " + check.words);
    if (!report.checks.empty() && report.all_checks_held())
        terminal.say(counted(report.checks.size(), "check") + " held");
    if (arguments.json) terminal.out << json_text(to_json(report)) << '\n';
    return report.all_checks_held() ? 0 : static_cast<int>(Trouble::check_failed);
}

} // namespace

void add_replay(CLI::App& app, Job& job) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("replay", "Carry out a recorded session and save the shape");
    command->add_option("SESSION", arguments->session, "The session file")->required();
    command->add_option("--cloud", arguments->cloud,
                        "Another cloud than the session's; of as many points, if it says how many");
    command->add_option("--out", arguments->out, "Where to save the shape after the last line");
    command
        ->add_option("--set", arguments->settings,
                     "A setting, key=value, over the session's own; may be repeated")
        ->allow_extra_args(false);
    command->add_option("--samples", arguments->samples, "Short for --set samples=N, or all");
    add_device_options(*command, arguments->device, arguments->threads);
    command->add_flag("--record-checks", arguments->record_checks,
                      "Write the session again, with a check after each edit and its cloud beside it");
    command->add_flag("--dry-run", arguments->dry_run, "Check the session without computing anything");
    command->add_flag("--json", arguments->json, "Print what was measured as JSON");
    command->add_option("--picture", arguments->pictures.picture,
                        "A PNG file for a picture of the last shape");
    command->add_option(
        "--frames", arguments->pictures.frames,
        "A folder for a picture of every frame of the drags, and of every shape that settled");
    declare_picture_options(*command, arguments->pictures.look);
    command->callback([arguments, command, &job] {
        job = [arguments, command](Terminal& terminal) {
            if (!arguments->pictures.wanted()) refuse_picture_options(*command);
            return run_replay(*arguments, terminal);
        };
    });
}

} // namespace knead
