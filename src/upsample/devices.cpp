// Choosing a device by what the user typed.

#include "upsample/devices.h"

#include "base/error.h"
#include "base/lower_case.h"
#include "base/quoted.h"
#include "upsample/opencl_devices.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace knead {

namespace {

bool is_number(const std::string& text) {
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

[[noreturn]] void refuse(const std::string& request, const std::string& why,
                         const std::vector<DeviceDescription>& devices) {
    std::string choices;
    for (std::size_t i = 0; i < devices.size(); ++i)
        choices += std::to_string(i) + " (" + devices[i].name + "), ";
    throw Error(Trouble::usage, "device " + quoted(request), why + "; there are: " + choices + "reference");
}

std::size_t device_numbered(const std::string& request, const std::vector<DeviceDescription>& devices) {
    std::size_t number = 0;
    const auto [end, problem] = std::from_chars(request.data(), request.data() + request.size(), number);
    if (problem != std::errc() || number >= devices.size())
        refuse(request, "no device has this number", devices);
    return number;
}

std::size_t device_called(const std::string& request, const std::vector<DeviceDescription>& devices) {
    const std::string wanted = lower_case(request);
    std::vector<std::size_t> fitting;
    for (std::size_t i = 0; i < devices.size(); ++i)
        if (lower_case(devices[i].name).find(wanted) != std::string::npos) fitting.push_back(i);
    if (fitting.empty()) refuse(request, "no device has this in its name", devices);
    if (fitting.size() > 1) refuse(request, "several devices have this in their names", devices);
    return fitting.front();
}

UpsamplerChoice on_device(std::size_t device, Workers& workers, unsigned threads,
                          const std::shared_ptr<const GlSharing>& sharing) {
    try {
        auto upsampler = make_opencl_upsampler(device, workers, threads, {.sharing = sharing});
        return {make_fallback_upsampler(std::move(upsampler), workers), {}};
    } catch (const DeviceFailure& failure) {
        return {make_reference_upsampler(workers),
                std::string("the points are moved in plain C++, as ") + failure.what()};
    }
}

} // namespace

const char* name_of(DeviceType type) {
    switch (type) {
    case DeviceType::cpu:
        return "cpu";
    case DeviceType::gpu:
        return "gpu";
    case DeviceType::accelerator:
        return "accelerator";
    }
    return "";
}

std::vector<DeviceDescription> list_devices() {
    std::vector<DeviceDescription> descriptions;
    for (OpenClDevice& device : find_opencl_devices()) descriptions.push_back(std::move(device.description));
    return descriptions;
}

UpsamplerChoice make_upsampler(const std::string& request, Workers& workers, unsigned threads) {
    return make_drawing_upsampler(request, workers, threads, nullptr);
}

UpsamplerChoice make_drawing_upsampler(const std::string& request, Workers& workers, unsigned threads,
                                       std::shared_ptr<const GlSharing> sharing) {
    const std::string wanted = lower_case(request);
    if (wanted == "reference") return {make_reference_upsampler(workers), {}};
    const std::vector<DeviceDescription> devices = list_devices();
    if (wanted.empty() || wanted == "auto") {
        const auto best =
            std::find_if(devices.begin(), devices.end(), [](const auto& d) { return d.is_default; });
        if (best != devices.end())
            return on_device(static_cast<std::size_t>(best - devices.begin()), workers, threads, sharing);
        return {make_reference_upsampler(workers),
                "no OpenCL device was found, so the points are moved in plain C++; apt-get install "
                "pocl-opencl-icd adds one for the CPU, which needs a home folder that it can write to"};
    }
    return on_device(is_number(request) ? device_numbered(request, devices) : device_called(request, devices),
                     workers, threads, sharing);
}

} // namespace knead
