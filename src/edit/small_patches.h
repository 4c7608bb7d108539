#pragma once
// The parts of handles that are so small that they pull what is around them, and what that is.
//
// A surface cannot carry a point, and what pulls at one draws out a spike, the sharper the more samples there
// are. A handle of three points far apart is three of these, and so is a stray that a lasso caught beside a
// large part; so patches are looked at, and not what a handle holds in all.

#include "base/progress.h"
#include "base/workers.h"
#include "graph/csr.h"
#include "graph/held_blocks.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace knead {

// How far a patch of this radius pulls what is around it, whatever the handle's own falloff is: 6 % of the
// cloud's size for a single point or a line, less for what is larger, and 0 from 3 % on.
inline constexpr double largest_small_falloff = 0.06; // of the cloud's size
double least_falloff(double radius, double cloud_size);

// What a handle holds that hangs together, if it is small. What one free vertex lies between hangs together,
// too: a selection with holes is one patch.
struct SmallPatch {
    Index handle = 0;
    double radius = 0;           // HeldExtent::radius(), or if that is less, how wide it is
    double falloff = 0;          // least_falloff(), > 0
    double reach = 0;            // of its first vertex to the farthest
    std::vector<Index> vertices; // all different
};

// The small patches of handles, for whoever looks on from elsewhere.
struct PatchesOfHandles {
    std::vector<SmallPatch> patches;
    std::vector<std::shared_ptr<const std::vector<Index>>> points; // Handle::points of each label
};

// Those that have a free vertex beside them, of the first `handles` labels. `label`: who holds each vertex;
// `blocks`: what find_held() made of that; `positions`: 3 floats a vertex. Of a large patch only some of what
// lies along its border is looked at.
std::vector<SmallPatch> small_patches(std::size_t handles, std::span<const Index> label,
                                      std::span<const HeldBlock> blocks, const Graph& graph,
                                      std::span<const float> positions, double cloud_size);

// A free vertex within the falloff of a patch, which is a sample or may become one.
struct NearPatch {
    Index vertex = 0;
    Index source = 0;    // the vertex of the patch that it is nearest to along the surface
    Index patch = 0;     // its place in the list
    double distance = 0; // from there, below the patch's falloff
    bool is_sample = false;
};

// One list a handle: the free vertices within the falloffs of its small patches that are nearer to these than
// to any other handle, ascending by distance. (What is nearer to a large handle follows that one.) Not every
// vertex is asked: all of `samples` are, and of the others one in so many, spread evenly and alike around all
// handles; one in more where the cloud is large or the handles are many.
using Vicinities = std::vector<std::vector<NearPatch>>;
Vicinities vicinities(std::size_t handles, std::span<const SmallPatch> patches,
                      std::span<const Index> samples, std::span<const Index> label,
                      std::span<const HeldBlock> blocks, const Graph& graph, std::span<const float> positions,
                      Workers& workers, Progress& progress);

} // namespace knead
