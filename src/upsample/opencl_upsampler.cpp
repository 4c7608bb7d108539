// The upsampling kernel on an OpenCL device: kernels/upsample.cl, built and fed.

#include "base/require.h"
#include "upsample/changed_blocks.h"
#include "upsample/checked_input.h"
#include "upsample/influence_groups.h"
#include "upsample/opencl_devices.h"
#include "upsample/point_blocks.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace knead {

namespace embedded {
extern const char* const upsample_kernel;
}

namespace {

// What exists once a device: opened by the first prepare().
struct OpenedDevice {
    DeviceHandle part; // null for the whole device
    ContextHandle context;
    QueueHandle queue;
};

struct BuiltKernel {
    ProgramHandle program; // null: not built yet
    KernelHandle move_positions;
    KernelHandle move_both;
};

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
std::string build_options(cl_device_id device, bool sixteen_at_once) {
    std::string options = "-D POINTS_IN_BLOCK=" + std::to_string(points_in_block) +
                          " -D POINTS_IN_GROUP=" + std::to_string(points_in_group) +
                          " -D WHOLE_SHARE=" + std::to_string(whole_share);
    if (sixteen_at_once) options += " -D SIXTEEN";
    cl_device_fp_config floats = 0;
    if (clGetDeviceInfo(device, CL_DEVICE_SINGLE_FP_CONFIG, sizeof floats, &floats, nullptr) == CL_SUCCESS &&
        (floats & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0)
        options += " -cl-fp32-correctly-rounded-divide-sqrt";
    return options;
}

ProgramHandle build_program(cl_context context, cl_device_id device, const char* text, bool sixteen_at_once) {
    cl_int code = CL_SUCCESS;
    ProgramHandle program(clCreateProgramWithSource(context, 1, &text, nullptr, &code));
    check_opencl(code, "reading the kernel");
    const std::string options = build_options(device, sixteen_at_once);
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

OpenedDevice open_device(const OpenClDevice& device, unsigned threads) {
    OpenedDevice opened;
    opened.part = limited_to(device, threads);
    cl_device_id id = opened.part ? opened.part.get() : device.id;
    cl_int code = CL_SUCCESS;
    opened.context.reset(clCreateContext(nullptr, 1, &id, nullptr, nullptr, &code));
    check_opencl(code, "opening the device");
    opened.queue.reset(clCreateCommandQueue(opened.context.get(), id, 0, &code));
    check_opencl(code, "making a queue");
    return opened;
}

BuiltKernel build_kernel(cl_context context, cl_device_id device, const char* text, bool sixteen_at_once) {
    BuiltKernel built;
    built.program = build_program(context, device, text, sixteen_at_once);
    built.move_positions = kernel_named(built.program.get(), "upsample_positions");
    built.move_both = kernel_named(built.program.get(), "upsample_positions_and_normals");
    return built;
}

BufferHandle make_buffer(cl_context context, cl_mem_flags flags, std::size_t bytes, void* host) {
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

// A buffer for one of the results, and the caller's array that it wraps or is read into.
struct Result {
    BufferHandle buffer;
    std::span<float> wrapped;
};

class OpenClUpsampler final : public Upsampler {
public:
    OpenClUpsampler(OpenClDevice device, Workers& workers, unsigned threads, DeviceMemory memory,
                    const char* kernel)
        : device_(std::move(device)), workers_(workers), threads_(threads),
          kernel_(kernel ? kernel : embedded::upsample_kernel),
          shares_memory_(memory == DeviceMemory::as_the_device_has_it &&
                         device_.description.type == DeviceType::cpu) {}

    // What a call that failed left under way must not write into arrays that somebody else has by then.
    ~OpenClUpsampler() override {
        if (opened_.queue) (void)clFinish(opened_.queue.get());
        // PoCL's threads let go of a finished call a moment after clFinish() returned, and look at the device
        // for it: if that was a part of one (limited_to()) and is gone by then, they crash. Nothing tells
        // when they have, so the part, some hundred bytes, stays for as long as the program.
        (void)opened_.part.release();
    }
    OpenClUpsampler(const OpenClUpsampler&) = delete;
    OpenClUpsampler& operator=(const OpenClUpsampler&) = delete;

    std::string device() const override { return device_.description.name; }
    std::size_t influence_bytes() const override { return influences_.bytes(); }

    void prepare(const UpsampleInput& input, std::size_t motions) override {
        require_valid_input(input, motions, workers_);
        input_ = {};
        motion_count_ = motions;
        if (input.mover.empty()) influences_ = {};
        moved_positions_ = {};
        moved_normals_ = {};
        if (!opened_.queue) opened_ = open_device(device_, threads_);
        if (!input.mover.empty()) {
            build();
            positions_ = hand_over(input.positions);
            normals_ = hand_over(input.normals);
            influences_.prepare(input, workers_);
            groups_ = hand_over(influences_.groups());
            entry_motions_ = hand_over(influences_.motion());
            shares_ = hand_over(influences_.share());
            first_handle_ = first_without_place(input);
            make_motions();
            make_blocks(blocks_of(input.mover.size()));
            changes_.prepare(input, motions, workers_);
            if (!shares_memory_) make_results(input);
            launch_once(input);
        }
        input_ = input;
    }

    std::span<const Index> run(std::span<const Motion> motions, std::span<float> positions,
                               std::span<float> normals, Held held) override {
        require_valid_frame(input_, motion_count_, motions, positions, normals);
        if (positions.empty()) return {};
        pack_motions(motions, input_.weights, input_.places, std::span(packed_).subspan(1));
        const std::span<const Index> blocks =
            changes_.of_frame(std::span(packed_).subspan(1), positions, normals, held);
        if (!blocks.empty()) move(blocks, positions, normals);
        changes_.note_written();
        return blocks;
    }

private:
    void build() {
        if (built_.program) return;
        cl_device_id id = opened_.part ? opened_.part.get() : device_.id;
        built_ = build_kernel(opened_.context.get(), id, kernel_, shares_memory_);
    }

    // Null for no values: OpenCL knows no empty buffer.
    template<typename Value>
    BufferHandle hand_over(std::span<const Value> values) {
        if (values.empty()) return {};
        const cl_mem_flags how = shares_memory_ ? CL_MEM_USE_HOST_PTR : CL_MEM_COPY_HOST_PTR;
        // OpenCL takes no pointer to const, but only reads what is CL_MEM_READ_ONLY.
        return make_buffer(opened_.context.get(), CL_MEM_READ_ONLY | how, values.size_bytes(),
                           const_cast<Value*>(values.data()));
    }

    void make_motions() {
        packed_.assign(motion_count_ + 1, {});
        // None of them moves anything; of the first one that stays so.
        pack_motions(std::vector<Motion>(packed_.size()), input_.weights, {}, packed_);
        const cl_mem_flags where = shares_memory_ ? CL_MEM_USE_HOST_PTR : 0;
        motions_ =
            make_buffer(opened_.context.get(), CL_MEM_READ_ONLY | where,
                        packed_.size() * sizeof(PackedMotion), shares_memory_ ? packed_.data() : nullptr);
    }

    // The list of blocks that a frame moves: all of them to begin with.
    void make_blocks(std::size_t count) {
        listed_.resize(count);
        std::iota(listed_.begin(), listed_.end(), Index{0});
        listed_count_ = count;
        ranges_.reserve(most_ranges);
        const cl_mem_flags how = shares_memory_ ? CL_MEM_USE_HOST_PTR : CL_MEM_COPY_HOST_PTR;
        blocks_ =
            make_buffer(opened_.context.get(), CL_MEM_READ_ONLY | how, count * sizeof(Index), listed_.data());
    }

    void make_results(const UpsampleInput& input) {
        moved_positions_.buffer =
            make_buffer(opened_.context.get(), CL_MEM_WRITE_ONLY, input.positions.size_bytes(), nullptr);
        if (!input.normals.empty())
            moved_normals_.buffer =
                make_buffer(opened_.context.get(), CL_MEM_WRITE_ONLY, input.normals.size_bytes(), nullptr);
    }

    // Compiles what a runtime compiles at the first launch, and makes it start its threads. The grids are
    // those of the largest frame and of the smallest, as PoCL compiles small and large grids differently; all
    // but the first block have no point to move.
    void launch_once(const UpsampleInput& input) {
        const EventHandle written = write_motions();
        const std::size_t points = std::min(input.mover.size(), points_in_block);
        const std::size_t bytes = 3 * points * sizeof(float);
        const BufferHandle positions = make_buffer(opened_.context.get(), CL_MEM_WRITE_ONLY, bytes, nullptr);
        const BufferHandle normals = make_buffer(opened_.context.get(), CL_MEM_WRITE_ONLY, bytes, nullptr);
        const EventHandle largest =
            launch(points, listed_.size(), positions.get(), normals.get(), After(written));
        const EventHandle smallest = launch(points, 1, positions.get(), normals.get(), After(largest));
        check_opencl(clWaitForEvents(1, After(smallest).list()), "the first launch");
    }

    // The frame's motions are packed.
    void move(std::span<const Index> blocks, std::span<float> positions, std::span<float> normals) {
        if (shares_memory_) {
            wrap(positions, moved_positions_);
            if (!normals.empty()) wrap(normals, moved_normals_);
        }
        EventHandle done = write_motions();
        const bool is_listed = std::ranges::equal(blocks, std::span(listed_).first(listed_count_));
        listed_count_ = 0; // until this frame has succeeded nobody knows what the device has
        if (!is_listed) done = write_blocks(blocks, After(done));
        done = launch(input_.mover.size(), blocks.size(), moved_positions_.buffer.get(),
                      moved_normals_.buffer.get(), After(done));
        note_ranges(blocks);
        done = read(moved_positions_, positions, normals.empty(), std::move(done));
        if (!normals.empty()) read(moved_normals_, normals, true, std::move(done));
        listed_count_ = blocks.size();
    }

    EventHandle write_motions() {
        cl_event written = nullptr;
        check_opencl(clEnqueueWriteBuffer(opened_.queue.get(), motions_.get(), CL_FALSE, 0,
                                          packed_.size() * sizeof(PackedMotion), packed_.data(), 0, nullptr,
                                          &written),
                     "writing the motions");
        return EventHandle(written);
    }

    EventHandle write_blocks(std::span<const Index> blocks, const After& after) {
        std::ranges::copy(blocks, listed_.begin());
        cl_event written = nullptr;
        check_opencl(clEnqueueWriteBuffer(opened_.queue.get(), blocks_.get(), CL_FALSE, 0,
                                          blocks.size_bytes(), listed_.data(), after.count(), after.list(),
                                          &written),
                     "writing what moves");
        return EventHandle(written);
    }

    void wrap(std::span<float> array, Result& result) {
        if (result.wrapped.data() == array.data() && result.wrapped.size() == array.size()) return;
        result = {};
        result.buffer = make_buffer(opened_.context.get(), CL_MEM_WRITE_ONLY | CL_MEM_USE_HOST_PTR,
                                    array.size_bytes(), array.data());
        result.wrapped = array;
    }

    // Moves what the first so many blocks of the list have of the first `points`.
    EventHandle launch(cl_ulong points, std::size_t blocks, cl_mem moved_positions, cl_mem moved_normals,
                       const After& after) {
        cl_mem const listed = blocks_.get();
        cl_mem const positions = positions_.get();
        cl_mem const groups = groups_.get();
        cl_mem const entry_motions = entry_motions_.get();
        cl_mem const shares = shares_.get();
        cl_mem const motions = motions_.get();
        cl_mem const normals = normals_.get();
        cl_kernel kernel = normals ? built_.move_both.get() : built_.move_positions.get();
        if (normals)
            set_arguments(kernel, points, listed, positions, groups, entry_motions, shares, first_handle_,
                          motions, moved_positions, normals, moved_normals);
        else
            set_arguments(kernel, points, listed, positions, groups, entry_motions, shares, first_handle_,
                          motions, moved_positions);
        const std::size_t items_per_group = shares_memory_ ? 1 : points_in_block;
        const std::size_t items = blocks * items_per_group;
        cl_event moved = nullptr;
        check_opencl(clEnqueueNDRangeKernel(opened_.queue.get(), kernel, 1, nullptr, &items, &items_per_group,
                                            after.count(), after.list(), &moved),
                     "launching the kernel");
        return EventHandle(moved);
    }

    // What read() fetches: where memory is shared, all at once, as nothing is copied.
    void note_ranges(std::span<const Index> blocks) {
        if (shares_memory_) return ranges_.assign(1, {0, input_.mover.size()});
        ranges_.clear();
        for (const Index block : blocks) append_block(block, input_.mover.size(), ranges_);
    }

    // Makes what moved visible in the caller's array. `waits`: until that is done.
    EventHandle read(const Result& result, std::span<float> array, bool waits, EventHandle done) {
        for (const PointRange& range : ranges_) {
            const std::span<float> part = array.subspan(3 * range.first, 3 * (range.end - range.first));
            const bool is_last = &range == &ranges_.back();
            const After after(done);
            cl_event read = nullptr;
            check_opencl(clEnqueueReadBuffer(opened_.queue.get(), result.buffer.get(),
                                             waits && is_last ? CL_TRUE : CL_FALSE,
                                             3 * range.first * sizeof(float), part.size_bytes(), part.data(),
                                             after.count(), after.list(), &read),
                         "reading the result");
            done.reset(read);
        }
        return done;
    }

    OpenClDevice device_;
    Workers& workers_;
    unsigned threads_;
    const char* kernel_;
    bool shares_memory_;
    OpenedDevice opened_;
    BuiltKernel built_;

    UpsampleInput input_;
    std::size_t motion_count_ = 0;
    std::vector<PackedMotion> packed_; // one that moves nothing, and the motions, as the device reads them
    InfluenceGroups influences_;
    cl_uint first_handle_ = 0;
    ChangedBlocks changes_;
    std::vector<Index> listed_; // the blocks of the last frame, and room for all of them
    std::size_t listed_count_ = 0;
    std::vector<PointRange> ranges_; // of them, that are read
    BufferHandle positions_, normals_, groups_, entry_motions_, shares_, motions_, blocks_;
    Result moved_positions_, moved_normals_;
};

} // namespace

std::unique_ptr<Upsampler> make_opencl_upsampler(std::size_t device, Workers& workers, unsigned threads,
                                                 DeviceMemory memory, const char* kernel) {
    std::vector<OpenClDevice> devices = find_opencl_devices();
    if (device >= devices.size()) throw DeviceFailure("the device is not there any more");
    return std::make_unique<OpenClUpsampler>(std::move(devices[device]), workers, threads, memory, kernel);
}

} // namespace knead
