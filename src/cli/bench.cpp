// knead bench, measured on this machine: the paper's Table 1, how the stages grow, how soon changed handles
// are live, how few samples answer for many, how fast files are loaded and saved, and how well the window
// follows the hand.

#include "base/whole_file.h"
#include "bench/drag_speed.h"
#include "bench/file_speed.h"
#include "bench/growth.h"
#include "bench/handle_timing.h"
#include "bench/table1.h"
#include "cli/commands.h"
#include "io/cloud_file.h"

#include <CLI/CLI.hpp>

#include <memory>

#ifdef KNEAD_HAS_EDITOR
#include "app/drag_benchmark.h"
#else
#include "base/error.h"
#endif

namespace knead {

namespace {

constexpr std::size_t points_of_files = 1'000'000;
constexpr std::uint64_t dragged_samples[] = {5000, 20'000, 100'000};

struct BenchArguments {
    std::vector<std::string> rows;
    std::string scans, device, window, drag, files, picture;
    std::optional<std::size_t> growth, handles; // up to so many points
    std::size_t repeats = 5;
    unsigned threads = 0;
    bool json = false;
};

#ifdef KNEAD_HAS_EDITOR
int run_window_bench(const BenchArguments& arguments, Terminal& terminal) {
    DragBenchmarkOptions options;
    options.editor.file = arguments.window;
    options.editor.device = arguments.device;
    options.editor.threads = arguments.threads;
    options.editor.width = 1280;
    options.editor.height = 800;
    options.editor.told_to_stop = [&terminal] { return terminal.cancelled(); };
    const DragBenchmark result = measure_drag(options);
    terminal.out << (arguments.json ? drag_benchmark_json(result) : drag_benchmark_text(result));
    return 0;
}
#else
int run_window_bench(const BenchArguments& /*arguments*/, Terminal& /*terminal*/) {
    throw Error(Trouble::usage, "--window", "this knead was built without its window (KNEAD_EDITOR=OFF)");
}
#endif

int run_files_bench(const BenchArguments& arguments, Terminal& terminal) {
    Workers workers(arguments.threads);
    const FileSpeed speed =
        measure_files(arguments.files, points_of_files, arguments.repeats, workers, terminal);
    terminal.out << (arguments.json ? file_speed_json(speed) + "\n" : file_speed_text(speed));
    return 0;
}

Table1Options table1_options(const BenchArguments& arguments) {
    return {arguments.repeats, arguments.threads, arguments.device, scan_folders(arguments.scans)};
}

int run_drag_bench(const BenchArguments& arguments, Terminal& terminal) {
    const std::filesystem::path file = arguments.drag;
    const DragSpeeds speeds = measure_drags(file.filename().string(), read_cloud(file, terminal),
                                            dragged_samples, table1_options(arguments), terminal);
    for (const std::string& words : speeds.warnings) terminal.warn(words);
    terminal.out << (arguments.json ? drag_speeds_json(speeds) + "\n" : drag_speeds_text(speeds));
    return 0;
}

int run_growth_bench(const BenchArguments& arguments, Terminal& terminal) {
    std::optional<FileInTheMaking> picture; // begun first, so that a folder that is not there is told at once
    if (!arguments.picture.empty()) picture.emplace(arguments.picture);
    const Growth growth = measure_growth(*arguments.growth, table1_options(arguments), terminal);
    for (const std::string& words : growth.warnings) terminal.warn(words);
    if (picture) {
        picture->write(growth_picture(growth));
        picture->commit();
    }
    terminal.out << (arguments.json ? growth_json(growth) + "\n" : growth_text(growth));
    return 0;
}

int run_handles_bench(const BenchArguments& arguments, Terminal& terminal) {
    const HandleTiming timing =
        measure_handle_timing(*arguments.handles, table1_options(arguments), terminal);
    for (const std::string& words : timing.warnings) terminal.warn(words);
    terminal.out << (arguments.json ? handle_timing_json(timing) + "\n" : handle_timing_text(timing));
    return 0;
}

int run_bench(const BenchArguments& arguments, Terminal& terminal) {
    if (!arguments.window.empty()) return run_window_bench(arguments, terminal);
    if (!arguments.drag.empty()) return run_drag_bench(arguments, terminal);
    if (!arguments.files.empty()) return run_files_bench(arguments, terminal);
    if (arguments.growth) return run_growth_bench(arguments, terminal);
    if (arguments.handles) return run_handles_bench(arguments, terminal);
    const std::vector<Table1Row> rows = rows_named(arguments.rows);
    const Table1 table = measure_table1(rows, table1_options(arguments), terminal);
    for (const std::string& words : table.warnings) terminal.warn(words);
    terminal.out << (arguments.json ? table1_json(table) + "\n" : table1_text(table));
    return 0;
}

// How many points the largest plane has.
CLI::Option* add_points(CLI::App& command, const std::string& name, std::optional<std::size_t>& points,
                        std::size_t least, const std::string& words) {
    return command.add_option(name, points, words)->check(CLI::Range(least, std::size_t{1'000'000'000}));
}

} // namespace

void add_bench(CLI::App& app, Job& job) {
    const auto arguments = std::make_shared<BenchArguments>();
    CLI::App* command = app.add_subcommand("bench", "Measure the paper's Table 1 on this machine");
    CLI::Option* rows = command->add_option(
        "ROW", arguments->rows, "Rows by model or model/samples: dragon, bunny/1000 (default: all)");
    command->add_option("--repeat", arguments->repeats, "How often each cloud is set up (default: 5)")
        ->check(CLI::Range(std::size_t{1}, std::size_t{1000}));
    add_device_options(*command, arguments->device, arguments->threads);
    CLI::Option* scans =
        command
            ->add_option("--scans", arguments->scans,
                         "The folder of the scans (default: KNEAD_SCANS, then ../shared/scans)")
            ->check(CLI::ExistingDirectory);
    CLI::Option* window = command->add_option(
        "--window", arguments->window,
        "Instead: open this cloud in the window, look round it, drag a handle of it, and tell how many "
        "pictures a second there are and how old the pose on the screen is");
    CLI::Option* drag = command->add_option(
        "--drag", arguments->drag,
        "Instead: drag a handle of this cloud with 5,000, 20,000 and 100,000 samples, by frames of all of "
        "them and by frames for which few answer, and tell what a frame takes and how far the shape still "
        "goes when the hand rests; and what a frame takes where a region of 5 % of the points may move");
    CLI::Option* files =
        command
            ->add_option(
                "--files", arguments->files,
                "Instead: write a million points in every format into this folder, and tell how "
                "fast they are loaded and saved beside a copy of the same bytes; nothing stays there")
            ->check(CLI::ExistingDirectory);
    CLI::Option* growth =
        add_points(*command, "--growth", arguments->growth, 10'000,
                   "Instead: how the stages grow with the points of a plane, from 10,000 up to so many, and "
                   "with the samples, from 100 to 100,000");
    CLI::Option* handles =
        add_points(*command, "--handles", arguments->handles, 100'000,
                   "Instead: how soon a handle more, or less, is live on planes of 100,000 points up to so "
                   "many, with 1000 and with 5000 samples");
    command->add_option("--picture", arguments->picture, "With --growth: draw it into this file (SVG)")
        ->needs(growth);
    window->excludes(rows, scans, drag, files, growth, handles, command->get_option("--repeat"));
    drag->excludes(rows, scans, files, growth, handles, command->get_option("--repeat"));
    files->excludes(rows, scans, growth, handles, command->get_option("--device"));
    growth->excludes(rows, scans, handles);
    handles->excludes(rows, scans);
    command->add_flag("--json", arguments->json, "Print one JSON object");
    command->callback([arguments, &job] {
        job = [arguments](Terminal& terminal) { return run_bench(*arguments, terminal); };
    });
}

} // namespace knead
