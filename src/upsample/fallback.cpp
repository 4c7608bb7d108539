// An upsampler that survives its device.

#include "upsample/devices.h"

#include <utility>

namespace knead {

namespace {

class FallbackUpsampler final : public Upsampler {
public:
    FallbackUpsampler(std::unique_ptr<Upsampler> primary, Workers& workers)
        : workers_(workers), current_(std::move(primary)) {}

    std::string device() const override { return current_->device(); }

    void prepare(const UpsampleInput& input, std::size_t motions) override {
        input_ = input;
        motions_ = motions;
        try {
            current_->prepare(input, motions);
        } catch (const DeviceFailure& failure) {
            replace(failure);
        }
    }

    std::span<const Index> run(std::span<const Motion> motions, std::span<float> positions,
                               std::span<float> normals, Held held) override {
        try {
            return current_->run(motions, positions, normals, held);
        } catch (const DeviceFailure& failure) {
            replace(failure);
            return current_->run(motions, positions, normals, Held::nothing); // they may be half written
        }
    }

    std::shared_ptr<const DeviceFrame> frame(std::span<const Motion> motions) override {
        return current_->frame(motions); // calls no device
    }

    bool shares_with_opengl() const override { return current_->shares_with_opengl(); }

    std::size_t influence_bytes() const override { return current_->influence_bytes(); }

    std::string take_warning() override { return std::exchange(warning_, {}); }

private:
    // Whole or not at all: where memory runs out, the next call meets the device that failed again.
    void replace(const DeviceFailure& failure) {
        std::string warning = current_->device() + " failed (" + failure.what() +
                              "); the points are moved in plain C++ from here on, the same but for rounding";
        std::unique_ptr<Upsampler> next = make_reference_upsampler(workers_);
        next->prepare(input_, motions_);
        current_ = std::move(next);
        warning_ = std::move(warning);
    }

    Workers& workers_;
    std::unique_ptr<Upsampler> current_;
    UpsampleInput input_;
    std::size_t motions_ = 0;
    std::string warning_;
};

} // namespace

std::unique_ptr<Upsampler> make_fallback_upsampler(std::unique_ptr<Upsampler> primary, Workers& workers) {
    return std::make_unique<FallbackUpsampler>(std::move(primary), workers);
}

} // namespace knead
