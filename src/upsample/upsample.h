#pragma once
// From the motions of the samples to every point's new position and normal: Equations (4) to (6) of the
// paper.
//
// A motion displaces a point p by A p + b. For a rotation R about a sample that moved from p_s to x_s, A = R
// - I and b = x_s - p_s - A p_s. A point goes by the weighted mean over its influences (graph/influences.h),
//
//     p' = p + Σ_s w_s (x_s - p_s + ½ (A_s + A̅) (p - p_s)),   A̅ = Σ_s w_s A_s,   with smooth weights,
//     p' = p + Σ_s w_s (A_s p + b_s)                                              with those of the paper,
//
// which are the same wherever all samples around it move alike. Smooth weights are balanced about p
// (graph/balanced_weights.h). The second is Equation (4). Where a surface is bent, each sample there sends
// the point along its own tangent, off to the outer side; in the first, the way from sample to point is
// turned midway between both their turns, as the chord of an arc is. For a handle, whose border is all
// around, p_s is p itself. Where nothing moves, A and b are zero and p' is p to the last bit.
//
//     n' ∥ cof(I + A̅) n,    |n'| = |n|.
//
// The cofactor matrix is the right one for normals of any linear map, scaled handles included; for one
// rotation it is that rotation, Equation (5). A normal that the map flattens to zero, or whose length squared
// does not fit a float, stays as it was at rest.
//
// The result has the same bits on every run and for any number of threads. Kernel and reference do the same
// operations in the same order; the kernel fuses products and sums where it moves points and the device can,
// so both agree within the rounding of these sums, and unfused to the bit on a device that rounds as IEEE 754
// does. Weights are shares in parts of 65,535 there (shares.h).

#include "graph/influences.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

namespace knead {

class Workers;
struct DeviceFrame;

// The displacement of one sample or handle: row-major [A | b], lengths in the cloud's units, about its
// origin.
struct Motion {
    float map[12] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}; // A00 A01 A02 b0  A10 A11 A12 b1  A20 A21 A22 b2
};

// The rest shape and who moves it. Views: the arrays must stay unchanged for as long as an Upsampler holds
// them.
struct UpsampleInput {
    std::span<const float> positions; // 3n, rest, relative to the cloud's origin
    std::span<const float> normals;   // 3n, rest, any length; or empty
    std::span<const Index> mover;     // n: what moves each point, as influence_of() reads it
    const InfluenceRows* rows = nullptr;
    InfluenceWeights weights = InfluenceWeights::smooth;
    std::span<const Vec3d> places = {}; // p_s of all samples, at rest, for smooth weights
    // One past the largest number in all rows, and one past the largest mover, if they are known: prepare()
    // reads them all to find out, else.
    std::optional<Index> rows_end = std::nullopt;
    std::optional<std::size_t> mover_end = std::nullopt;
    // Of each block of points (point_blocks.h) 0 if what moves it is as it was when prepare() was called
    // last, with these same arrays, and with the points and the samples in the same places; empty if that is
    // not known.
    std::span<const std::uint8_t> changed = {};
};

// An OpenCL device cannot do its work: the words say which call failed, on what, and OpenCL's reason, with
// the build log where it was the build. Thrown by prepare() and run() of an Upsampler that runs on a device,
// and by drawing.h.
class DeviceFailure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// What the caller's spans hold when a frame begins: nothing that counts, or what the last frame that was
// written into the same spans wrote, and nobody has touched it since.
enum class Held { nothing, last_frame };

// A caller may write its frames into so many arrays in turn, as who shows one while the next is made: of more
// they are taken to hold nothing.
inline constexpr std::size_t most_targets = 4;

// Moves all points. One object a device; set-up and per-frame work are separate. One thread at a time.
class Upsampler {
public:
    virtual ~Upsampler() = default;

    // What computes: "reference" or the OpenCL device's name.
    virtual std::string device() const = 0;

    // Takes the rest shape and the influences; again whenever any of them changed. Motions named by `rows`
    // and `mover` are numbered below `motions`. Everything that happens once is done here, so that all frames
    // take the same time: opening the device and building the kernel (in the first call that has points),
    // uploading, and a first small launch.
    virtual void prepare(const UpsampleInput& input, std::size_t motions) = 0;

    // One frame: takes all `motions` that prepare() was told of, for 3n posed positions, and 3n normals if
    // the input had them (else `normals` must be empty). The results must not overlap the rest shape. The
    // spans are the caller's; on a CPU device nothing is copied on the way. Allocates nothing after the first
    // frame into each of most_targets spans.
    //
    // With Held::last_frame a frame costs what moves: blocks of points (point_blocks.h) that one motion alone
    // moves, and that it moved in the frame that the spans hold, and ever since, as in this one, are not
    // computed, written or fetched from the device again. Those are handles that are held still, what lies
    // outside a region of interest, and parts that nothing moves. In the first frame after prepare(), and
    // after one that failed, nothing counts as held. Every bit is the same either way.
    //
    // Returns the blocks that were written, ascending, good until the next call.
    virtual std::span<const Index> run(std::span<const Motion> motions, std::span<float> positions,
                                       std::span<float> normals, Held held) = 0;

    // A frame of these motions, as many as of run(), by which drawing.h moves the points, at any time and in
    // any thread, whatever becomes of this upsampler. Null where the device has no memory of its own: then
    // run() is all there is.
    virtual std::shared_ptr<const DeviceFrame> frame(std::span<const Motion> /*motions*/) { return nullptr; }
    // Whether that may be where they are drawn: see make_drawing_upsampler(). After the first prepare().
    virtual bool shares_with_opengl() const { return false; }

    // What a frame of all points reads, beside their rest shape, to know what moves which of them.
    virtual std::size_t influence_bytes() const = 0;

    // What the user should know about the last calls (a device that failed and was replaced), once; else
    // empty.
    virtual std::string take_warning() { return {}; }
};

// The same in plain C++ across `workers`, which must outlive it: the yardstick for every device, and what
// works where there is none. Never fails.
std::unique_ptr<Upsampler> make_reference_upsampler(Workers& workers);

} // namespace knead
