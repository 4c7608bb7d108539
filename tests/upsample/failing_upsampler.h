#pragma once
// A device that is lost.

#include "base/workers.h"
#include "upsample/devices.h"

#include <algorithm>

namespace knead::test {

// Works as `works` does until the call of prepare() or run() that it is told to fail in, from 1; and never
// again.
class FailingUpsampler final : public Upsampler {
public:
    FailingUpsampler(std::unique_ptr<Upsampler> works, int failing_call, int* calls = nullptr)
        : works_(std::move(works)), failing_call_(failing_call), calls_(calls) {}

    std::string device() const override { return "a flaky device"; }
    std::size_t influence_bytes() const override { return works_->influence_bytes(); }

    void prepare(const UpsampleInput& input, std::size_t motions) override {
        if (fails()) throw DeviceFailure("the kernel does not compile");
        works_->prepare(input, motions);
    }

    std::span<const Index> run(std::span<const Motion> motions, std::span<float> positions,
                               std::span<float> normals, Held held) override {
        if (fails()) {
            std::ranges::fill(positions, 7.0F); // half-written results
            std::ranges::fill(normals, 7.0F);
            throw DeviceFailure("the device was lost");
        }
        return works_->run(motions, positions, normals, held);
    }

private:
    bool fails() {
        if (calls_) ++*calls_;
        return ++call_ >= failing_call_;
    }

    std::unique_ptr<Upsampler> works_;
    int failing_call_;
    int call_ = 0;
    int* calls_; // counts them for whoever wants to know; or null
};

// For ReplayOptions and OpenRequest: such a device, which rounds as the reference does, with what replaces
// it.
inline UpsamplerMaker failing_in_call(int call, int* calls = nullptr) {
    return [=](const std::string& /*request*/, Workers& workers, unsigned /*threads*/) {
        auto flaky = std::make_unique<FailingUpsampler>(make_reference_upsampler(workers), call, calls);
        return UpsamplerChoice{make_fallback_upsampler(std::move(flaky), workers), {}};
    };
}

// The same of a device of list_devices().
inline UpsamplerMaker device_failing_in_call(std::size_t device, int call, int* calls = nullptr) {
    return [=](const std::string& /*request*/, Workers& workers, unsigned threads) {
        auto flaky =
            std::make_unique<FailingUpsampler>(make_opencl_upsampler(device, workers, threads), call, calls);
        return UpsamplerChoice{make_fallback_upsampler(std::move(flaky), workers), {}};
    };
}

} // namespace knead::test
