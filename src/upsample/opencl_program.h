#pragma once
// Private to this room: kernels/upsample.cl as a device runs it.

#include "upsample/opencl_handles.h"

#include <CL/cl.h>

namespace knead {

// How the kernel moves the points of a block: sixteen at once, all by one item, which is for a CPU, or four
// by each of many items, which is for a GPU.
enum class KernelShape { sixteen_at_once, many_items };

// How many items move a block.
std::size_t items_per_block(KernelShape shape);

// Builds `text`. Throws DeviceFailure, with the compiler's words where it is the text.
ProgramHandle build_program(cl_context context, cl_device_id device, const char* text, KernelShape shape);

// Throws DeviceFailure where the program has no such kernel.
KernelHandle kernel_named(cl_program program, const char* name);

} // namespace knead
