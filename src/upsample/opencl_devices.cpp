#include "upsample/opencl_devices.h"

#include <algorithm>
#include <optional>

namespace knead {

namespace {

constexpr const char* codes_in_words(cl_int code) {
    switch (code) {
    case CL_DEVICE_NOT_FOUND:
        return "no such device";
    case CL_DEVICE_NOT_AVAILABLE:
        return "the device is not available";
    case CL_COMPILER_NOT_AVAILABLE:
        return "there is no compiler";
    case CL_MEM_OBJECT_ALLOCATION_FAILURE:
        return "the device's memory is too small";
    case CL_OUT_OF_RESOURCES:
        return "out of resources";
    case CL_OUT_OF_HOST_MEMORY:
        return "out of memory";
    case CL_BUILD_PROGRAM_FAILURE:
        return "the kernel does not compile";
    case CL_DEVICE_PARTITION_FAILED:
        return "the device cannot be divided";
    case CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST:
        return "what it has to wait for failed on the device";
    case CL_INVALID_VALUE:
        return "an invalid value";
    case CL_INVALID_BUFFER_SIZE:
        return "more memory in one piece than the device has";
    case CL_INVALID_WORK_GROUP_SIZE:
        return "an invalid work-group size";
    case CL_INVALID_COMMAND_QUEUE:
        return "the device was lost";
    default:
        return "see the code in CL/cl.h";
    }
}

template<typename Value>
std::optional<Value> device_info(cl_device_id device, cl_device_info what) {
    Value value = {};
    if (clGetDeviceInfo(device, what, sizeof value, &value, nullptr) != CL_SUCCESS) return std::nullopt;
    return value;
}

// Text of a device or a platform, without the spaces that some drivers pad it with; empty if it has none.
template<typename Object, typename What>
std::string text_info(cl_int (*query)(Object, What, std::size_t, void*, std::size_t*), Object object,
                      What what) {
    std::size_t size = 0;
    if (query(object, what, 0, nullptr, &size) != CL_SUCCESS || size == 0) return {};
    std::string text(size, '\0');
    if (query(object, what, size, text.data(), nullptr) != CL_SUCCESS) return {};
    text.resize(std::min(text.size(), text.find('\0')));
    const std::size_t first = text.find_first_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::optional<DeviceType> type_of(cl_device_id device) {
    const cl_device_type type = device_info<cl_device_type>(device, CL_DEVICE_TYPE).value_or(0);
    if (type & CL_DEVICE_TYPE_GPU) return DeviceType::gpu;
    if (type & CL_DEVICE_TYPE_CPU) return DeviceType::cpu;
    if (type & CL_DEVICE_TYPE_ACCELERATOR) return DeviceType::accelerator;
    return std::nullopt;
}

bool is_usable(cl_device_id device) {
    return device_info<cl_bool>(device, CL_DEVICE_AVAILABLE).value_or(CL_FALSE) == CL_TRUE &&
           device_info<cl_bool>(device, CL_DEVICE_COMPILER_AVAILABLE).value_or(CL_FALSE) == CL_TRUE;
}

void add_devices_of(cl_platform_id platform, std::vector<OpenClDevice>& found) {
    cl_uint count = 0;
    if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &count) != CL_SUCCESS) return;
    std::vector<cl_device_id> ids(count);
    if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, count, ids.data(), nullptr) != CL_SUCCESS) return;
    const std::string words =
        text_info(clGetPlatformInfo, platform, static_cast<cl_platform_info>(CL_PLATFORM_NAME)) + ", " +
        text_info(clGetPlatformInfo, platform, static_cast<cl_platform_info>(CL_PLATFORM_VERSION));
    for (cl_device_id id : ids) {
        const std::optional<DeviceType> type = type_of(id);
        if (!type || !is_usable(id)) continue;
        DeviceDescription description;
        description.name = text_info(clGetDeviceInfo, id, static_cast<cl_device_info>(CL_DEVICE_NAME));
        description.platform = words;
        description.type = *type;
        description.compute_units = device_info<cl_uint>(id, CL_DEVICE_MAX_COMPUTE_UNITS).value_or(0);
        description.memory_bytes = device_info<cl_ulong>(id, CL_DEVICE_GLOBAL_MEM_SIZE).value_or(0);
        found.push_back({id, std::move(description)});
    }
}

void mark_default(std::vector<OpenClDevice>& devices) {
    for (const DeviceType type : {DeviceType::gpu, DeviceType::cpu}) {
        const auto best = std::find_if(devices.begin(), devices.end(), [type](const OpenClDevice& device) {
            return device.description.type == type;
        });
        if (best == devices.end()) continue;
        best->description.is_default = true;
        return;
    }
}

} // namespace

void check_opencl(cl_int code, const char* doing) {
    if (code == CL_SUCCESS) return;
    throw DeviceFailure(std::string("OpenCL failed in ") + doing + ": " + codes_in_words(code) + ", code " +
                        std::to_string(code));
}

std::vector<cl_platform_id> opencl_platforms() {
    cl_uint count = 0;
    if (clGetPlatformIDs(0, nullptr, &count) != CL_SUCCESS || count == 0) return {};
    std::vector<cl_platform_id> platforms(count);
    if (clGetPlatformIDs(count, platforms.data(), nullptr) != CL_SUCCESS) return {};
    return platforms;
}

std::vector<OpenClDevice> find_opencl_devices() {
    std::vector<OpenClDevice> found;
    for (cl_platform_id platform : opencl_platforms()) add_devices_of(platform, found);
    mark_default(found);
    return found;
}

DeviceHandle limited_to(const OpenClDevice& device, unsigned threads) {
    const DeviceDescription& description = device.description;
    if (threads == 0 || description.type != DeviceType::cpu || description.compute_units <= threads)
        return nullptr;
    const cl_device_partition_property by_counts[] = {CL_DEVICE_PARTITION_BY_COUNTS,
                                                      static_cast<cl_device_partition_property>(threads),
                                                      CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
    cl_device_id part = nullptr;
    check_opencl(clCreateSubDevices(device.id, by_counts, 1, &part, nullptr),
                 "limiting the device's threads");
    return DeviceHandle(part);
}

} // namespace knead
