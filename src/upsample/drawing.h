#pragma once
// Points moved on a device with memory of its own, and left there. On one that shares its memory with OpenGL
// (cl_khr_gl_sharing) a frame is written into the very buffers that it is drawn from: the motions go in and
// the points' boxes come out, and nothing else passes the processor.
//
// Two threads take part. Whoever computes the motions makes a frame of them by Upsampler::frame(); whoever
// draws moves the points by it when it needs them, or not at all where there is a newer one by then.

#include "upsample/upsample.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace knead {

// An OpenCL device that shares its memory with an OpenGL context. It, and whatever was made with it, must go
// before that context does.
struct GlSharing;

// The device that draws the OpenGL context which is current in this thread; null where it shares nothing, or
// there is no context. Opens the device: a tenth of a second where it is the first time.
std::shared_ptr<const GlSharing> share_with_current_gl_context();

// Lowest x, y, z and highest x, y, z.
using PointBox = std::array<float, 6>;

// One thread at a time, with the OpenGL context current that the device shares memory with.
class DrawnPoints {
public:
    DrawnPoints();
    ~DrawnPoints();
    DrawnPoints(const DrawnPoints&) = delete;
    DrawnPoints& operator=(const DrawnPoints&) = delete;

    // OpenGL's names of the buffers: 3n floats each. `normals` is not looked at for points without.
    struct Buffers {
        unsigned positions = 0, normals = 0;
        bool operator==(const Buffers&) const = default;
    };

    // Moves all points by a frame, into these buffers. OpenGL must be done with them (glFinish), and OpenCL
    // is, when this returns. `held`: as of Upsampler::run(); these buffers have what the last call wrote.
    // Throws DeviceFailure; then the buffers may have anything.
    void move(const DeviceFrame& frame, Buffers buffers, Held held);

    // The same into memory of the device's own, and what is there then: for tests, and to measure it. Spans
    // as of Upsampler::run().
    void move(const DeviceFrame& frame, Held held);
    void read(std::span<float> positions, std::span<float> normals);

    // Around the finite points of every block (point_blocks.h), as they were moved last; lowest > highest
    // where there are none.
    std::span<const PointBox> boxes() const;

    // What the device took to move the points in the last call, in seconds, by its own clock; without the
    // boxes.
    double moving_seconds() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

// What the device of a frame takes, by its own clock, to copy within its memory so that `bytes` are read or
// written in all; in seconds, `repeats` times after one that warms up. Throws DeviceFailure.
std::vector<double> device_copy_seconds(const DeviceFrame& frame, std::size_t bytes, std::size_t repeats);

} // namespace knead
