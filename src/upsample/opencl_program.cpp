#include "upsample/opencl_program.h"

#include "upsample/influence_groups.h"
#include "upsample/point_blocks.h"

#include <algorithm>
#include <string>

namespace knead {

namespace {

std::size_t lanes_of(KernelShape shape) {
    return shape == KernelShape::sixteen_at_once ? 16 : 4;
}

std::string build_log(cl_program program, cl_device_id device) {
    std::size_t size = 0;
    if (clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, 0, nullptr, &size) != CL_SUCCESS ||
        size == 0)
        return "no build log";
    std::string log(size, '\0');
    if (clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, size, log.data(), nullptr) != CL_SUCCESS)
        return "no build log";
    log.resize(std::min(log.size(), log.find('\0')));
    return log;
}

// Root and quotient are rounded correctly where the device can do so, as in C++.
std::string build_options(cl_device_id device, KernelShape shape) {
    std::string options = "-D POINTS_IN_BLOCK=" + std::to_string(points_in_block) +
                          " -D POINTS_IN_GROUP=" + std::to_string(points_in_group) +
                          " -D WHOLE_SHARE=" + std::to_string(whole_share) +
                          " -D LANES=" + std::to_string(lanes_of(shape));
    cl_device_fp_config floats = 0;
    if (clGetDeviceInfo(device, CL_DEVICE_SINGLE_FP_CONFIG, sizeof floats, &floats, nullptr) == CL_SUCCESS &&
        (floats & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0)
        options += " -cl-fp32-correctly-rounded-divide-sqrt";
    return options;
}

} // namespace

std::size_t items_per_block(KernelShape shape) {
    return shape == KernelShape::sixteen_at_once ? 1 : points_in_block / lanes_of(shape);
}

ProgramHandle build_program(cl_context context, cl_device_id device, const char* text, KernelShape shape) {
    cl_int code = CL_SUCCESS;
    ProgramHandle program(clCreateProgramWithSource(context, 1, &text, nullptr, &code));
    check_opencl(code, "reading the kernel");
    const std::string options = build_options(device, shape);
    code = clBuildProgram(program.get(), 1, &device, options.c_str(), nullptr, nullptr);
    if (code == CL_BUILD_PROGRAM_FAILURE)
        throw DeviceFailure("the kernel does not compile: " + build_log(program.get(), device));
    check_opencl(code, "building the kernel");
    return program;
}

KernelHandle kernel_named(cl_program program, const char* name) {
    cl_int code = CL_SUCCESS;
    KernelHandle kernel(clCreateKernel(program, name, &code));
    check_opencl(code, "finding the kernel");
    return kernel;
}

} // namespace knead
