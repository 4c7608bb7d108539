// The program: parses the command line, runs one subcommand, and turns what it throws into words and an exit
// code.

#include "base/error.h"
#include "base/quoted.h"
#include "base/require.h"
#include "cli/commands.h"
#include "cli/cures.h"

#include <CLI/CLI.hpp>

#include <sched.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

namespace {

constexpr int exit_internal = 1;
constexpr int exit_usage = static_cast<int>(knead::Trouble::usage);
constexpr int exit_check_failed = static_cast<int>(knead::Trouble::check_failed);

int run(const knead::Job& job, knead::Terminal& terminal) {
    try {
        const int code = job(terminal);
        if (code == 0 || code == exit_check_failed) terminal.flush_data();
        return code;
    } catch (const knead::Cancelled&) {
        terminal.say("knead: stopped; nothing was written");
        return knead::exit_interrupted;
    } catch (const knead::Error& error) {
        terminal.say(std::string("knead: ") + error.what() + knead::advice_for(error.cure()));
        return static_cast<int>(error.trouble());
    } catch (const std::bad_alloc&) {
        terminal.say("knead: there is not enough memory for this");
        return exit_internal;
    } catch (const std::exception& error) {
        terminal.say(std::string("knead: internal error, please report it: ") + error.what());
        return exit_internal;
    }
}

bool is_subcommand(const CLI::App& app, const std::string& word) {
    const auto all = app.get_subcommands([](const CLI::App*) { return true; });
    return std::ranges::any_of(all, [&](const CLI::App* command) { return command->get_name() == word; });
}

// Whether the command line begins with a subcommand, or with what is asked of the whole program.
bool is_for_program(const CLI::App& app, const std::string& word) {
    const auto own = {"-h", "--help", "--help-all", "--version"};
    return is_subcommand(app, word) || std::ranges::find(own, word) != own.end();
}

// Whether it is neither an option nor a file; then this is said.
bool is_missing(const std::string& word) {
    std::error_code ignored;
    if (word.starts_with('-') || std::filesystem::exists(word, ignored)) return false;
    knead::Terminal terminal;
    const bool looks_like_file = word.find_first_of("./") != std::string::npos;
    terminal.say("knead: " + (looks_like_file
                                  ? "there is no file " + knead::quoted(word)
                                  : knead::quoted(word) + " is no file, and no subcommand either; "
                                                          "knead --help names these"));
    return true;
}

// An option whose value is an empty word is a mistake, of a script most likely: none takes it for not given.
void refuse_empty_values(CLI::App& app) {
    const CLI::Validator not_empty(
        [](const std::string& value) {
            return value.empty() ? std::string("must not be empty") : std::string();
        },
        "");
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        for (CLI::Option* option : command->get_options())
            if (option->get_items_expected_max() > 0) option->check(not_empty);
}

// "--out=" is such a mistake, too: CLI11 would take the next word for the value. Says so, if there is one.
bool has_empty_value(const std::vector<std::string>& arguments) {
    const auto found = std::ranges::find_if(arguments, [](const std::string& word) {
        return word.starts_with("--") && word.find('=') + 1 == word.size();
    });
    if (found == arguments.end()) return false;
    knead::Terminal().say("knead: " + found->substr(0, found->size() - 1) + ": must not be empty");
    return true;
}

// Has each thread of PoCL's stay on a core of its own, unless the user said otherwise: left alone, two that
// are woken together often share one for a whole frame, which then takes twice as long. They would be
// numbered from core 0, so all of these have to be ours. Before there is any other thread.
void keep_pocl_threads_apart() {
    cpu_set_t ours;
    if (sched_getaffinity(0, sizeof ours, &ours) != 0) return;
    for (int core = 0; core < CPU_COUNT(&ours); ++core)
        if (!CPU_ISSET(static_cast<unsigned>(core), &ours)) return;
    setenv("POCL_AFFINITY", "1", 0); // NOLINT(concurrency-mt-unsafe)
}

// Has Mesa's llvmpipe, where OpenGL runs on the processor, draw in the thread that calls it, unless the user
// said otherwise. Its threads signal a fence and then unlock it; the caller sees the signal without the lock,
// and may have freed the fence by then (lp_fence_signalled() of Mesa 22.3.6): four zero bytes are written
// into whatever that memory has become. The points are drawn by knead itself there, so that what is left for
// llvmpipe, a copy and the panels, takes hardly longer. Before there is any other thread.
void keep_llvmpipe_to_the_caller() {
    setenv("LP_NUM_THREADS", "0", 0); // NOLINT(concurrency-mt-unsafe)
}

// PoCL calls the linker by its name, and ends the whole program where that is not found: as for a service
// that is started with no environment at all. Before there is any other thread.
void let_pocl_find_its_linker() {
    setenv("PATH", "/usr/local/bin:/usr/bin:/bin", 0); // NOLINT(concurrency-mt-unsafe)
}

} // namespace

int main(int argc, char** argv) {
    keep_pocl_threads_apart();
    let_pocl_find_its_linker();
    keep_llvmpipe_to_the_caller();
    CLI::App app{"knead bends, twists and stretches raw point clouds with handles.", "knead"};
    app.require_subcommand(1);
    app.set_version_flag("--version", "knead " KNEAD_VERSION);
    app.failure_message([](const CLI::App*, const CLI::Error& error) {
        return std::string("knead: ") + error.what() +
               "\nRun with --help or --help-all for more information.\n";
    });
    app.set_help_all_flag("--help-all", "Show the help of every subcommand");

    knead::Job job;
    knead::add_edit(app, job);
    knead::add_replay(app, job);
    knead::add_info(app, job);
    knead::add_diff(app, job);
    knead::add_make(app, job);
    knead::add_devices(app, job);
    knead::add_bench(app, job);
    knead::add_evaluate(app, job);
    knead::add_render(app, job);

    refuse_empty_values(app);

    // `knead FILE`, `knead --size 800x600 FILE` and `knead` alone are `knead edit` with the same.
    std::vector<std::string> arguments(argv + std::min(1, argc), argv + argc);
    if (arguments.empty() || !is_for_program(app, arguments.front())) {
        if (!arguments.empty() && is_missing(arguments.front())) return exit_usage;
        arguments.insert(arguments.begin(), "edit");
    }
    if (has_empty_value(arguments)) return exit_usage;
    std::ranges::reverse(arguments); // as CLI11 takes them

    try {
        app.parse(arguments);
    } catch (const CLI::ParseError& error) {
        if (app.exit(error) != 0) return exit_usage;
        job = [](knead::Terminal& /*of what was asked about the program*/) { return 0; };
    }
    knead::Terminal terminal;
    return run(job, terminal);
}
