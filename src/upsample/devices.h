#pragma once
// Which OpenCL devices there are, and an Upsampler on the one that the user asked for. upsample.h says what
// an Upsampler does. No OpenCL type leaves this room.

#include "upsample/drawing.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace knead {

enum class DeviceType { cpu, gpu, accelerator };

// "cpu", "gpu", "accelerator".
const char* name_of(DeviceType type);

// What a user chooses by. The number of a device is its place in list_devices().
struct DeviceDescription {
    std::string name;
    std::string platform; // its name and version
    DeviceType type = DeviceType::cpu;
    unsigned compute_units = 0;
    std::uint64_t memory_bytes = 0;
    bool is_default = false; // what "auto" takes: the first GPU, else the first CPU; at most one
};

// All devices that are available and have a compiler, platform by platform. A platform that cannot say what
// it has is left out; where there is no OpenCL at all the list is empty.
std::vector<DeviceDescription> list_devices();

struct UpsamplerChoice {
    std::unique_ptr<Upsampler> upsampler; // never null
    std::string warning; // for the user, where there is no device, or it cannot be opened; else empty
};

// `request` is what follows --device:
//   "" or "auto"   the default device, else the reference, with a warning
//   "reference"    plain C++
//   a number       that device of list_devices()
//   other text     the one device whose name holds it, in either case
// Throws Error (usage) that lists the devices if there is none, or if several fit.
//
// A device that fails later, in prepare() or in a frame, is replaced by the reference as
// make_fallback_upsampler() says. `workers` must outlive the result. `threads` limits a CPU device to so many
// cores; 0 does not.
UpsamplerChoice make_upsampler(const std::string& request, Workers& workers, unsigned threads);
using UpsamplerMaker = std::function<decltype(make_upsampler)>;

// The same, and where the device that is asked for is the one that shares its memory with OpenGL, it does.
// `sharing` may be null.
UpsamplerChoice make_drawing_upsampler(const std::string& request, Workers& workers, unsigned threads,
                                       std::shared_ptr<const GlSharing> sharing);

// Where a device finds the points. On a CPU its memory is the caller's, and nothing is copied; a GPU has its
// own, filled by prepare(), and a frame is one write of the motions and one read of each result.
enum class DeviceMemory { as_the_device_has_it, own };

// How a device is used.
struct DeviceUse {
    DeviceMemory memory = DeviceMemory::as_the_device_has_it; // `own` copies on a CPU, too: for tests
    const char* kernel =
        nullptr; // is built instead of kernels/upsample.cl, for tests; outlives the upsampler
    std::shared_ptr<const GlSharing> sharing = {}; // as of make_drawing_upsampler()
};

// One device by its number in list_devices(), with nothing to fall back on: prepare() and run() may throw
// DeviceFailure. Opens nothing before the first prepare(); throws DeviceFailure if there is no such
// device any more. `workers` prepare, and must outlive the result.
std::unique_ptr<Upsampler> make_opencl_upsampler(std::size_t device, Workers& workers, unsigned threads,
                                                 const DeviceUse& use = {});

// Runs `primary` until it throws DeviceFailure; from that very call on the reference does the work, and
// take_warning() tells of it. Other exceptions go through. `workers` must outlive the result.
std::unique_ptr<Upsampler> make_fallback_upsampler(std::unique_ptr<Upsampler> primary, Workers& workers);

} // namespace knead
