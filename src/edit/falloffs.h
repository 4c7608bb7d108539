#pragma once
// Handles that pull what is around them.

#include "base/progress.h"
#include "base/workers.h"
#include "deform/sample_system.h"
#include "edit/handles.h"
#include "edit/small_patches.h"
#include "graph/held_blocks.h"
#include "graph/neighbors.h"

#include <span>
#include <vector>

namespace knead {

// A sample within the falloff of a handle.
struct Pulled {
    Index sample = 0;
    Index handle = 0;
    double way = 0; // from the handle along the surface, as a part of the falloff: 0 … 1
    double falloff = 0;
    Index held = 0; // the vertex of the handle that this is the way from
    // Of a handle that leaves rotation free: SoftHold's.
    Index bed = no_index, turner = no_index;
    double as_turner = 0;
};

// Who is pulled by whom. `label`: the handle of each vertex, and `blocks` what find_held() made of these;
// `patches`: those of the handles that are small, and `near` what is around them; `part`: the component of
// each vertex; `samples`: the vertex of each sample; `positions`: 3 floats a vertex. Held samples are not
// pulled, and the falloff of a small patch is at least its least one.
std::vector<Pulled> pulled_samples(const std::vector<Handle>& handles, std::span<const Index> label,
                                   const ComponentNumbers& part, std::span<const HeldBlock> blocks,
                                   std::span<const SmallPatch> patches, const Vicinities& near,
                                   std::span<const Index> samples, const Graph& graph,
                                   std::span<const float> positions, Workers& workers, Progress& progress);

// How strongly, with the samples' graph, weights and rest positions in `rest`. The pull is that of a bed of
// springs whose stiffness over that of the surface is the inverse of a length squared: it looks alike for any
// number of samples. It is the stronger the nearer the handle is, down to 0.12 % of the cloud's size, and
// vanishes smoothly at the falloff's end:
//
//     μ_i = 4 ((1 - t)/d)² Σ_j w_ij |e_ij|²,  d = the distance, t = d / falloff.
//
// Around a handle that leaves rotation free, what is pulled goes with what is held next to it, and turns
// about that: as all does that a patch of the handle pulls, or, the larger the patch is beside its falloff,
// as the handle's sample there. `held`: of each entry of `pulled` where its `held` is at rest.
std::vector<SoftHold> soft_holds(const std::vector<Handle>& handles, std::span<const Pulled> pulled,
                                 std::span<const Vec3d> held, const SampleRest& rest);

} // namespace knead
