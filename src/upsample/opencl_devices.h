#pragma once
// Private to this room: the devices of list_devices() as OpenCL knows them.

#include "upsample/devices.h"
#include "upsample/opencl_handles.h"

namespace knead {

struct OpenClDevice {
    cl_device_id id = nullptr; // of the platform; needs no release
    DeviceDescription description;
};

// All that there are; none where there is no OpenCL.
std::vector<cl_platform_id> opencl_platforms();

// In the order of list_devices().
std::vector<OpenClDevice> find_opencl_devices();

// A part of a CPU device with so many compute units, or null where the device has no more than that anyway,
// is no CPU, or `threads` is 0. Throws DeviceFailure if the device cannot be divided.
DeviceHandle limited_to(const OpenClDevice& device, unsigned threads);

struct GlSharing {
    cl_device_id device = nullptr;
    std::shared_ptr<std::remove_pointer_t<cl_context>> context;
};

} // namespace knead
