// The upsampling kernel on an OpenCL device: kernels/upsample.cl, built and fed.

#include "upsample/changed_blocks.h"
#include "upsample/checked_input.h"
#include "upsample/influence_groups.h"
#include "upsample/on_device.h"
#include "upsample/opencl_devices.h"
#include "upsample/point_blocks.h"

#include <algorithm>
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
    std::shared_ptr<std::remove_pointer_t<cl_context>> context;
    QueueHandle queue;
    bool shares_with_gl = false;
};

OpenedDevice open_device(const OpenClDevice& device, unsigned threads, const GlSharing* sharing) {
    OpenedDevice opened;
    opened.part = limited_to(device, threads);
    cl_device_id id = opened.part ? opened.part.get() : device.id;
    cl_int code = CL_SUCCESS;
    opened.shares_with_gl = !opened.part && sharing && sharing->device == id;
    if (opened.shares_with_gl) {
        opened.context = sharing->context;
    } else {
        opened.context = ContextHandle(clCreateContext(nullptr, 1, &id, nullptr, nullptr, &code));
        check_opencl(code, "opening the device");
    }
    opened.queue.reset(clCreateCommandQueue(opened.context.get(), id, 0, &code));
    check_opencl(code, "making a queue");
    return opened;
}

// A buffer that is the caller's array, on a device that shares the processor's memory.
struct Wrapped {
    std::span<float> array;
    BufferHandle buffer;
};

class OpenClUpsampler final : public Upsampler {
public:
    OpenClUpsampler(OpenClDevice device, Workers& workers, unsigned threads, const DeviceUse& use)
        : device_(std::move(device)), workers_(workers), threads_(threads),
          kernel_text_(use.kernel ? use.kernel : embedded::upsample_kernel), sharing_(use.sharing),

          shares_memory_(use.memory == DeviceMemory::as_the_device_has_it &&
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
        moved_positions_.reset();
        moved_normals_.reset();
        wrapped_.clear();
        wrapped_.reserve(2 * most_targets + 1);
        on_device_.reset();
        spent_motions_ = no_spent_motions();
        if (!opened_.queue) opened_ = open_device(device_, threads_, sharing_.get());
        if (!input.mover.empty()) {
            influences_.prepare(input, workers_);
            hand_over(input);
            make_motions();
            make_blocks(blocks_of(input.mover.size()));
            changes_ = on_device_->changes;
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

    std::shared_ptr<const DeviceFrame> frame(std::span<const Motion> motions) override {
        if (input_.mover.empty() || shares_memory_) return nullptr; // or prepare() failed
        require_motions(motion_count_, motions);
        std::vector<PackedMotion> packed = spent_motions_->with([](auto& all) {
            if (all.empty()) return std::vector<PackedMotion>();
            std::vector<PackedMotion> last = std::move(all.back());
            all.pop_back();
            return last;
        });
        if (packed.empty()) packed = packed_;
        pack_motions(motions, input_.weights, input_.places, std::span(packed).subspan(1));
        return std::make_shared<const DeviceFrame>(on_device_, std::move(packed), spent_motions_);
    }

    bool shares_with_opengl() const override { return opened_.shares_with_gl; }

private:
    KernelShape shape() const {
        return shares_memory_ ? KernelShape::sixteen_at_once : KernelShape::many_items;
    }

    void build() {
        if (program_) return;
        cl_device_id id = opened_.part ? opened_.part.get() : device_.id;
        program_ = build_program(opened_.context.get(), id, kernel_text_, shape());
    }

    // Null for no values: OpenCL knows no empty buffer.
    template<typename Value>
    BufferHandle buffer_of(std::span<const Value> values) {
        if (values.empty()) return {};
        const cl_mem_flags how = shares_memory_ ? CL_MEM_USE_HOST_PTR : CL_MEM_COPY_HOST_PTR;
        // OpenCL takes no pointer to const, but only reads what is CL_MEM_READ_ONLY.
        return make_buffer(opened_.context.get(), CL_MEM_READ_ONLY | how, values.size_bytes(),
                           const_cast<Value*>(values.data()));
    }

    void hand_over(const UpsampleInput& input) {
        build();
        auto points = std::make_shared<PointsOnDevice>();
        points->device = opened_.part ? opened_.part.get() : device_.id;
        points->context = opened_.context;
        points->program = program_;
        points->shape = shape();
        points->points = input.mover.size();
        points->motions = motion_count_ + 1;
        points->positions = buffer_of(input.positions);
        points->normals = buffer_of(input.normals);
        points->groups = buffer_of(influences_.groups());
        points->entry_motions = buffer_of(influences_.motion());
        points->shares = buffer_of(influences_.share());
        points->first_handle = first_without_place(input);
        points->changes.prepare(input, motion_count_, workers_);
        KernelHandle& kernel = points->normals ? move_both_ : move_positions_;
        if (!kernel) kernel = moving_kernel(*points);
        on_device_ = std::move(points);
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
        moved_positions_ =
            make_buffer(opened_.context.get(), CL_MEM_WRITE_ONLY, input.positions.size_bytes(), nullptr);
        if (!input.normals.empty())
            moved_normals_ =
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
            launch_moving(points, listed_.size(), positions.get(), normals.get(), After(written));
        const EventHandle smallest = launch_moving(points, 1, positions.get(), normals.get(), After(largest));
        check_opencl(clWaitForEvents(1, After(smallest).list()), "the first launch");
    }

    // The frame's motions are packed.
    void move(std::span<const Index> blocks, std::span<float> positions, std::span<float> normals) {
        cl_mem const moved_positions = result_in(positions, moved_positions_);
        cl_mem const moved_normals = normals.empty() ? nullptr : result_in(normals, moved_normals_);
        EventHandle done = write_motions();
        const bool is_listed = std::ranges::equal(blocks, std::span(listed_).first(listed_count_));
        listed_count_ = 0; // until this frame has succeeded nobody knows what the device has
        if (!is_listed) done = write_blocks(blocks, After(done));
        done = launch_moving(input_.mover.size(), blocks.size(), moved_positions, moved_normals, After(done));
        note_ranges(blocks);
        done = read(moved_positions, positions, normals.empty(), std::move(done));
        if (!normals.empty()) read(moved_normals, normals, true, std::move(done));
        listed_count_ = blocks.size();
    }

    EventHandle write_motions() {
        return write_buffer(opened_.queue.get(), motions_.get(), std::span<const PackedMotion>(packed_),
                            After(nullptr), "writing the motions");
    }

    EventHandle write_blocks(std::span<const Index> blocks, const After& after) {
        std::ranges::copy(blocks, listed_.begin());
        return write_buffer(opened_.queue.get(), blocks_.get(),
                            std::span<const Index>(listed_).first(blocks.size()), after,
                            "writing what moves");
    }

    // Where the device writes what goes into this array: into the array itself where memory is shared.
    cl_mem result_in(std::span<float> array, const BufferHandle& of_device) {
        if (!shares_memory_) return of_device.get();
        const auto known = std::ranges::find_if(wrapped_, [&](const Wrapped& one) {
            return one.array.data() == array.data() && one.array.size() == array.size();
        });
        if (known != wrapped_.end()) {
            std::rotate(known, known + 1, wrapped_.end()); // the last one used comes last
        } else {
            wrapped_.push_back(
                {array, make_buffer(opened_.context.get(), CL_MEM_WRITE_ONLY | CL_MEM_USE_HOST_PTR,
                                    array.size_bytes(), array.data())});
            if (wrapped_.size() > 2 * most_targets) wrapped_.erase(wrapped_.begin());
        }
        return wrapped_.back().buffer.get();
    }

    // Moves what the first so many blocks of the list have of the first `points`.
    EventHandle launch_moving(cl_ulong points, std::size_t blocks, cl_mem moved_positions,
                              cl_mem moved_normals, const After& after) {
        cl_kernel kernel = on_device_->normals ? move_both_.get() : move_positions_.get();
        set_moving(kernel, *on_device_, points, blocks_.get(), motions_.get(), moved_positions,
                   moved_normals);
        return launch(opened_.queue.get(), kernel, blocks, items_per_block(on_device_->shape), after);
    }

    // What read() fetches: where memory is shared, all at once, as nothing is copied.
    void note_ranges(std::span<const Index> blocks) {
        if (shares_memory_) return ranges_.assign(1, {0, input_.mover.size()});
        ranges_.clear();
        for (const Index block : blocks) append_block(block, input_.mover.size(), ranges_);
    }

    // Makes what moved visible in the caller's array. `waits`: until that is done.
    EventHandle read(cl_mem result, std::span<float> array, bool waits, EventHandle done) {
        for (const PointRange& range : ranges_) {
            const std::span<float> part = array.subspan(3 * range.first, 3 * (range.end - range.first));
            const bool is_last = &range == &ranges_.back();
            const After after(done);
            cl_event read = nullptr;
            check_opencl(clEnqueueReadBuffer(opened_.queue.get(), result,
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
    const char* kernel_text_;
    std::shared_ptr<const GlSharing> sharing_;
    bool shares_memory_;
    OpenedDevice opened_;
    std::shared_ptr<std::remove_pointer_t<cl_program>> program_; // null: not built yet
    KernelHandle move_positions_, move_both_;                    // null where there was no need yet

    UpsampleInput input_;
    std::size_t motion_count_ = 0;
    std::vector<PackedMotion> packed_; // one that moves nothing, and the motions, as the device reads them
    InfluenceGroups influences_;
    std::shared_ptr<const PointsOnDevice> on_device_; // null: no points
    std::shared_ptr<SpentMotions> spent_motions_;     // of frames of these
    ChangedBlocks changes_;
    std::vector<Index> listed_; // the blocks of the last frame, and room for all of them
    std::size_t listed_count_ = 0;
    std::vector<PointRange> ranges_; // of them, that are read
    BufferHandle motions_, blocks_;
    BufferHandle moved_positions_, moved_normals_; // in the device's own memory, where it has any
    std::vector<Wrapped> wrapped_;                 // else: the one used last comes last
};

} // namespace

std::unique_ptr<Upsampler> make_opencl_upsampler(std::size_t device, Workers& workers, unsigned threads,
                                                 const DeviceUse& use) {
    std::vector<OpenClDevice> devices = find_opencl_devices();
    if (device >= devices.size()) throw DeviceFailure("the device is not there any more");
    return std::make_unique<OpenClUpsampler>(std::move(devices[device]), workers, threads, use);
}

} // namespace knead
