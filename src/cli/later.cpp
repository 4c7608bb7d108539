// What the command line promises and this version does not have yet: refused by name, never ignored.

#include "base/error.h"
#include "cli/commands.h"

#include <CLI/CLI.hpp>

namespace knead {

namespace {

void add_refused(CLI::App& app, Job& job, const std::string& name, const std::string& words) {
    CLI::App* command = app.add_subcommand(name, words);
    command->group(""); // not in the help
    command->prefix_command();
    command->callback([name, words, &job] {
        job = [name, words](Terminal&) -> int {
            throw Error(Trouble::usage, "",
                        "`knead " + name + "`, " + words + ", is not in this version of knead yet");
        };
    });
}

} // namespace

void add_later(CLI::App& app, Job& job) {
    add_refused(app, job, "edit", "the editor window");
    add_refused(app, job, "render", "pictures with no display");
}

} // namespace knead
