#pragma once
// Private to this room: the points as an OpenCL device has them, and a frame of them.

#include "upsample/changed_blocks.h"
#include "upsample/opencl_calls.h"
#include "upsample/opencl_program.h"

namespace knead {

// A rest shape, and what moves which of its points, on a device. Never changed, so that several threads may
// compute frames of it, each with a queue, a kernel and results of its own.
struct PointsOnDevice {
    cl_device_id device = nullptr;
    std::shared_ptr<std::remove_pointer_t<cl_context>> context;
    std::shared_ptr<std::remove_pointer_t<cl_program>> program;
    KernelShape shape = KernelShape::many_items;
    std::size_t points = 0;
    std::size_t motions = 0; // the one that moves nothing included
    BufferHandle positions, normals, groups, entry_motions, shares;
    cl_uint first_handle = 0;
    ChangedBlocks changes; // before any frame
};

// The kernel that moves them; another one for another thread.
inline KernelHandle moving_kernel(const PointsOnDevice& on_device) {
    return kernel_named(on_device.program.get(),
                        on_device.normals ? "upsample_positions_and_normals" : "upsample_positions");
}

// For that kernel: what it moves of the first `points`, by which motions, and where to.
inline void set_moving(cl_kernel kernel, const PointsOnDevice& on_device, cl_ulong points, cl_mem blocks,
                       cl_mem motions, cl_mem moved_positions, cl_mem moved_normals) {
    cl_mem const positions = on_device.positions.get();
    cl_mem const groups = on_device.groups.get();
    cl_mem const entry_motions = on_device.entry_motions.get();
    cl_mem const shares = on_device.shares.get();
    cl_mem const normals = on_device.normals.get();
    if (normals)
        set_arguments(kernel, points, blocks, positions, groups, entry_motions, shares,
                      on_device.first_handle, motions, moved_positions, normals, moved_normals);
    else
        set_arguments(kernel, points, blocks, positions, groups, entry_motions, shares,
                      on_device.first_handle, motions, moved_positions);
}

// What Upsampler::frame() hands out.
struct DeviceFrame {
    std::shared_ptr<const PointsOnDevice> points;
    std::vector<PackedMotion> motions; // the one that moves nothing comes first
};

} // namespace knead
