#include "bench/own_memory.h"

#include "bench/automatic_handles.h"
#include "bench/made_cloud.h"
#include "bench/posing.h"
#include "upsample/devices.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {

using namespace knead;

// A sphere that was bent, upsampled by this for as long as it lives.
std::unique_ptr<Document> bent_sphere(UpsamplerProbe& probe, Workers& workers) {
    SilentProgress progress;
    const PointCloud cloud = made_cloud(Shape::sphere, 2000, workers, progress);
    const AutomaticHandles handles = automatic_handles(cloud);
    auto document = std::make_unique<Document>(cloud, with_samples(100), workers, probe);
    document->declare(handle_line("fixed", HandleRole::fixed, handles.fixed), "");
    document->declare(handle_line("moving", HandleRole::moving, handles.moving), "");
    document->drag({"moving", handles.pivot, {bent_by(handles, 30)}}, "", progress);
    return document;
}

TEST(OwnMemory, IsMeasuredByTheDevicesClock) {
    if (list_devices().empty()) GTEST_SKIP() << "there is no OpenCL device";
    Workers workers(2);
    UpsamplerProbe probe(make_opencl_upsampler(0, workers, 0, {.memory = DeviceMemory::own}));
    const auto document = bent_sphere(probe, workers);
    const auto figures = measure_in_own_memory(probe, 5, 1 << 20);
    ASSERT_TRUE(figures.has_value());
    EXPECT_EQ(figures->moving.count, 5U);
    EXPECT_GT(figures->moving.lowest, 0);
    EXPECT_GT(figures->copy.lowest, 0);
    EXPECT_GT(figures->copy_bytes_per_second, 0);
    EXPECT_GT(figures->bytes, 2U * 2000U * 3U * sizeof(float));
    EXPECT_GT(share_of_large_copy(*figures), 0);
    EXPECT_EQ(own_memory_cells(*figures).size(), own_memory_heading().size());
    EXPECT_EQ(own_memory_json(figures)["bytes"], figures->bytes);
}

TEST(OwnMemory, IsNoneWhereTheDeviceWorksInTheProcessors) {
    Workers workers(2);
    UpsamplerProbe probe(make_reference_upsampler(workers));
    const auto document = bent_sphere(probe, workers);
    EXPECT_FALSE(measure_in_own_memory(probe, 5).has_value());
    EXPECT_TRUE(own_memory_json(std::nullopt).is_null());
}

} // namespace
