// One frame of upsampling on every device and on the reference, beside a plain copy of the same number of
// bytes. The argument is the number of points. GB/s counts what a frame has to touch at least: each point's
// position, number of what moves it, row of influences and result, and its normal in and out where there are
// normals.

#include "base/workers.h"
#include "upsample/devices.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

namespace {

using namespace knead;

constexpr std::size_t motion_count = 5000;

// Points along a line of samples, eight neighbouring samples each, as in a cloud in Morton order.
struct Scene {
    std::vector<float> positions, normals, moved, turned;
    std::vector<Index> mover;
    InfluenceRows rows;
    std::vector<Motion> motions;

    Scene(std::size_t points, bool with_normals) : moved(3 * points), mover(points), motions(motion_count) {
        for (std::size_t i = 0; i < 3 * points; ++i) positions.push_back(std::sin(static_cast<float>(i)));
        if (with_normals) {
            normals = positions;
            turned.resize(3 * points);
        }
        std::iota(mover.begin(), mover.end(), Index{0});
        std::vector<NarrowRow> narrow(points);
        for (std::size_t i = 0; i < points; ++i)
            for (std::size_t k = 0; k < influences_per_row; ++k) {
                narrow[i].sample[k] =
                    static_cast<std::uint16_t>((i * motion_count / points + 7 * k) % motion_count);
                narrow[i].distance[k] = static_cast<std::uint16_t>(3 + i % 37 + 9 * k);
            }
        rows.rows = std::move(narrow);
        for (Motion& motion : motions)
            for (float& value : motion.map)
                value = 0.01F * std::sin(static_cast<float>(&value - motions[0].map));
    }

    std::size_t bytes_a_frame() const {
        return 4 * (positions.size() + normals.size() + moved.size() + turned.size() + mover.size()) +
               sizeof(NarrowRow) * rows.size();
    }
};

void count(benchmark::State& state, std::size_t points, std::size_t bytes) {
    const auto frames = static_cast<double>(state.iterations());
    state.counters["GB/s"] =
        benchmark::Counter(frames * static_cast<double>(bytes) * 1e-9, benchmark::Counter::kIsRate);
    state.counters["points/s"] =
        benchmark::Counter(frames * static_cast<double>(points), benchmark::Counter::kIsRate);
}

void run_frames(benchmark::State& state, Upsampler& upsampler) {
    Scene scene(static_cast<std::size_t>(state.range(0)), state.range(1) != 0);
    upsampler.prepare({scene.positions, scene.normals, scene.mover, &scene.rows}, scene.motions.size());
    upsampler.run(scene.motions, scene.moved, scene.turned, Held::nothing);
    while (state.KeepRunning()) upsampler.run(scene.motions, scene.moved, scene.turned, Held::nothing);
    count(state, scene.mover.size(), scene.bytes_a_frame());
}

// Half of the bytes are read and half are written, on all cores, as many in all as a frame touches.
void copy_memory(benchmark::State& state) {
    const Scene scene(static_cast<std::size_t>(state.range(0)), state.range(1) != 0);
    const std::size_t bytes = scene.bytes_a_frame() / 2;
    std::vector<char> from(bytes, 1);
    std::vector<char> to(bytes);
    Workers workers;
    while (state.KeepRunning()) {
        workers.for_chunks(bytes, bytes / workers.threads() + 1, [&](std::size_t begin, std::size_t end) {
            std::memcpy(to.data() + begin, from.data() + begin, end - begin);
        });
        benchmark::ClobberMemory();
    }
    count(state, scene.mover.size(), 2 * bytes);
}

void upsample_reference(benchmark::State& state) {
    Workers workers;
    run_frames(state, *make_reference_upsampler(workers));
}

void upsample_device(benchmark::State& state) {
    Workers workers;
    run_frames(state, *make_opencl_upsampler(static_cast<std::size_t>(state.range(2)), workers, 0));
}

constexpr int point_counts[] = {35'000, 437'000, 1'000'000};

// Times what the clock on the wall says; beside it stands the time of all threads on their cores, which is
// what to compare on a busy machine.
void set_up(benchmark::internal::Benchmark* benchmark) {
    benchmark->UseRealTime()->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
}

void with_every_size(benchmark::internal::Benchmark* benchmark) {
    set_up(benchmark);
    benchmark->ArgNames({"points", "normals"});
    for (const int normals : {0, 1})
        for (const int points : point_counts) benchmark->Args({points, normals});
}

void with_every_size_and_device(benchmark::internal::Benchmark* benchmark) {
    set_up(benchmark);
    benchmark->ArgNames({"points", "normals", "device"});
    const auto devices = static_cast<int>(list_devices().size());
    for (int device = 0; device < devices; ++device)
        for (const int normals : {0, 1})
            for (const int points : point_counts) benchmark->Args({points, normals, device});
}

BENCHMARK(copy_memory)->Apply(with_every_size);
BENCHMARK(upsample_reference)->Apply(with_every_size);
BENCHMARK(upsample_device)->Apply(with_every_size_and_device);

} // namespace

BENCHMARK_MAIN();
