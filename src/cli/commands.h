#pragma once
// The subcommands, one file each: a function declares the arguments to CLI11 and, when its subcommand was
// chosen, puts what is to be done into `job`.

#include "cli/terminal.h"

#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace knead {

inline constexpr int exit_interrupted = 130;

// Does the work and returns the exit code: 0, 4 when a check failed, or 130 where the window was told to
// stop. All other troubles are thrown.
using Job = std::function<int(Terminal&)>;

// --device and --threads (left as they are where they are not given), of subcommands that compute.
void add_device_options(CLI::App& command, std::string& device, unsigned& threads);

void add_edit(CLI::App& app, Job& job);
void add_replay(CLI::App& app, Job& job);
void add_info(CLI::App& app, Job& job);
void add_diff(CLI::App& app, Job& job);
void add_make(CLI::App& app, Job& job);
void add_devices(CLI::App& app, Job& job);
void add_bench(CLI::App& app, Job& job);
void add_evaluate(CLI::App& app, Job& job);
void add_render(CLI::App& app, Job& job);

} // namespace knead
