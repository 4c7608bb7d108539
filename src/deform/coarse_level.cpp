#include "deform/coarse_level.h"

#include "base/require.h"
#include "deform/rotation.h"
#include "graph/edge_weights.h"
#include "graph/neighbors.h"

#include <Eigen/LU>

#include <limits>
#include <map>

namespace knead {

namespace {

// The coarse samples iterate until what is left is this small beside what they began with, or so many times.
constexpr double left_over = 0.05;
constexpr unsigned most_iterations = 12;

// So many of them stand for one of all samples where they answer alone.
constexpr unsigned coarse_for_one = 4;

// So many iterations may go hardly less far than those before them.
constexpr int patience = 4;
constexpr double hardly_less = 0.8;

// Surroundings that were pressed to less than this of their volume cannot be taken back to what they were.
constexpr double flat = 1e-3;

// The coarse sample of the handle that is nearest to the one that a hold turns with, of those in this part of
// the coarse graph, which `part` tells of each; no_index if it has none there.
Index coarse_of_handle(const SampleRest& rest, const CoarseSamples& coarse, const SoftHold& hold,
                       const ComponentNumbers& part, Index this_part) {
    Index best = no_index;
    double smallest = std::numeric_limits<double>::infinity();
    for (Index c = 0; c < coarse.sample.size(); ++c) {
        const Index s = coarse.sample[c];
        if (rest.handle[s] != hold.handle || part[c] != this_part) continue;
        const double distance = (rest.position[s] - rest.position[hold.turner]).squaredNorm();
        if (distance < smallest) smallest = distance, best = c;
    }
    return best;
}

// What pulls at samples pulls at the coarse one nearest to them, altogether as much. One of a handle that
// leaves rotation free goes with what is held next to it.
std::vector<SoftHold> pulled_together(const SampleRest& rest, const CoarseSamples& coarse, Workers& workers) {
    const ComponentNumbers part = find_components(coarse.between.graph, workers).component;
    std::map<std::pair<Index, Index>, SoftHold> holds;
    for (const SoftHold& hold : rest.pulled) {
        const Index nearest = coarse.nearest[hold.sample];
        if (nearest == no_index || rest.handle[coarse.sample[nearest]] != no_index) continue;
        const auto [at, is_first] = holds.try_emplace({nearest, hold.handle});
        SoftHold& together = at->second;
        const Vec3d& place = rest.position[coarse.sample[nearest]];
        together.sample = nearest;
        together.handle = hold.handle;
        together.weight += hold.weight;
        if (hold.bed == no_index) {
            together.anchor = place;
        } else if (is_first ||
                   (hold.anchor - place).squaredNorm() < (together.anchor - place).squaredNorm()) {
            together.anchor = hold.anchor;
            together.turner = coarse_of_handle(rest, coarse, hold, part, part[nearest]);
            together.bed = together.turner == no_index ? no_index : hold.bed;
            together.as_turner = hold.as_turner;
        }
    }
    std::vector<SoftHold> result;
    result.reserve(holds.size());
    for (const auto& [whom, hold] : holds) result.push_back(hold);
    return result;
}

SampleRest coarse_rest(const SampleRest& rest, const CoarseSamples& coarse, Workers& workers) {
    SampleRest result;
    for (const Index s : coarse.sample) {
        result.position.push_back(rest.position[s]);
        result.handle.push_back(rest.handle[s]);
    }
    result.graph = coarse.between.graph;
    result.weight =
        isotropic_weights(result.graph, result.position, coarse.between.contact, of_territories, {}, workers);
    result.turns_freely = rest.turns_freely;
    result.pulled = pulled_together(rest, coarse, workers);
    result.cloud_size = rest.cloud_size;
    result.stiffness = rest.stiffness;
    result.poisson = rest.poisson;
    return result;
}

// I of the displacements.
void inject(const SampleState& state, const CoarseLevel& coarse, std::vector<Vec3d>& displacement) {
    for (std::size_t c = 0; c < coarse.samples.sample.size(); ++c)
        displacement[c] = state.displacement[coarse.samples.sample[c]];
}

// τ, from I u in `before` and the state after the fine iteration.
void find_shift(CoarseLevel& coarse, std::span<const HandleMotion> handles, const SampleState& state,
                Workers& workers) {
    SampleSystem& system = coarse.system;
    for (std::size_t c = 0; c < coarse.samples.sample.size(); ++c)
        coarse.state.rotation[c] = state.rotation[coarse.samples.sample[c]];
    coarse.state.displacement = coarse.before;
    system.shift.assign(system.moving_rows, Vec3d::Zero());
    iterate(system, handles, coarse.state, workers);
    inject(state, coarse, coarse.before);
    for (std::size_t row = 0; row < system.moving_rows; ++row) {
        const Index c = system.free_sample[row];
        system.shift[row] = coarse.before[c] - coarse.state.displacement[c];
    }
}

// Iterations of the coarse samples, until hardly anything is left or patience ends. Returns the longest way
// of the last one.
double iterate_coarse(CoarseLevel& coarse, std::span<const HandleMotion> handles, SampleState& state,
                      unsigned most, Workers& workers) {
    forget(coarse.acceleration);
    double first = 0, way = 0;
    for (unsigned iteration = 0; iteration < most; ++iteration) {
        way = iterate(coarse.system, handles, state, coarse.acceleration, workers);
        if (iteration == 0) {
            coarse.turn = state.rotation;
            first = way;
        }
        if (!(way > left_over * first)) break;
    }
    return way;
}

// v, from I G(u) in `before`.
void solve_coarse(CoarseLevel& coarse, std::span<const HandleMotion> handles, const SampleState& state,
                  Workers& workers) {
    coarse.state.displacement = coarse.before;
    for (std::size_t c = 0; c < coarse.samples.sample.size(); ++c)
        coarse.state.rotation[c] = state.rotation[coarse.samples.sample[c]];
    iterate_coarse(coarse, handles, coarse.state, most_iterations, workers);
}

// What takes each coarse sample from I G(u) to v.
void find_corrections(CoarseLevel& coarse) {
    for (std::size_t c = 0; c < coarse.samples.sample.size(); ++c) {
        Quatd& turn = coarse.turn[c];
        turn = coarse.state.rotation[c] * coarse.turn[c].conjugate();
        if (turn.w() < 0) turn.coeffs() = -turn.coeffs(); // the short way round: these are blended
        const Vec3d from = coarse.system.rest.position[c] + coarse.before[c];
        const Mat3d beyond = turn_of(turn);
        coarse.motion[c] << beyond, coarse.state.displacement[c] - coarse.before[c] - beyond * from;
    }
}

// Carries all samples along from where they are in `from`, which may be `state`.
void carry_along(const SampleSystem& fine, const CoarseLevel& coarse, const SampleState& from,
                 SampleState& state, Workers& workers) {
    workers.for_each(fine.free_sample.size(), 256, [&](std::size_t row) {
        const Index s = fine.free_sample[row];
        Eigen::Matrix<double, 3, 4> motion = Eigen::Matrix<double, 3, 4>::Zero();
        Eigen::Vector4d turn = Eigen::Vector4d::Zero();
        const Influence& followed = coarse.samples.followed[s];
        for (std::size_t k = 0; k < followed.count; ++k) {
            const Index c = followed.motion[k];
            motion += static_cast<double>(followed.weight[k]) * coarse.motion[c];
            turn += static_cast<double>(followed.weight[k]) * coarse.turn[c].coeffs();
        }
        if (!(turn.norm() > 1e-6)) motion.setZero(), turn = Quatd::Identity().coeffs(); // nothing around it
        const Vec3d at = fine.rest.position[s] + from.displacement[s];
        if (row < fine.moving_rows) {
            state.displacement[s] = from.displacement[s];
            state.displacement[s] += motion.leftCols<3>() * at + motion.col(3);
        }
        state.rotation[s] = (Quatd(turn) * from.rotation[s]).normalized();
    });
}

// How the surroundings of a coarse sample were moved: its handle's rotation, or F.
Mat3d linear_map(const CoarseLevel& coarse, const SampleState& state, Index c) {
    const SampleSystem& system = coarse.system;
    if (system.left_out[c]) return Mat3d::Identity();
    const bool given = system.unknown[c] == no_index;
    return Mat3d::Identity() + (given ? system.turn[c] : sample_gradient(system, state, c));
}

// What takes each coarse sample from the anchor to where it is now. Quaternions keep their hemispheres: a
// neighbour that turned by 179° and one by 181° are to be blended.
void find_motions_from_anchor(const CoarseFollowing& following, CoarseLevel& coarse) {
    for (Index c = 0; c < coarse.samples.sample.size(); ++c) {
        const Vec3d& before = following.coarse_anchor.displacement[c];
        const Vec3d from = coarse.system.rest.position[c] + before;
        const Mat3d beyond =
            linear_map(coarse, following.now, c) * following.from_anchor[c] - Mat3d::Identity();
        coarse.turn[c] = following.now.rotation[c] * following.coarse_anchor.rotation[c].conjugate();
        coarse.motion[c] << beyond, following.now.displacement[c] - before - beyond * from;
    }
}

// τ, which turns along with each coarse sample.
void turn_shift(const CoarseFollowing& following, CoarseLevel& coarse) {
    for (std::size_t row = 0; row < coarse.system.moving_rows; ++row) {
        const Index c = coarse.system.free_sample[row];
        coarse.system.shift[row] = following.now.rotation[c] *
                                   (following.coarse_anchor.rotation[c].conjugate() * following.shift[row]);
    }
}

} // namespace

FactorOutcome build_coarse_level(const SampleSystem& fine, CoarseLevel& coarse, Workers& workers) {
    FactorOutcome outcome =
        build_system(coarse_rest(fine.rest, coarse.samples, workers), coarse.system, workers);
    coarse.system.midway = 0; // its iteration has to be one of displacements alone, see the header
    coarse.state = rest_state(coarse.system);
    coarse.before.assign(coarse.samples.sample.size(), Vec3d::Zero());
    coarse.turn.assign(coarse.samples.sample.size(), Quatd::Identity());
    coarse.motion.resize(coarse.samples.sample.size());
    return outcome;
}

double iterate(SampleSystem& fine, CoarseLevel& coarse, std::span<const HandleMotion> handles,
               SampleState& state, Acceleration& memory, Workers& workers) {
    if (memory.alone) return iterate(fine, handles, state, memory, workers);
    inject(state, coarse, coarse.before);
    const double way = iterate(fine, handles, state, workers);
    if (memory.last_way > 0 && way > memory.last_way) {
        state = memory.uncorrected;
        memory.alone = true;
        return way;
    }
    if (memory.last_way > 0 && way > hardly_less * memory.last_way && ++memory.stalled == patience)
        memory.alone = true; // from the next one on
    memory.last_way = way;
    memory.uncorrected = state;
    find_shift(coarse, handles, state, workers);
    solve_coarse(coarse, handles, state, workers);
    find_corrections(coarse);
    carry_along(fine, coarse, state, state, workers);
    return way;
}

void anchor(SampleSystem& fine, CoarseLevel& coarse, std::span<const HandleMotion> handles,
            SampleState& state, CoarseFollowing& following, Workers& workers) {
    inject(state, coarse, coarse.before);
    iterate(fine, handles, state, workers);
    find_shift(coarse, handles, state, workers);
    following.anchor = state;
    following.shift = coarse.system.shift;
    SampleState& there = following.coarse_anchor;
    there = coarse.state; // for its turns, of which the iteration finds those that belong to I G(u)
    there.displacement = coarse.before;
    iterate(coarse.system, handles, there, workers);
    there.displacement = coarse.before;
    following.from_anchor.resize(coarse.samples.sample.size());
    for (Index c = 0; c < following.from_anchor.size(); ++c) {
        const Mat3d map = linear_map(coarse, there, c);
        const bool is_flat = !(map.determinant() > flat);
        following.from_anchor[c] = is_flat ? Mat3d(there.rotation[c].conjugate()) : Mat3d(map.inverse());
    }
    following.now = there;
    following.anchored = true;
}

double follow_coarsely(SampleSystem& fine, CoarseLevel& coarse, std::span<const HandleMotion> handles,
                       unsigned iterations, CoarseFollowing& following, SampleState& state,
                       Workers& workers) {
    require(following.anchored, "coarse samples follow from an anchor");
    turn_shift(following, coarse);
    follow_handles(coarse.system, handles, following.now, workers);
    turn_shift(following, coarse);
    const double way = iterate_coarse(coarse, handles, following.now, coarse_for_one * iterations, workers);
    find_motions_from_anchor(following, coarse);
    carry_along(fine, coarse, following.anchor, state, workers);
    place_handles(fine, handles, state);
    return way;
}

} // namespace knead
