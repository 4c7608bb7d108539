#pragma once
// Private to this room: the points as an OpenCL device has them, and a frame of them.

#include "base/locked.h"
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

// Motions of frames that nobody has any more, to be written over: making a frame takes no memory but a
// handful.
using SpentMotions = Locked<std::vector<std::vector<PackedMotion>>>;

// What Upsampler::frame() hands out.
struct DeviceFrame {
    DeviceFrame(std::shared_ptr<const PointsOnDevice> points_, std::vector<PackedMotion> motions_,
                std::shared_ptr<SpentMotions> spent_)
        : points(std::move(points_)), motions(std::move(motions_)), spent(std::move(spent_)) {}
    ~DeviceFrame() {
        spent->with([&](auto& all) {
            if (all.size() < all.capacity()) all.push_back(std::move(motions));
        });
    }
    DeviceFrame(const DeviceFrame&) = delete;
    DeviceFrame& operator=(const DeviceFrame&) = delete;

    std::shared_ptr<const PointsOnDevice> points;
    std::vector<PackedMotion> motions; // the one that moves nothing comes first
    std::shared_ptr<SpentMotions> spent;
};

// Room for those of a frame that is drawn, of one that waits for that, and of two that are made.
inline std::shared_ptr<SpentMotions> no_spent_motions() {
    auto spent = std::make_shared<SpentMotions>();
    spent->with([](auto& all) { all.reserve(4); });
    return spent;
}

} // namespace knead
