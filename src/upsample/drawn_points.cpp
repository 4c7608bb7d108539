#include "upsample/drawing.h"

#include "base/require.h"
#include "upsample/on_device.h"
#include "upsample/point_blocks.h"

#include <CL/cl_gl.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace knead {

namespace {

constexpr PointBox no_box = [] {
    constexpr float huge = std::numeric_limits<float>::max();
    return PointBox{huge, huge, huge, -huge, -huge, -huge};
}();

// OpenCL's view of a buffer of OpenGL's.
BufferHandle shared_buffer(cl_context context, unsigned name) {
    cl_int code = CL_SUCCESS;
    BufferHandle buffer(clCreateFromGLBuffer(context, CL_MEM_READ_WRITE, name, &code)); // boxes read it
    check_opencl(code, "sharing a buffer with OpenGL");
    return buffer;
}

// OpenCL has these buffers, on a queue, for as long as this lives; release() says whether it went well. None
// where they are no buffers of OpenGL's.
class Acquired {
public:
    Acquired(cl_command_queue queue, std::span<const cl_mem> buffers) : queue_(queue), buffers_(buffers) {
        if (buffers_.empty()) return;
        check_opencl(clEnqueueAcquireGLObjects(queue_, count(), buffers_.data(), 0, nullptr, nullptr),
                     "taking the buffers from OpenGL");
    }
    ~Acquired() {
        if (is_released_) return;
        if (!buffers_.empty())
            (void)clEnqueueReleaseGLObjects(queue_, count(), buffers_.data(), 0, nullptr, nullptr);
        (void)clFinish(queue_); // what a call that failed left under way may read the frame
    }
    Acquired(const Acquired&) = delete;
    Acquired& operator=(const Acquired&) = delete;

    void release() {
        if (!buffers_.empty())
            check_opencl(clEnqueueReleaseGLObjects(queue_, count(), buffers_.data(), 0, nullptr, nullptr),
                         "giving the buffers back to OpenGL");
        is_released_ = true;
        check_opencl(clFinish(queue_), "moving the points where they are drawn");
    }

private:
    cl_uint count() const { return static_cast<cl_uint>(buffers_.size()); }
    cl_command_queue queue_;
    std::span<const cl_mem> buffers_;
    bool is_released_ = false;
};

double seconds_of(const EventHandle& event) {
    cl_ulong begin = 0, end = 0;
    if (clGetEventProfilingInfo(event.get(), CL_PROFILING_COMMAND_START, sizeof begin, &begin, nullptr) !=
            CL_SUCCESS ||
        clGetEventProfilingInfo(event.get(), CL_PROFILING_COMMAND_END, sizeof end, &end, nullptr) !=
            CL_SUCCESS)
        return 0;
    return static_cast<double>(end - begin) * 1e-9;
}

QueueHandle timed_queue(const PointsOnDevice& points) {
    cl_int code = CL_SUCCESS;
    QueueHandle queue(
        clCreateCommandQueue(points.context.get(), points.device, CL_QUEUE_PROFILING_ENABLE, &code));
    check_opencl(code, "making a queue");
    return queue;
}

} // namespace

struct DrawnPoints::State {
    // Of the last frame, whose points themselves are kept by frames alone: they may take much memory.
    std::weak_ptr<const PointsOnDevice> of;
    std::shared_ptr<std::remove_pointer_t<cl_context>> context;
    std::size_t count = 0;
    QueueHandle queue;
    KernelHandle moving, bounding;
    BufferHandle motions, blocks, block_boxes;
    ChangedBlocks changes;
    Buffers names;
    BufferHandle positions, normals; // where the points go
    bool in_own_memory = false;
    std::vector<PointBox> boxes, written_boxes;
    double seconds = 0;

    void take(const std::shared_ptr<const PointsOnDevice>& points);
    void aim_at(const PointsOnDevice& points, Buffers buffers);
    void aim_at_own(const PointsOnDevice& points);
    void move(const DeviceFrame& frame, Held held);
    void bound(std::span<const Index> moved, const PointsOnDevice& points, const After& after);
};

// Other points than before, or others that move them: everything is made anew, but for the results where
// these fit.
void DrawnPoints::State::take(const std::shared_ptr<const PointsOnDevice>& points) {
    if (count > 0 && of.lock() == points) return;
    State next;
    next.context = points->context;
    next.count = points->points;
    next.queue = timed_queue(*points);
    next.moving = moving_kernel(*points);
    next.bounding = kernel_named(points->program.get(), "bound_blocks");
    const std::size_t in_blocks = blocks_of(next.count);
    cl_context where = next.context.get();
    next.motions = make_buffer(where, CL_MEM_READ_ONLY, points->motions * sizeof(PackedMotion), nullptr);
    next.blocks = make_buffer(where, CL_MEM_READ_ONLY, in_blocks * sizeof(Index), nullptr);
    next.block_boxes = make_buffer(where, CL_MEM_WRITE_ONLY, in_blocks * sizeof(PointBox), nullptr);
    next.changes = points->changes;
    next.boxes.assign(in_blocks, no_box);
    next.written_boxes.resize(in_blocks);
    const bool has_normals = points->normals != nullptr;
    if (context == next.context && count == next.count && has_normals == (normals != nullptr)) {
        next.names = names;
        next.in_own_memory = in_own_memory;
        next.positions = std::move(positions);
        next.normals = std::move(normals);
    }
    next.of = points;
    *this = std::move(next);
}

void DrawnPoints::State::aim_at(const PointsOnDevice& points, Buffers buffers) {
    if (positions && !in_own_memory && names == buffers) return;
    require(!points.normals || buffers.normals != 0, "a buffer for normals where there are any");
    positions.reset();
    changes = points.changes;
    names = buffers;
    in_own_memory = false;
    normals = points.normals ? shared_buffer(context.get(), buffers.normals) : nullptr;
    positions = shared_buffer(context.get(), buffers.positions);
}

void DrawnPoints::State::aim_at_own(const PointsOnDevice& points) {
    if (positions && in_own_memory) return;
    const std::size_t bytes = 3 * count * sizeof(float);
    positions.reset();
    changes = points.changes;
    in_own_memory = true;
    normals = points.normals ? make_buffer(context.get(), CL_MEM_READ_WRITE, bytes, nullptr) : nullptr;
    positions = make_buffer(context.get(), CL_MEM_READ_WRITE, bytes, nullptr);
}

void DrawnPoints::State::move(const DeviceFrame& frame, Held held) {
    const PointsOnDevice& points = *frame.points;
    const std::span<const Index> moved = changes.of_frame(std::span(frame.motions).subspan(1), {}, {}, held);
    seconds = 0;
    if (!moved.empty()) {
        const std::array<cl_mem, 2> results{positions.get(), normals.get()};
        const std::size_t shared = in_own_memory ? 0 : normals ? 2 : 1;
        Acquired acquired(queue.get(), std::span(results).first(shared));
        EventHandle done = write_buffer(queue.get(), motions.get(), std::span(frame.motions), After(nullptr),
                                        "writing the motions");
        done = write_buffer(queue.get(), blocks.get(), moved, After(done), "writing what moves");
        set_moving(moving.get(), points, count, blocks.get(), motions.get(), positions.get(), normals.get());
        const EventHandle ran =
            launch(queue.get(), moving.get(), moved.size(), items_per_block(points.shape), After(done));
        bound(moved, points, After(ran));
        acquired.release();
        seconds = seconds_of(ran);
    }
    changes.note_written();
}

// The boxes of what moved.
void DrawnPoints::State::bound(std::span<const Index> moved, const PointsOnDevice& points,
                               const After& after) {
    cl_mem const block_list = blocks.get(), moved_positions = positions.get(), results = block_boxes.get();
    const cl_ulong all = count;
    set_arguments(bounding.get(), all, block_list, moved_positions, results);
    const EventHandle done =
        launch(queue.get(), bounding.get(), moved.size(), items_per_block(points.shape), after);
    const After bounded(done);
    check_opencl(clEnqueueReadBuffer(queue.get(), results, CL_TRUE, 0, moved.size() * sizeof(PointBox),
                                     written_boxes.data(), bounded.count(), bounded.list(), nullptr),
                 "reading the boxes");
    for (std::size_t i = 0; i < moved.size(); ++i) boxes[moved[i]] = written_boxes[i];
}

DrawnPoints::DrawnPoints() : state_(std::make_unique<State>()) {}

DrawnPoints::~DrawnPoints() {
    if (state_->queue) (void)clFinish(state_->queue.get());
}

void DrawnPoints::move(const DeviceFrame& frame, Buffers buffers, Held held) {
    state_->take(frame.points);
    state_->aim_at(*frame.points, buffers);
    state_->move(frame, held);
}

void DrawnPoints::move(const DeviceFrame& frame, Held held) {
    state_->take(frame.points);
    state_->aim_at_own(*frame.points);
    state_->move(frame, held);
}

void DrawnPoints::read(std::span<float> positions, std::span<float> normals) {
    const auto fetch = [&](const BufferHandle& buffer, std::span<float> to) {
        require(state_->in_own_memory && buffer && to.size() == 3 * state_->count,
                "what was moved in the device's memory is read from there");
        check_opencl(clEnqueueReadBuffer(state_->queue.get(), buffer.get(), CL_TRUE, 0, to.size_bytes(),
                                         to.data(), 0, nullptr, nullptr),
                     "reading the result");
    };
    fetch(state_->positions, positions);
    if (!normals.empty()) fetch(state_->normals, normals);
}

std::span<const PointBox> DrawnPoints::boxes() const {
    return state_->boxes;
}

double DrawnPoints::moving_seconds() const {
    return state_->seconds;
}

std::vector<double> device_copy_seconds(const DeviceFrame& frame, std::size_t bytes, std::size_t repeats) {
    const PointsOnDevice& points = *frame.points;
    const std::size_t half = std::max<std::size_t>(bytes / 2, 1);
    const QueueHandle queue = timed_queue(points);
    const BufferHandle from = make_buffer(points.context.get(), CL_MEM_READ_WRITE, half, nullptr);
    const BufferHandle to = make_buffer(points.context.get(), CL_MEM_READ_WRITE, half, nullptr);
    std::vector<double> seconds;
    for (std::size_t r = 0; r <= repeats; ++r) {
        cl_event copied = nullptr;
        check_opencl(clEnqueueCopyBuffer(queue.get(), from.get(), to.get(), 0, 0, half, 0, nullptr, &copied),
                     "copying memory");
        const EventHandle done(copied);
        check_opencl(clWaitForEvents(1, After(done).list()), "copying memory");
        if (r > 0) seconds.push_back(seconds_of(done));
    }
    return seconds;
}

} // namespace knead
