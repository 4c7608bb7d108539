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
    BufferHandle buffer(clCreateFromGLBuffer(context, CL_MEM_WRITE_ONLY, name, &code));
    check_opencl(code, "sharing a buffer with OpenGL");
    return buffer;
}

// OpenCL has these buffers, on a queue, for as long as this lives; release() says whether it went well.
class Acquired {
public:
    Acquired(cl_command_queue queue, std::vector<cl_mem> buffers)
        : queue_(queue), buffers_(std::move(buffers)) {
        if (!buffers_.empty())
            check_opencl(clEnqueueAcquireGLObjects(queue_, count(), buffers_.data(), 0, nullptr, nullptr),
                         "taking the buffers from OpenGL");
    }
    ~Acquired() {
        if (buffers_.empty()) return;
        (void)clEnqueueReleaseGLObjects(queue_, count(), buffers_.data(), 0, nullptr, nullptr);
        (void)clFinish(queue_);
    }
    Acquired(const Acquired&) = delete;
    Acquired& operator=(const Acquired&) = delete;

    void release() {
        if (!buffers_.empty())
            check_opencl(clEnqueueReleaseGLObjects(queue_, count(), buffers_.data(), 0, nullptr, nullptr),
                         "giving the buffers back to OpenGL");
        buffers_.clear();
        check_opencl(clFinish(queue_), "moving the points where they are drawn");
    }

private:
    cl_uint count() const { return static_cast<cl_uint>(buffers_.size()); }
    cl_command_queue queue_;
    std::vector<cl_mem> buffers_;
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
    std::shared_ptr<const PointsOnDevice> points; // of the last frame
    QueueHandle queue;
    KernelHandle moving, bounding;
    BufferHandle motions, blocks, block_boxes;
    ChangedBlocks changes;
    Buffers names;
    BufferHandle positions, normals; // where the points go
    bool in_own_memory = false;
    std::vector<PointBox> boxes, written_boxes;
    double seconds = 0;

    void take(const DeviceFrame& frame);
    void aim_at(Buffers buffers);
    void aim_at_own();
    void move(const DeviceFrame& frame, Held held, bool acquires);
    void bound(std::span<const Index> moved, const After& after);
};

// Other points than before, or others that move them: everything is made anew.
void DrawnPoints::State::take(const DeviceFrame& frame) {
    if (points == frame.points) return;
    const bool same_context = points && points->context == frame.points->context;
    if (!same_context) *this = State{};
    points = frame.points;
    cl_context context = points->context.get();
    if (!queue) queue = timed_queue(*points);
    moving = moving_kernel(*points);
    bounding = kernel_named(points->program.get(), "bound_blocks");
    const std::size_t count = blocks_of(points->points);
    motions = make_buffer(context, CL_MEM_READ_ONLY, points->motions * sizeof(PackedMotion), nullptr);
    blocks = make_buffer(context, CL_MEM_READ_ONLY, count * sizeof(Index), nullptr);
    block_boxes = make_buffer(context, CL_MEM_WRITE_ONLY, count * sizeof(PointBox), nullptr);
    changes = points->changes;
    boxes.assign(count, no_box);
    written_boxes.resize(count);
    if (!in_own_memory) return;
    positions.reset(); // as many as there were points
    normals.reset();
}

void DrawnPoints::State::aim_at(Buffers buffers) {
    if (positions && !in_own_memory && names == buffers) return;
    require(!points->normals || buffers.normals != 0, "a buffer for normals where there are any");
    positions.reset();
    normals.reset();
    changes = points->changes;
    names = buffers;
    in_own_memory = false;
    positions = shared_buffer(points->context.get(), buffers.positions);
    if (points->normals) normals = shared_buffer(points->context.get(), buffers.normals);
}

void DrawnPoints::State::aim_at_own() {
    if (positions && in_own_memory) return;
    const std::size_t bytes = 3 * points->points * sizeof(float);
    changes = points->changes;
    in_own_memory = true;
    positions = make_buffer(points->context.get(), CL_MEM_READ_WRITE, bytes, nullptr);
    normals =
        points->normals ? make_buffer(points->context.get(), CL_MEM_READ_WRITE, bytes, nullptr) : nullptr;
}

void DrawnPoints::State::move(const DeviceFrame& frame, Held held, bool acquires) {
    const std::span<const Index> moved = changes.of_frame(std::span(frame.motions).subspan(1), {}, {}, held);
    seconds = 0;
    if (!moved.empty()) {
        std::vector<cl_mem> taken;
        if (acquires) taken.push_back(positions.get());
        if (acquires && normals) taken.push_back(normals.get());
        Acquired acquired(queue.get(), std::move(taken));
        EventHandle done = write_buffer(queue.get(), motions.get(), std::span(frame.motions), After(nullptr),
                                        "writing the motions");
        done = write_buffer(queue.get(), blocks.get(), moved, After(done), "writing what moves");
        set_moving(moving.get(), *points, points->points, blocks.get(), motions.get(), positions.get(),
                   normals.get());
        const EventHandle ran =
            launch(queue.get(), moving.get(), moved.size(), items_per_block(points->shape), After(done));
        bound(moved, After(ran));
        acquired.release();
        seconds = seconds_of(ran);
    }
    changes.note_written();
}

// The boxes of what moved.
void DrawnPoints::State::bound(std::span<const Index> moved, const After& after) {
    cl_mem const block_list = blocks.get(), moved_positions = positions.get(), results = block_boxes.get();
    const cl_ulong count = points->points;
    set_arguments(bounding.get(), count, block_list, moved_positions, results);
    const EventHandle done =
        launch(queue.get(), bounding.get(), moved.size(), items_per_block(points->shape), after);
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
    state_->take(frame);
    state_->aim_at(buffers);
    state_->move(frame, held, true);
}

void DrawnPoints::move(const DeviceFrame& frame, Held held) {
    state_->take(frame);
    state_->aim_at_own();
    state_->move(frame, held, false);
}

void DrawnPoints::read(std::span<float> positions, std::span<float> normals) {
    const auto fetch = [&](const BufferHandle& buffer, std::span<float> to) {
        require(state_->in_own_memory && buffer && to.size() == 3 * state_->points->points,
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
