#pragma once
// The deformation of the samples: how their positions and rotations follow the handles.
//
// Samples s have rest positions p, displacements u (so they are at x = p + u now) and rotations r (unit
// quaternions, rest to now); edges (i, j) of the sample graph have rest vectors e_ij = p_j - p_i and weights
// w_ij. The shape sought makes, for a material that does not contract when it is pulled,
//
//     E = Σ w_ij |x_j - x_i - ½(R_i + R_j) e_ij|² + β Σ w_ij |r_j - r_i|²,   β = α s²
//
// small: Equation (2) of the paper, of both ends of an edge, and Equation (1), which is a Laplacian of the
// rotations (tests/deform proves it). s is the cloud's size, so that the stiffness does not depend
// on how many samples there are. One iteration is
//
//     1. r*_i = the rotation nearest to Σ_j w_ij (R_i e_ij + x_j - x_i - M_ij e_ij) e_ijᵀ, of the hemisphere
//     of r_i; M_ij = M_i + γ/2 (M_j - M_i),
//     2. (β/ℓ² L + C) r = C r* with the handles' rotations given, normalised; C_i = Σ_j w_ij |e_ij|²/ℓ², ℓ² =
//     mean |e|²,
//     3. L x = b with the handles' positions given; b_i = Σ_j w_ij ½(M_i + M_j)(p_i - p_j), M = R S with S
//     the elastic target of deform/stretch.h (the identity for ν = 0), and on a handle, of a link of which φ
//     lies on it, R + 2φ (A - R) with A its whole linear map,
//
// with L the graph's weighted Laplacian. (With A itself, as if every link lay half on the handle, a handle
// that stretches what it holds pushed all beyond it away by as much as half a link of the samples grew.)
//
// γ is 1, but for stiffnesses below .001, where it goes to 0: γ = α²/(α² + 10⁻⁸). On a circle the chord
// between two samples has the direction midway between both their turns, and step 3 lays it there. Step 1
// with γ = 0, Equation (2) as it stands, takes it for the direction of one end: then every link resists being
// bent by itself, as much as α = ¾ e²/s² does (.0045 for 200 samples of a surface, .001 for 1000), and so
// does the shape depend on how many samples there are. With γ = 1 only α resists. A sheet for which α is next
// to nothing would wrinkle and not come to rest; there the resistance of the links is what holds it.
//
// Where there are few samples, the energy is summed up over the points between them instead of over links
// (deform/point_energy.h). All three steps and both matrices then have sums over bodies in the place of sums
// over links, and links count a hundredth beside them, for what no point tells of. With D - A̅ P in the place
// of x_j - x_i - M_ij e:
//
//     1. r*_t is the rotation nearest to Σ 2ω v_t (R_t P + D - A̅ P), A̅ = (1 - γ) M_t + γ Σ_s v_s M_s,
//     2. L_ts = Σ ω ĝ_t·ĝ_s and C_t = Σ 2 dim ω v_t/ℓ²,
//     3. L_ts = Σ ω g_t·g_s and b_t = -Σ_s (A_s Σ ω H_s g_t - M_s Σ ω v_s P g_t),
//
// A and M standing for A - I and M - I in these three, as D is of displacements: exactly nothing where
// nothing moves.
//
// The A of a sample is fitted to the points before each iteration (deform/fitted_maps.h), with the M that
// links say, and turns with it.
//
// S is by links for ν < 0: they see best how a tube of few samples widens. For ν > 0 it follows shears,
// and would drive those that links see and points hardly make: with 200 samples, tubes of points that lie
// anywhere swell into lumps (tests/edit/rubber_test.cpp). There S is by what pulls, links and points
// together, F = (A + Σ 2ω v_t D) (Σ w e eᵀ + Σ 2ω v_t P)⁺ in the place of A Σ⁺: a mean of what points do,
// weighted as they answer to it, can drive nothing by more than ν < 1. (At a frame's start, before the first
// iteration, S is by links.)
//
// With more samples both count, points by their share and links by the rest, all sums and matrices being
// sums of both. So they do where turns spread over half a link, β from 0.15 to 0.3 ℓ²: the blends are too
// wide for a sheet that is softer, and links hold it.
//
// A leaf, a free sample with one link, to a sample with more, is sent the same way whatever that link weighs:
// along with the other end. So its link counts with a thousandth of its weight, or less if it is longer than
// ℓ, and of links C is 0 there: the turn that one edge leaves open is that of the other end. Nothing pulls at
// a leaf.
//
// The fixed point of these steps is what knead means by the deformed shape. Both matrices stand as long as
// the handle set and the rest shape do. Everything is solved for u and r - 1, which are exactly zero where
// nothing moves.

#include "base/workers.h"
#include "deform/bodies.h"
#include "deform/fitted_maps.h"
#include "deform/point_energy.h"
#include "deform/stretch.h"
#include "graph/csr.h"
#include "solve/sparse_cholesky.h"

#include <span>
#include <vector>

namespace knead {

// What a handle does to the points it holds: p → linear p + offset, about the cloud's origin.
struct HandleMotion {
    Quatd rotation =
        Quatd::Identity(); // unit; continues its own hemisphere from frame to frame, so that turns are kept
    Mat3d linear = Mat3d::Identity(); // the rotation, times the stretch of a scaling handle
    Vec3d offset = Vec3d::Zero();
    Vec3d turned =
        Vec3d::Zero(); // the same rotation as angles about x, y and z, in radians, whole turns counted
                       // (edit/handle_motion.h); for whoever tells of it, nothing computes with it
};

// A free sample that a handle with a falloff pulls: its position to where the handle sends it and, unless the
// handle leaves rotation free, its rotation to the handle's. In step 3, L + μ stands in the place of L, and
// μ u in b, with u how far the handle sends it; and likewise in step 2.
struct SoftHold {
    Index sample = 0;
    Index handle = 0;
    double weight = 0;            // μ, of the size of the weights of the links; > 0
    Vec3d anchor = Vec3d::Zero(); // it is to go as far as the handle sends this: its own rest position, or,
                                  // for a handle that leaves rotation free, what is held next to it
    // How it turns where the handle leaves rotation free; no_index for other handles. (A handle that holds a
    // single place says nothing of turns: the denser the samples, the more those around would turn by
    // chance.)
    Index bed = no_index;    // the number of its bed, with all of which it turns about the anchor; or
    Index turner = no_index; // this sample of the handle, whose turn it takes over
    double as_turner = 0;    // to so much, 0 … 1
};

// All that is pulled round a place that leaves rotation free turns as it was moved: by the least-squares
// rotation about the anchors, of Σ μ |x - R e|². What only a sample there does would depend on how far apart
// samples are, since a surface that is pulled at a point turns the more, the nearer one looks. Along a handle
// that is larger than what it pulls, each sample of it has a rotation of its own.
struct Bed {
    double spread = 0;         // Σ μ |e|²
    Mat3d sum = Mat3d::Zero(); // Σ μ x eᵀ
};

// What of a bed has one turner.
struct BedPart {
    Index bed = 0, turner = 0;
    double as_turner = 0;
    double own = 0;             // what the turner's rotation counts anyhow, where others leave it open
    Mat3d turn = Mat3d::Zero(); // R - I
};

// What stays while an edit lasts.
struct SampleRest {
    Graph graph;                    // between samples
    std::vector<double> weight;     // of each link of the graph, the same in both directions, > 0; those of
                                    // leaves are made lighter by build_system()
    std::vector<float> held_part;   // φ of each link from a free sample to a held one, 0 … 1; empty: 0
    std::vector<Vec3d> position;    // p, relative to the cloud's origin
    std::vector<Index> handle;      // of each sample; no_index where it is free
    std::vector<bool> turns_freely; // of each handle: whether it gives positions only; may end early
    std::vector<SoftHold> pulled;   // samples that no handle holds
    PointEnergy energy;             // of the points between; empty: links alone count
    double cloud_size = 1;          // s, in the units of the positions
    double stiffness = 0.01;        // α
    double poisson = 0;             // ν, -1 < ν < 0.5
};

// Where the samples are; also the warm start of the next frame.
struct SampleState {
    std::vector<Quatd> rotation;       // r
    std::vector<Vec3d> displacement;   // u
    std::vector<HandleMotion> handles; // where the handles were then; empty: at rest, or where the points
                                       // have no energy
};

// Both systems, factorised, and the work space of an iteration.
struct SampleSystem {
    SampleRest rest;
    // Of each sample its row, or no_index where its rotation is given or it is left out. The first
    // `moving_rows` have a free position, too: they alone are rows of step 3.
    std::vector<Index> unknown;
    std::vector<Index> free_sample; // of each row: its sample
    std::size_t moving_rows = 0;
    std::vector<bool> left_out;     // of each sample: whether no handle holds its component
    double mean_length = 1;         // ℓ, over links that are not those of leaves
    double smoothing = 0;           // β/ℓ²
    double midway = 1;              // γ; with 0, rotations follow from displacements alone
    std::vector<double> confidence; // C, of each row
    SparseFactor rotations;         // β/ℓ² (L + μ) + C
    SparseFactor positions;         // L + μ, of the moving rows
    SparseFactor increments; // L + μ of all rows, where that is not what `positions` holds; by links alone
                             // where it hinges()
    bool has_increments = false;
    std::vector<double> pull;            // Σ μ of each row; empty where nothing is pulled
    std::vector<double> turn_pull;       // the same of what is pulled to turn, too
    std::vector<Index> sample_of_handle; // of each that says how it turns and has one: any; may end early
    std::vector<Bed> beds;
    std::vector<BedPart> bed_parts;
    std::vector<Index> bed_part; // of each of rest.pulled; no_index where it has no bed
    std::vector<Vec3d> shift; // τ of coarse_level.h, of each moving row: added to what step 3 finds; or empty

    std::vector<Vec3d> weighted_edge;       // w e of each link of the graph
    std::vector<Mat3d> spread;              // Σ w e eᵀ of each row, symmetric to the last bit
    std::vector<Surroundings> surroundings; // of each row, by its links
    std::vector<Surroundings>
        with_points; // the same by links and points; empty where there is no rest.energy

    std::vector<Mat3d> turn;      // M - I, of each sample; of a handle's R - I
    std::vector<Mat3d> growth;    // 2 (A - R) of each handle
    bool grows = false;           // whether any handle scales what it holds, and it counts
    std::vector<Body> body;       // of rest.energy: samples, handles, and what those grow by
    std::vector<Quatd> free_turn; // of each handle that `rest.turns_freely` tells of
    std::vector<Mat3d> target;    // S - I, of each row; empty for ν = 0
    std::vector<Mat3d> stretch;   // Rᵀ A - I of each row; empty where there is no rest.energy
    MapFit fit;
    std::vector<double> sides; // right-hand sides and solutions, 4 or 3 numbers a row
};

// Whether a handle leaves rotation free: there are rows whose positions are given. Turns pass through it
// then, and at a frame's start by links alone: in the energy of the points its samples are one body, which is
// no row.
inline bool hinges(const SampleSystem& system) {
    return system.free_sample.size() > system.moving_rows;
}

// The sample of a handle that says how what it pulls is to turn; no_index where it does not say.
inline Index turns_with(const SampleSystem& system, const SoftHold& hold) {
    return hold.handle < system.sample_of_handle.size() ? system.sample_of_handle[hold.handle] : no_index;
}

// Whether a free sample has one link alone, to a sample that has more.
bool is_leaf(const SampleRest& rest, Index sample);

// Prepares both systems: a factorisation of each, of one ordering unless a handle leaves rotation free; a
// third (`increments`) where one does, or pulls with no sample to say how it turns. Samples whose component
// holds no handle are left out and stay at rest. On a bad outcome the system must not be iterated.
FactorOutcome build_system(SampleRest rest, SampleSystem& system, Workers& workers);

// The matrices of steps 2 and 3 of a system that was built, as they were factorised: for comparing solvers.
struct SystemMatrices {
    SparseMatrix rotations, positions; // of one pattern where no handle leaves rotation free
};
SystemMatrices system_matrices(const SampleSystem& system);

// Another Poisson's ratio; neither system changes.
void set_poisson(SampleSystem& system, double poisson, Workers& workers);

// All samples at rest.
SampleState rest_state(const SampleSystem& system);

// Equations (3): the samples of handles go where the handles are, and turn as they do where that is given.
// A part of follow_handles() and iterate(); by itself for who moves the others otherwise.
void place_handles(SampleSystem& system, std::span<const HandleMotion> handles, SampleState& state);

// Starts a frame from where the last one ended: Equation (1) alone for how far the handles turned since then,
// harmonic between them, is put on top of the turns that the samples have made, and positions follow. From
// rest this is the paper's linear solution. Turns are handed on evenly in every frame and add up, however
// many there are. `handles` holds the motion of every handle that `rest.handle` names.
void follow_handles(SampleSystem& system, std::span<const HandleMotion> handles, SampleState& state,
                    Workers& workers);

// How the surroundings of a sample that turns by itself were moved, by its links: F - I (deform/stretch.h).
Mat3d sample_gradient(const SampleSystem& system, const SampleState& state, Index i);

// Finds how the samples that turn by themselves send the points around them, of the state and the handles'
// motions alone. For whoever moves points next; iterate() does so itself. Allocates nothing of its own.
void find_maps(SampleSystem& system, std::span<const HandleMotion> handles, const SampleState& state,
               Workers& workers);

// A - I of such a sample, as it was found; by its links (sample_gradient()) where no points have an energy.
Mat3d sample_map(const SampleSystem& system, const SampleState& state, Index i);

// One iteration from where the samples are, towards the handles' present motions. Allocates nothing of its
// own. Returns the longest way that a sample went.
double iterate(SampleSystem& system, std::span<const HandleMotion> handles, SampleState& state,
               Workers& workers);

} // namespace knead
