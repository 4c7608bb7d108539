#pragma once
// An upsampler that remembers what it was given, so that the same frames can be run again elsewhere, and that
// moves all points in every frame, whatever is held.

#include "upsample/upsample.h"

#include <memory>
#include <vector>

namespace knead {

class UpsamplerProbe final : public Upsampler {
public:
    explicit UpsamplerProbe(std::unique_ptr<Upsampler> inner) : inner_(std::move(inner)) {}

    std::string device() const override { return inner_->device(); }
    void prepare(const UpsampleInput& input, std::size_t motions) override;
    std::span<const Index> run(std::span<const Motion> motions, std::span<float> positions,
                               std::span<float> normals, Held held) override;
    std::size_t influence_bytes() const override { return inner_->influence_bytes(); }
    std::string take_warning() override { return inner_->take_warning(); }

    // What it was prepared with last, good as long as the pipeline that did so.
    const UpsampleInput& input() const { return input_; }

    // The motions of the last frame.
    const std::vector<Motion>& motions() const { return motions_; }

    Upsampler& inner() { return *inner_; }

private:
    std::unique_ptr<Upsampler> inner_;
    UpsampleInput input_;
    std::vector<Motion> motions_;
};

// What a frame of it moves: each point's rest position in, its position out, normals in and out where there
// are any, and what moves which of them in. The motions stay in cache.
std::size_t bytes_a_frame(const UpsamplerProbe& probe);

} // namespace knead
