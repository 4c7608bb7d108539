#pragma once
// Parts of the cloud that hold no handle and go along with what does: the setting `strays` = "carry".
//
// Each part moves as a whole by ONE rigid motion: that of the surface next to it. The vertices of the part
// that are nearest to parts with a handle, a tenth of it, but at least eight, are its contacts, spread evenly
// over these where they are more than 256; each leans on the vertex nearest to it there, as the shape was
// opened. A frame takes the mean of the motions of those (one weighted sum over a few samples, made ready
// beforehand), the rotation nearest to it, and moves the part so that the middle of what it leans on stays
// under it, as far as the samples' own motions tell (between samples of a bent surface points follow arcs,
// upsample/upsample.h). Where nothing moves there, the part keeps every bit.

#include "graph/influences.h"
#include "graph/neighbors.h"
#include "upsample/upsample.h"

#include <span>
#include <vector>

namespace knead {

// What each part leans on. All arrays run over the parts that are carried.
struct Contacts {
    std::vector<Index> part;   // of each component: its number as a part, or no_index if it is not carried
    std::vector<Index> first;  // part p leans on vertex[first[p]] … vertex[first[p + 1] - 1]; and the end
    std::vector<Index> vertex; // may repeat

    std::size_t parts() const { return first.empty() ? 0 : first.size() - 1; }
};

// `positions`: 3 floats a vertex, in Morton order, as opened; `held`: of each component, whether it holds a
// handle. Every other component is carried; none if there is nothing to lean on.
Contacts find_contacts(std::span<const float> positions, const Components& components,
                       const std::vector<bool>& held, Workers& workers);

// The same, ready for frames. Parts are numbered as in the contacts.
struct CarriedParts {
    std::vector<Index> first;   // part p follows motion[first[p]] …; and the end
    std::vector<Index> motion;  // the numbers of samples' and handles' motions, ascending within a part
    std::vector<double> weight; // of each, summing to 1 over a part
    std::vector<Vec3d> anchor;  // the middle of what it leans on, at rest

    std::size_t size() const { return anchor.size(); }
};

// `mover`: of each vertex, what moves it, as influence_of() reads it. Anchors are left at zero.
CarriedParts carried_parts(const Contacts& contacts, const InfluenceRows& rows, InfluenceWeights weights,
                           std::span<const Index> mover);

// One part's motion, from those of samples and handles. Allocates nothing.
Motion carried_motion(const CarriedParts& parts, std::size_t part, std::span<const Motion> motions);

} // namespace knead
