#pragma once
// Private to this room: OpenCL objects that release themselves, and its error codes as exceptions.

#include "upsample/upsample.h"

#include <CL/cl.h>

#include <type_traits>

namespace knead {

template<auto release>
struct OpenClRelease {
    template<typename Object>
    void operator()(Object* object) const {
        release(object);
    }
};

template<typename Handle, auto release>
using OpenClHandle = std::unique_ptr<std::remove_pointer_t<Handle>, OpenClRelease<release>>;

using DeviceHandle = OpenClHandle<cl_device_id, clReleaseDevice>;
using ContextHandle = OpenClHandle<cl_context, clReleaseContext>;
using QueueHandle = OpenClHandle<cl_command_queue, clReleaseCommandQueue>;
using ProgramHandle = OpenClHandle<cl_program, clReleaseProgram>;
using KernelHandle = OpenClHandle<cl_kernel, clReleaseKernel>;
using EventHandle = OpenClHandle<cl_event, clReleaseEvent>;
using BufferHandle = OpenClHandle<cl_mem, clReleaseMemObject>;

// Throws DeviceFailure unless `code` is CL_SUCCESS. `doing` completes "OpenCL failed in ...".
void check_opencl(cl_int code, const char* doing);

} // namespace knead
