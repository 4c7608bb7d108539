// knead edit [FILE]: the editor window.

#include "base/error.h"
#include "base/quoted.h"
#include "cli/commands.h"

#include <CLI/CLI.hpp>

#include <memory>

#ifdef KNEAD_HAS_EDITOR
#include "app/run_editor.h"
#include "cli/picture_options.h"
#endif

namespace knead {

namespace {

struct Arguments {
    std::string file, cloud, device, size, samples;
    std::vector<std::string> settings;
    unsigned threads = 0;
};

#ifdef KNEAD_HAS_EDITOR

// "1440x900"
void take_size(const std::string& text, EditorOptions& options) {
    const Viewport size = parse_size(text, 16384);
    if (size.width < 640 || size.height < 420)
        throw Error(Trouble::usage, "--size",
                    "must be a width and a height of at least 640x420, as 1440x900, not " + quoted(text));
    options.width = size.width;
    options.height = size.height;
}

int run_edit(const Arguments& arguments, Terminal& terminal) {
    EditorOptions options;
    options.file = arguments.file;
    if (!arguments.cloud.empty()) options.cloud = arguments.cloud;
    options.device = arguments.device;
    options.threads = arguments.threads;
    if (!arguments.size.empty()) take_size(arguments.size, options);
    for (const std::string& assignment : arguments.settings)
        options.settings = merged(options.settings, parse_setting(assignment));
    if (!arguments.samples.empty())
        options.settings = merged(options.settings, parse_setting("samples=" + arguments.samples));
    options.told_to_stop = [&terminal] { return terminal.cancelled(); };
    try {
        run_editor(options);
    } catch (const Cancelled&) {
        terminal.say("knead: stopped; what was done and not saved is offered when it is opened again");
        return exit_interrupted;
    }
    return 0;
}

#else

int run_edit(const Arguments& /*arguments*/, Terminal& /*terminal*/) {
    throw Error(Trouble::usage, "",
                "this knead was built without its window (KNEAD_EDITOR=OFF); `knead info` looks at a cloud, "
                "`knead replay` carries out a session");
}

#endif

} // namespace

void add_edit(CLI::App& app, Job& job) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("edit", "Open the editor window; `knead FILE` does the same");
    command->add_option("FILE", arguments->file, "A cloud or a session; none: an empty window");
    command->add_option("--cloud", arguments->cloud,
                        "Another cloud than the session's; of as many points, if it says how many");
    command->add_option("--set", arguments->settings, "A setting, key=value; may be repeated")
        ->allow_extra_args(false);
    command->add_option("--samples", arguments->samples, "Short for --set samples=N, or all");
    add_device_options(*command, arguments->device, arguments->threads);
    command->add_option("--size", arguments->size, "Of the window, WxH (default: as it was left)");
    command->callback([arguments, &job] {
        job = [arguments](Terminal& terminal) { return run_edit(*arguments, terminal); };
    });
}

} // namespace knead
