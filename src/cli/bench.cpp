// knead bench: the paper's Table 1, and how well the window follows the hand, measured on this machine.

#include "bench/table1.h"
#include "cli/commands.h"

#include <CLI/CLI.hpp>

#include <memory>

#ifdef KNEAD_HAS_EDITOR
#include "app/drag_benchmark.h"
#else
#include "base/error.h"
#endif

namespace knead {

namespace {

struct BenchArguments {
    std::vector<std::string> rows;
    std::string scans, device, window;
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

int run_bench(const BenchArguments& arguments, Terminal& terminal) {
    if (!arguments.window.empty()) return run_window_bench(arguments, terminal);
    const std::vector<Table1Row> rows = rows_named(arguments.rows);
    const Table1Options options{arguments.repeats, arguments.threads, arguments.device,
                                scan_folders(arguments.scans)};
    const Table1 table = measure_table1(rows, options, terminal);
    for (const std::string& words : table.warnings) terminal.warn(words);
    terminal.out << (arguments.json ? table1_json(table) + "\n" : table1_text(table));
    return 0;
}

} // namespace

void add_bench(CLI::App& app, Job& job) {
    const auto arguments = std::make_shared<BenchArguments>();
    CLI::App* command = app.add_subcommand("bench", "Measure the paper's Table 1 on this machine");
    command->add_option("ROW", arguments->rows,
                        "Rows by model or model/samples: dragon, bunny/1000 (default: all)");
    command->add_option("--repeat", arguments->repeats, "How often each cloud is set up (default: 5)")
        ->check(CLI::Range(std::size_t{1}, std::size_t{1000}));
    add_device_options(*command, arguments->device, arguments->threads);
    command
        ->add_option("--scans", arguments->scans,
                     "The folder of the scans (default: KNEAD_SCANS, then ../shared/scans)")
        ->check(CLI::ExistingDirectory);
    command->add_option(
        "--window", arguments->window,
        "Instead: open this cloud in the window, drag a handle of it for some seconds, and tell "
        "how old the pose on the screen is");
    command->add_flag("--json", arguments->json, "Print one JSON object");
    command->callback([arguments, &job] {
        job = [arguments](Terminal& terminal) { return run_bench(*arguments, terminal); };
    });
}

} // namespace knead
