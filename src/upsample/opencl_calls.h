#pragma once
// Private to this room: what every user of a device calls.

#include "upsample/opencl_handles.h"

namespace knead {

inline BufferHandle make_buffer(cl_context context, cl_mem_flags flags, std::size_t bytes, void* host) {
    cl_int code = CL_SUCCESS;
    BufferHandle buffer(clCreateBuffer(context, flags, bytes, host, &code));
    check_opencl(code, "allocating memory");
    return buffer;
}

template<typename... Arguments>
void set_arguments(cl_kernel kernel, const Arguments&... arguments) {
    cl_uint place = 0;
    // A buffer is passed as its handle, a pointer. NOLINTNEXTLINE(bugprone-sizeof-expression)
    (check_opencl(clSetKernelArg(kernel, place++, sizeof(Arguments), &arguments), "passing an argument"),
     ...);
}

// What a call has to wait for. Each call of a frame names the one before it: so that a kernel or a copy that
// fails on the device fails the call that waits for the result, which an order in the queue alone need not
// do.
struct After {
    explicit After(const EventHandle& done) : event(done.get()) {}
    cl_event event;
    cl_uint count() const { return event ? 1 : 0; }
    const cl_event* list() const { return event ? &event : nullptr; }
};

// Starts writing into a buffer from its beginning on; `values` must stay as they are until that is done.
template<typename Value>
EventHandle write_buffer(cl_command_queue queue, cl_mem buffer, std::span<const Value> values,
                         const After& after, const char* doing) {
    cl_event written = nullptr;
    check_opencl(clEnqueueWriteBuffer(queue, buffer, CL_FALSE, 0, values.size_bytes(), values.data(),
                                      after.count(), after.list(), &written),
                 doing);
    return EventHandle(written);
}

// Starts a kernel whose arguments are set, with so many groups of items.
inline EventHandle launch(cl_command_queue queue, cl_kernel kernel, std::size_t groups,
                          std::size_t items_per_group, const After& after) {
    const std::size_t items = groups * items_per_group;
    cl_event done = nullptr;
    check_opencl(clEnqueueNDRangeKernel(queue, kernel, 1, nullptr, &items, &items_per_group, after.count(),
                                        after.list(), &done),
                 "launching the kernel");
    return EventHandle(done);
}

} // namespace knead
