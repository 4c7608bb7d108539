#pragma once
// Tests of what every Upsampler promises: asked of the reference, of every OpenCL device, and of every OpenCL
// device made to copy as a GPU does.

#include "base/workers.h"
#include "support/comparing.h"
#include "upsample/devices.h"
#include "upsample/scene.h"

#include <gtest/gtest.h>

namespace knead::test {

enum class Path { reference, device, device_with_own_memory };

class EveryUpsampler : public ::testing::TestWithParam<Path> {
protected:
    // One of each device there is; empty where the test is to be skipped. `kernel` is built instead of
    // kernels/upsample.cl, and must outlive what is made.
    std::vector<std::unique_ptr<Upsampler>> all(unsigned threads = 0, const char* kernel = nullptr) {
        std::vector<std::unique_ptr<Upsampler>> made;
        workers_.push_back(std::make_unique<Workers>(threads));
        if (GetParam() == Path::reference) {
            made.push_back(make_reference_upsampler(*workers_.back()));
            return made;
        }
        const bool own = GetParam() == Path::device_with_own_memory;
        const std::size_t devices = list_devices().size();
        for (std::size_t i = 0; i < devices; ++i)
            made.push_back(make_opencl_upsampler(
                i, *workers_.back(), threads,
                {.memory = own ? DeviceMemory::own : DeviceMemory::as_the_device_has_it, .kernel = kernel}));
        return made;
    }

    void SetUp() override {
        if (GetParam() != Path::reference && list_devices().empty())
            GTEST_SKIP() << "there is no OpenCL device";
    }

private:
    std::vector<std::unique_ptr<Workers>> workers_; // outlive what all() made
};

inline const auto all_paths = ::testing::Values(Path::reference, Path::device, Path::device_with_own_memory);
inline std::string name_of_path(const ::testing::TestParamInfo<Path>& tested) {
    return tested.param == Path::reference ? "Reference"
           : tested.param == Path::device  ? "Device"
                                           : "DeviceWithOwnMemory";
}

inline bool same_bits(const Posed& a, const Posed& b) {
    return same_bits(a.positions, b.positions) && same_bits(a.normals, b.normals);
}

} // namespace knead::test
