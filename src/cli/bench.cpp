// knead bench: the paper's Table 1, measured on this machine.

#include "bench/table1.h"
#include "cli/commands.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace knead {

namespace {

struct BenchArguments {
    std::vector<std::string> rows;
    std::string scans, device;
    std::size_t repeats = 5;
    unsigned threads = 0;
    bool json = false;
};

int run_bench(const BenchArguments& arguments, Terminal& terminal) {
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
    command->add_option("--threads", arguments->threads, "How many threads to use (default: one a core)")
        ->check(CLI::Range(1U, 1024U));
    command->add_option("--device", arguments->device,
                        "An OpenCL device by number or name, or \"reference\"");
    command
        ->add_option("--scans", arguments->scans,
                     "The folder of the scans (default: KNEAD_SCANS, then ../shared/scans)")
        ->check(CLI::ExistingDirectory);
    command->add_flag("--json", arguments->json, "Print one JSON object");
    command->callback([arguments, &job] {
        job = [arguments](Terminal& terminal) { return run_bench(*arguments, terminal); };
    });
}

} // namespace knead
