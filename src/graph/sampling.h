#pragma once
// The samples of a cloud, those of the handles among them, and the graph between them.

#include "graph/changing_territories.h"
#include "graph/flood.h"
#include "graph/held_blocks.h"
#include "graph/neighbors.h"
#include "graph/point_order.h"

#include <cstdint>
#include <span>
#include <vector>

namespace knead {

// What handle_samples() needs to know of the cloud, all a vertex.
struct VertexShape {
    const MortonCube& cube;           // along whose curve they come
    std::span<const float> positions; // 3 floats a vertex
    const Graph& graph;
    const Components& components;
    std::span<const std::uint8_t> hanging = {}; // 1 for an outlier, which is not chosen where there is
                                                // another one to choose; empty without any
};

// What a set of handles needs beside the base samples.
struct HandleSamples {
    std::vector<Index> added;          // vertices that hold no base sample, all different, ascending by
                                       // label, and within each as shuffle_in_runs() leaves them
    std::vector<BorderVertex> borders; // all of them, ascending by (label, vertex)
};

// The samples that a set of handles adds.
//   - Two for each territory of a base sample that a border runs through, if it has as many vertices, are
//     spread along it: more gain nothing, and have to be flooded and taken back at every change of handles.
//     Where this is more than `budget` in all, the borders share that by it, and none is left out while
//     another has two.
//   - Every label owns at least one sample in every component where it has a border, and one anywhere if it
//     has none, budget or not. What is held and has no free neighbour moves nothing but itself, unless the
//     label is one of `everywhere` (of each label; may end early): these own one in every component that they
//     reach into.
// `held`: find_held() of all these; `base`: vertices, in any order; `nearest`: their territories.
HandleSamples handle_samples(const VertexShape& shape, const VertexLabels& labels,
                             std::span<const HeldBlock> held, std::span<const Index> base,
                             const ChangingTerritories& nearest, const std::vector<bool>& everywhere,
                             std::size_t budget);

// The graph between samples, and how long a border the territories of two linked ones share.
struct SampleGraph {
    Graph graph;
    std::vector<float> contact; // for every entry of graph.neighbor: links of the point graph that cross the
                                // border; ½ if none
};

// Links each sample to the `sample_neighbors` nearest others along the surface, and back, and to all whose
// territories touch its own. The latter never leave a seam between rows of samples, and make the components
// of the samples those of the points: where the six nearest leave a neck open, the floods still meet.
// `nearest`: of each sample the row of its vertex in the flood of base samples, the first of them itself
// unless it was added later; `borders`: of all their territories. How far two added ones are from each other
// is known only where their territories touch; they count as near only there.
inline constexpr std::size_t sample_neighbors = 6;
SampleGraph sample_graph(std::span<const WideRow> nearest, std::span<const TerritoryBorder> borders,
                         Workers& workers);
// The same where no sample was added, and the borders are not known yet. `samples`: the vertex of each;
// `nearest`: the flood from them over the graph `points`.
SampleGraph sample_graph(const InfluenceRows& nearest, std::span<const Index> samples, const Graph& points,
                         Workers& workers);

// The sample graph where every point is a sample: that of the points (solid_links.h), every contact 1.
SampleGraph sample_graph_of_all(const Graph& points);

} // namespace knead
