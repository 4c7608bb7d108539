// Choosing a device, and losing one.

#include "base/error.h"
#include "base/workers.h"
#include "upsample/devices.h"
#include "upsample/failing_upsampler.h"
#include "upsample/scene.h"

#include <gtest/gtest.h>

#include <cctype>

namespace knead {
namespace {

using namespace knead::test;

std::string refusal(const std::string& request) {
    Workers workers(1);
    try {
        make_upsampler(request, workers, 0);
    } catch (const Error& error) {
        EXPECT_EQ(error.trouble(), Trouble::usage);
        return error.what();
    }
    return {};
}

TEST(FallbackUpsampler, GivesTheRightResultInTheCallThatFails) {
    Workers workers(2);
    const Scene scene = random_scene(5000, 40, 21);
    const Posed expected = upsampled(*make_reference_upsampler(workers), scene);
    for (const int failing_call : {1, 2, 3}) {
        const auto upsampler = make_fallback_upsampler(
            std::make_unique<FailingUpsampler>(make_reference_upsampler(workers), failing_call), workers);
        EXPECT_EQ(upsampler->device(), "a flaky device");
        EXPECT_EQ(upsampled(*upsampler, scene), expected);
        Posed second = {std::vector<float>(15'000), std::vector<float>(15'000)};
        upsampler->run(scene.motions, second.positions, second.normals, Held::nothing);
        EXPECT_EQ(second, expected);
        EXPECT_EQ(upsampler->device(), "reference");
        EXPECT_NE(upsampler->take_warning().find("a flaky device"), std::string::npos);
        EXPECT_EQ(upsampler->take_warning(), "");
        const Scene other = random_scene(100, 7, 22);
        EXPECT_EQ(upsampled(*upsampler, other), upsampled(*make_reference_upsampler(workers), other));
    }
}

TEST(FallbackUpsampler, ReplacesARealDeviceWhoseKernelDoesNotBuild) {
    if (list_devices().empty()) GTEST_SKIP() << "there is no OpenCL device";
    Workers workers(2);
    const Scene scene = random_scene(5000, 40, 24);
    const Posed expected = upsampled(*make_reference_upsampler(workers), scene);
    const std::pair<const char*, const char*> kernels[] = {
        {"kernel void upsample_positions(this is no C) {}", "does not compile"},
        {"kernel void another(global float* a) { a[0] = 0; }", "finding the kernel"}};
    for (const auto& [kernel, words] : kernels)
        for (const DeviceMemory memory : {DeviceMemory::as_the_device_has_it, DeviceMemory::own}) {
            const auto upsampler = make_fallback_upsampler(
                make_opencl_upsampler(0, workers, 0, {.memory = memory, .kernel = kernel}), workers);
            EXPECT_EQ(upsampled(*upsampler, scene), expected);
            EXPECT_EQ(upsampler->device(), "reference");
            const std::string warning = upsampler->take_warning();
            EXPECT_NE(warning.find(words), std::string::npos) << warning;
        }
}

TEST(FallbackUpsampler, ADeviceThatIsGoneIsAFailure) {
    Workers workers;
    EXPECT_THROW(make_opencl_upsampler(list_devices().size(), workers, 0), DeviceFailure);
}

TEST(FallbackUpsampler, SaysNothingWhileAllIsWell) {
    Workers workers(1);
    const auto upsampler = make_fallback_upsampler(
        std::make_unique<FailingUpsampler>(make_reference_upsampler(workers), 100), workers);
    upsampled(*upsampler, random_scene(10, 3, 23));
    EXPECT_EQ(upsampler->take_warning(), "");
    EXPECT_EQ(upsampler->device(), "a flaky device");
}

TEST(MakeUpsampler, TakesTheReferenceByName) {
    Workers workers(1);
    for (const char* request : {"reference", "Reference"}) {
        const UpsamplerChoice choice = make_upsampler(request, workers, 0);
        EXPECT_EQ(choice.upsampler->device(), "reference");
        EXPECT_EQ(choice.warning, "");
    }
}

TEST(MakeUpsampler, TakesTheDefaultOrWarns) {
    Workers workers(1);
    std::string expected = "reference";
    for (const DeviceDescription& device : list_devices())
        if (device.is_default) expected = device.name;
    for (const char* request : {"", "auto", "AUTO"}) {
        const UpsamplerChoice choice = make_upsampler(request, workers, 1);
        EXPECT_EQ(choice.upsampler->device(), expected);
        EXPECT_EQ(choice.warning.empty(), expected != "reference");
    }
}

TEST(MakeUpsampler, TakesADeviceByNumberOrPartOfItsName) {
    const std::vector<DeviceDescription> devices = list_devices();
    if (devices.empty()) GTEST_SKIP() << "there is no OpenCL device";
    Workers workers(1);
    for (std::size_t i = 0; i < devices.size(); ++i)
        EXPECT_EQ(make_upsampler(std::to_string(i), workers, 0).upsampler->device(), devices[i].name);
    if (devices.size() > 1) return; // then a part of a name may fit several
    std::string part = devices[0].name.substr(0, devices[0].name.size() - 1);
    for (char& letter : part) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    EXPECT_EQ(make_upsampler(part, workers, 0).upsampler->device(), devices[0].name);
}

TEST(MakeUpsampler, ListsTheDevicesWhenThereIsNoSuchOne) {
    for (const char* request : {"no such device", "999", "99999999999999999999999"}) {
        const std::string words = refusal(request);
        EXPECT_NE(words.find(request), std::string::npos) << words;
        EXPECT_NE(words.find("reference"), std::string::npos) << words;
        for (const DeviceDescription& device : list_devices())
            EXPECT_NE(words.find(device.name), std::string::npos) << words;
    }
}

TEST(ListDevices, MarksAtMostOneDefault) {
    int defaults = 0;
    for (const DeviceDescription& device : list_devices()) {
        EXPECT_FALSE(device.name.empty());
        if (device.is_default) ++defaults;
    }
    EXPECT_LE(defaults, 1);
}

} // namespace
} // namespace knead
