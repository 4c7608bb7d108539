// The options of every subcommand that computes.

#include "cli/commands.h"

#include <CLI/CLI.hpp>

namespace knead {

void add_device_options(CLI::App& command, std::string& device, unsigned& threads) {
    command.add_option("--device", device, "An OpenCL device by number or name, or \"reference\"");
    command.add_option("--threads", threads, "How many threads to use (default: one a core)")
        ->check(CLI::Range(1U, 1024U));
}

} // namespace knead
