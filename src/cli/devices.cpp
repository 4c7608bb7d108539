// knead devices: what can move the points, and which one does unless told otherwise.

#include "upsample/devices.h"
#include "cli/commands.h"
#include "edit/json_text.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <iomanip>

namespace knead {

namespace {

using Json = nlohmann::ordered_json;

Json as_json(const std::vector<DeviceDescription>& devices) {
    Json list = Json::array();
    std::string chosen = "reference";
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const DeviceDescription& device = devices[i];
        list.push_back({{"index", i},
                        {"name", device.name},
                        {"platform", device.platform},
                        {"type", name_of(device.type)},
                        {"compute_units", device.compute_units},
                        {"memory_bytes", device.memory_bytes},
                        {"default", device.is_default}});
        if (device.is_default) chosen = device.name;
    }
    return {{"devices", list}, {"default", chosen}};
}

void write_table(const std::vector<DeviceDescription>& devices, std::ostream& out) {
    constexpr double gibibyte = 1024.0 * 1024.0 * 1024.0;
    bool reference_is_default = true;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const DeviceDescription& device = devices[i];
        out << i << "  " << device.name << (device.is_default ? "  (default)" : "") << "\n   "
            << name_of(device.type) << ", " << device.compute_units << " compute units, " << std::fixed
            << std::setprecision(1) << static_cast<double>(device.memory_bytes) / gibibyte << " GiB\n   "
            << device.platform << "\n";
        if (device.is_default) reference_is_default = false;
    }
    out << "reference  plain C++, no OpenCL" << (reference_is_default ? "  (default)" : "") << "\n";
}

int show_devices(Terminal& terminal, bool json) {
    const std::vector<DeviceDescription> devices = list_devices();
    if (json)
        terminal.out << json_text(as_json(devices)) << "\n";
    else
        write_table(devices, terminal.out);
    if (devices.empty())
        terminal.say(
            "There is no OpenCL device, so the reference is used: plain C++ on all cores. apt-get install "
            "pocl-opencl-icd adds one for the CPU, which needs a home folder that it can write to.");
    return 0;
}

} // namespace

void add_devices(CLI::App& app, Job& job) {
    CLI::App* command = app.add_subcommand("devices", "Show the OpenCL devices, and which one is used");
    auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "Print one JSON object");
    command->callback(
        [json, &job] { job = [json](Terminal& terminal) { return show_devices(terminal, *json); }; });
}

} // namespace knead
