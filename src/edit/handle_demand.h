#pragma once
// Whether handles ask for more than a shape can give: when they pull the cloud apart, press it together, or
// tear it where one lies next to another. All of them are met exactly, whatever they ask; it is the cloud
// between them that pays (pulled, evenly; pressed, in folds), and the user is to know. So it is where they
// send the cloud so far that floats there lie apart.

#include "deform/strain.h"
#include "edit/handle_labels.h"
#include "graph/csr.h"
#include "graph/point_order.h"

#include <span>
#include <string>
#include <vector>

namespace knead {

// Where two handles touch: of the links between points that one holds and points that the other does, how
// many times as long as at rest one of a hundred is, or longer. Of all pairs of handles, the one parted most.
struct Parting {
    double factor = 1;                      // 1 where no handle touches another
    Index one = no_index, other = no_index; // the handles, one < other
};

// `graph`: of the vertices, for each of which `point` names one. `rest` and `posed`: 3 floats a point, in the
// order of computation.
Parting parting_of(const Graph& graph, const HandleLabels& labels, const Numbering& point,
                   std::span<const float> rest, std::span<const float> posed);

// A handle that was turned by more than the cloud between it and what stays has kept: it slipped back by
// whole turns.
struct LostTurn {
    std::string handle;         // its name
    double asked = 0, kept = 0; // degrees
};

struct HandleDemand {
    Strain strain;
    double parted = 1;      // the factor of a Parting
    std::string one, other; // the names of its handles
    double rounded = 0;     // of rounding_of()
    std::vector<LostTurn> lost;
};

// By how much of the cloud's size (cloud_size(), > 0) the positions (3 floats a point) are rounded where they
// lie farthest from the origin of the floats, which is where the cloud was opened; 0 where all points lie in
// one place, so that there is nothing to be rounded off.
double rounding_of(std::span<const float> posed, double size);

// What the user should hear about it; empty as long as the shape can follow: no more than one link of a
// hundred is pulled to more than 2.5 times its length, or pressed to less than a third of it, no two handles
// that touch part by more than that, no turns are lost, and nothing is rounded by more than 10⁻⁵ of the
// cloud's size. (In the sessions of data/regression that ask for nothing impossible, links stay within 0.6
// … 1.7 times theirs.)
std::string words_about_demand(const HandleDemand& demand);

} // namespace knead
