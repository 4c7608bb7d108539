// knead evaluate: how good the deformed shapes are, and whether what must hold does hold.

#include "base/temporary_folder.h"
#include "bench/evaluation.h"
#include "bench/page.h"
#include "cli/commands.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace knead {

namespace {

struct EvaluateArguments {
    std::vector<std::string> shapes;
    std::string scans, survey, device, page;
    unsigned threads = 0;
    bool json = false;
};

// The name that measures nothing, for the page alone.
constexpr const char* page_name = "page";

int run_evaluate(const EvaluateArguments& arguments, Terminal& terminal) {
    EvaluationOptions options{scan_folders(arguments.scans), survey_folders(arguments.survey),
                              arguments.shapes, arguments.device, arguments.threads};
    const bool with_page = !arguments.page.empty();
    const std::filesystem::path folder = folder_of(arguments.page);
    if (with_page) {
        std::erase(options.shapes, std::string(page_name));
        refuse_bad_page(folder);
    }
    const bool page_alone = with_page && options.shapes.empty() && !arguments.shapes.empty();
    Evaluation evaluation;
    if (!page_alone) evaluation = evaluate(options, terminal);
    if (with_page) {
        write_evaluation_page({folder, options.scans, options.survey, options.device, options.threads},
                              terminal);
        terminal.say("wrote " + (folder / "index.html").string());
    }
    if (page_alone) return 0;
    for (const std::string& words : evaluation.warnings) terminal.warn(words);
    terminal.out << (arguments.json ? evaluation_json(evaluation) + "\n" : evaluation_text(evaluation));
    return 0;
}

} // namespace

void add_evaluate(CLI::App& app, Job& job) {
    const auto arguments = std::make_shared<EvaluateArguments>();
    CLI::App* command = app.add_subcommand("evaluate", "Measure how good the deformed shapes are");
    command->add_option(
        "--shape", arguments->shapes,
        "Only these: bar, cactus, cylinder, plane (the survey's), made-bar (and a long one twisted), "
        "made-solid-bar, made-knot, made-creature; elasticity, sampling, turns, stiffness, demands, small; "
        "samples-bunny, samples-armadillo, samples-dragon, samples-horse, samples-lidar, samples-room; "
        "a scan without .ply; with --page, \"page\": nothing (default: all)");
    command
        ->add_option("--survey", arguments->survey,
                     "The folder of the survey shapes (default: KNEAD_SURVEY, then ../shared/survey)")
        ->check(CLI::ExistingDirectory);
    command
        ->add_option("--scans", arguments->scans,
                     "The folder of the scans (default: KNEAD_SCANS, then ../shared/scans)")
        ->check(CLI::ExistingDirectory);
    add_device_options(*command, arguments->device, arguments->threads);
    command
        ->add_option(
            "--page", arguments->page,
            "Also write a page of pictures into this folder: index.html and what belongs to it; with "
            "--shape page nothing else is done")
        ->type_name("FOLDER");
    command->add_flag("--json", arguments->json, "Print one JSON object");
    command->callback([arguments, &job] {
        job = [arguments](Terminal& terminal) { return run_evaluate(*arguments, terminal); };
    });
}

} // namespace knead
