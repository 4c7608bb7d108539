// The per-frame half of sample_system.h.

#include "base/prefetch.h"
#include "deform/rotation.h"
#include "deform/sample_system.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace knead {

namespace {

// Rows that one worker takes at once: of few the fewer, so that all workers are done at the same time.
std::size_t grain_of(std::size_t rows) {
    return std::clamp<std::size_t>(rows / 16, 16, 256);
}

// q - 1 as a vector w x y z: what the systems are solved for.
Eigen::Vector4d beyond_one(const Quatd& q) {
    return {q.w() - 1, q.x(), q.y(), q.z()};
}

// A - R of a handle.
Mat3d growth_of(const HandleMotion& motion) {
    return motion.linear - motion.rotation.toRotationMatrix();
}

// How far p is sent by a handle.
Vec3d sent(const HandleMotion& motion, const Vec3d& p) {
    return (motion.linear - Mat3d::Identity()) * p + motion.offset;
}

// Near samples have near numbers, but in no order, so what a row needs of its neighbours lies on some hundred
// lines of memory, and with very many samples not in the nearest cache. Asks for it some rows before, and for
// who they are some rows before that.
constexpr std::size_t soon = 3;
[[gnu::always_inline]] inline void look_ahead(const SampleSystem& system, const SampleState& state,
                                              std::size_t row) {
    const Graph& graph = system.rest.graph;
    if (row + 3 * soon < system.free_sample.size())
        prefetch(&graph.first[system.free_sample[row + 3 * soon]]);
    if (row + 2 * soon < system.free_sample.size())
        prefetch(graph.neighbor.data() + graph.first[system.free_sample[row + 2 * soon]]);
    if (row + soon >= system.free_sample.size()) return;
    const Index i = system.free_sample[row + soon];
    prefetch(&system.turn[i]);
    prefetch(&state.rotation[i]);
    for (const Index j : graph.row(i)) {
        prefetch(&system.turn[j]);
        prefetch(&state.displacement[j]);
        prefetch(&system.rest.position[j]);
    }
}

// Adds to the right-hand side of a row what `given(sample)` of the handles around it says, times `smoothing`.
// `coefficient`: of the matrix that it is for; null: that is of links alone.
template<typename Given>
[[gnu::always_inline]] inline void add_given(SampleSystem& system, std::size_t row, double smoothing,
                                             double BodyPair::*coefficient, Given&& given) {
    const SampleRest& rest = system.rest;
    const Index i = system.free_sample[row];
    Eigen::Map<Eigen::Vector4d> side(system.sides.data() + 4 * row);
    for (Index link = rest.graph.first[i]; link < rest.graph.first[i + 1]; ++link) {
        const Index j = rest.graph.neighbor[link];
        if (system.unknown[j] == no_index) side += smoothing * rest.weight[link] * beyond_one(given(j));
    }
    const PointEnergy& energy = rest.energy;
    if (!coefficient || energy.first.empty()) return;
    for (Index at = energy.first[i]; at < energy.first[i + 1]; ++at) {
        const Index s = energy.body[at];
        if (!system.body[s].turned) continue;
        const Index sample = s < energy.samples ? s : system.body[s].from;
        if (sample != no_index) side -= smoothing * energy.pair[at].*coefficient * beyond_one(given(sample));
    }
}

// And what handles that pull say, in the same words as their samples do.
template<typename Given>
void add_pulled_turns(SampleSystem& system, double smoothing, Given&& given) {
    for (const SoftHold& hold : system.rest.pulled)
        if (const Index sample = turns_with(system, hold); sample != no_index)
            Eigen::Map<Eigen::Vector4d>(system.sides.data() + 4 * std::size_t{system.unknown[hold.sample]}) +=
                smoothing * hold.weight * beyond_one(given(sample));
}

// The right-hand side, four numbers a row: what own(begin, end) writes for these rows of the samples
// themselves, and what add_given() and add_pulled_turns() do.
template<typename Own, typename Given>
void assemble_rotations(SampleSystem& system, double smoothing, double BodyPair::*coefficient, Own&& own,
                        Given&& given, Workers& workers) {
    const std::size_t rows = system.free_sample.size();
    workers.for_chunks(rows, grain_of(rows), [&](std::size_t begin, std::size_t end) {
        own(begin, end);
        for (std::size_t row = begin; row < end; ++row) add_given(system, row, smoothing, coefficient, given);
    });
    add_pulled_turns(system, smoothing, given);
}

// Calls take(sample, quaternion) with the solution, normalised, where it did not vanish.
template<typename Take>
void for_solved_rotations(const SampleSystem& system, Take&& take, Workers& workers) {
    const std::size_t rows = system.free_sample.size();
    workers.for_each(rows, grain_of(rows), [&](std::size_t row) {
        const double* side = system.sides.data() + 4 * row;
        Quatd solved(1 + side[0], side[1], side[2], side[3]);
        const double length = solved.norm();
        if (!(length > 1e-6)) return;
        solved.coeffs() /= length;
        take(system.free_sample[row], solved);
    });
}

// Equation (1) for how far the handles turned since the last frame: harmonic increments between them, on top
// of the turns that the samples have already made.
void turn_with_handles(SampleSystem& system, std::span<const HandleMotion> handles, SampleState& state,
                       Workers& workers) {
    const auto increment = [&](Index s) -> Quatd {
        const Index handle = system.rest.handle[s];
        // Of a part without handles, and of a handle that does not say how it turns.
        if (handle == no_index || system.unknown[s] != no_index) return Quatd::Identity();
        return handles[handle].rotation * state.rotation[s].conjugate();
    };
    assemble_rotations(
        system, 1.0, hinges(system) ? nullptr : &BodyPair::way,
        [&](std::size_t begin, std::size_t end) {
            std::fill(system.sides.data() + 4 * begin, system.sides.data() + 4 * end, 0.0);
        },
        increment, workers);
    (system.has_increments ? system.increments : system.positions).solve(system.sides, 4, workers);
    for_solved_rotations(
        system,
        [&](Index s, const Quatd& turn) { state.rotation[s] = (turn * state.rotation[s]).normalized(); },
        workers);
}

// Σ w (u_j - u_i) e_ijᵀ of a row.
Mat3d displaced_spread(const SampleSystem& system, const SampleState& state, std::size_t row) {
    const Graph& graph = system.rest.graph;
    const Index i = system.free_sample[row];
    const Vec3d own = state.displacement[i];
    Mat3d displaced = Mat3d::Zero();
    for (Index link = graph.first[i]; link < graph.first[i + 1]; ++link)
        displaced +=
            (state.displacement[graph.neighbor[link]] - own) * system.weighted_edge[link].transpose();
    return displaced;
}

// The sum of step 1 with γ = 0: of the edges as they are. With x = p + u that is what they are at rest, and
// what displacements add; where nothing moved, that is nothing at all.
Mat3d sum_of_edges(const SampleSystem& system, const SampleState& state, std::size_t row) {
    return system.spread[row] + displaced_spread(system, state, row);
}

// What the points around a sample, a body, add to step 1.
Mat3d points_around(const SampleSystem& system, const SampleState& state, Index i) {
    const Mat3d& spread = system.rest.energy.spread[i];
    return spread + (turn_of(state.rotation[i]) - (1 - system.midway) * system.turn[i]) * spread +
           local_sum_of(bodies_around(system.rest.energy, system.body, i), system.midway);
}

// What the scaling of a handle adds to M of a link to a sample of it, times what it is of the link.
Vec3d grown(const SampleSystem& system, Index link, Index sample, const Vec3d& edge) {
    const Index handle = system.rest.handle[sample];
    if (system.unknown[sample] != no_index || handle == no_index) return Vec3d::Zero();
    return double{system.rest.held_part[link]} * (system.growth[handle] * edge);
}

// The sum of step 1. What is the sample's own in it, R_i e - (1 - γ/2) M_i e, is one product with Σ w e eᵀ.
Mat3d local_sum(const SampleSystem& system, const SampleState& state, std::size_t row) {
    const Graph& graph = system.rest.graph;
    const Index i = system.free_sample[row];
    const Vec3d& displacement = state.displacement[i];
    const Vec3d& position = system.rest.position[i];
    const double of_other = 0.5 * system.midway;
    const Mat3d own = turn_of(state.rotation[i]) - (1 - of_other) * system.turn[i];
    Mat3d sum = system.spread[row] + own * system.spread[row];
    for (Index link = graph.first[i]; link < graph.first[i + 1]; ++link) {
        const Index j = graph.neighbor[link];
        const Vec3d edge = system.rest.position[j] - position;
        Vec3d turned = of_other * (system.turn[j] * edge);
        if (system.grows) turned += of_other * grown(system, link, j, edge);
        sum += (state.displacement[j] - displacement - turned) * system.weighted_edge[link].transpose();
    }
    if (!system.rest.energy.first.empty()) sum += points_around(system, state, i);
    return sum;
}

// Step 1 of these rows, into the right-hand sides of step 2: C (r* - 1). Some at once, as side by side they
// take half the time.
void find_local_rotations(SampleSystem& system, const SampleState& state, std::size_t begin,
                          std::size_t end) {
    constexpr std::size_t at_once = 16;
    std::array<Mat3d, at_once> sum;
    std::array<Quatd, at_once> local;
    for (std::size_t first = begin; first < end; first += at_once) {
        const std::size_t count = std::min(at_once, end - first);
        for (std::size_t k = 0; k < count; ++k) {
            look_ahead(system, state, first + k);
            sum[k] = system.midway > 0 ? local_sum(system, state, first + k)
                                       : sum_of_edges(system, state, first + k);
            local[k] = state.rotation[system.free_sample[first + k]];
        }
        nearest_rotations(std::span(sum).first(count), std::span(local).first(count));
        for (std::size_t k = 0; k < count; ++k)
            Eigen::Map<Eigen::Vector4d>(system.sides.data() + 4 * (first + k)) =
                system.confidence[first + k] * beyond_one(local[k]);
    }
}

// How the links of a sample were moved.
struct LinkMotion {
    Mat3d turn;     // r* - I
    Mat3d gradient; // F - I
};

// Of these rows: calls take(row, motion). Some at once, as in find_local_rotations().
template<typename Take>
void for_link_motions(const SampleSystem& system, const SampleState& state, std::size_t begin,
                      std::size_t end, Take&& take) {
    constexpr std::size_t at_once = 16;
    std::array<Mat3d, at_once> displaced, sum;
    std::array<Quatd, at_once> local;
    for (std::size_t first = begin; first < end; first += at_once) {
        const std::size_t count = std::min(at_once, end - first);
        for (std::size_t k = 0; k < count; ++k) {
            displaced[k] = displaced_spread(system, state, first + k);
            sum[k] = system.spread[first + k] + displaced[k];
            local[k] = state.rotation[system.free_sample[first + k]];
        }
        nearest_rotations(std::span(sum).first(count), std::span(local).first(count));
        for (std::size_t k = 0; k < count; ++k) {
            const Mat3d turn = turn_of(local[k]);
            take(first + k,
                 LinkMotion{turn, gradient_of(system.surroundings[first + k], displaced[k], turn)});
        }
    }
}

// Whether S is by what pulls, links and points together; else by links.
bool has_targets_of_points(const SampleSystem& system) {
    return !system.with_points.empty() && system.rest.poisson > 0;
}

// S of every row by its links.
void find_targets_of_links(SampleSystem& system, const SampleState& state, Workers& workers) {
    const std::size_t rows = system.target.size();
    workers.for_chunks(rows, grain_of(rows), [&](std::size_t begin, std::size_t end) {
        for_link_motions(system, state, begin, end, [&](std::size_t row, const LinkMotion& moved) {
            system.target[row] =
                elastic_target(system.surroundings[row], moved.gradient, system.rest.poisson);
        });
    });
}

// M - I of the samples that turn by themselves: R S - I.
void find_turns(SampleSystem& system, const SampleState& state, Workers& workers) {
    const std::size_t rows = system.free_sample.size();
    workers.for_each(rows, grain_of(rows), [&](std::size_t row) {
        const Index i = system.free_sample[row];
        system.turn[i] = turn_of(state.rotation[i]);
        if (!system.target.empty()) system.turn[i] += state.rotation[i] * system.target[row];
    });
}

// A - I of a sample that turns by itself.
Mat3d stretched_turn(const SampleSystem& system, const SampleState& state, std::size_t s) {
    return turn_of(state.rotation[s]) + state.rotation[s] * system.stretch[system.unknown[s]];
}

// A - I of a sample that does not: of its handle, if it has one.
Mat3d map_of_handle(const SampleSystem& system, std::span<const HandleMotion> handles, std::size_t s) {
    const Index handle = system.rest.handle[s];
    if (handle == no_index) return Mat3d::Zero();
    return handles[handle].linear - Mat3d::Identity();
}

// S of every row by its links and points.
void find_targets_of_points(SampleSystem& system, const SampleState& state, Workers& workers) {
    const std::size_t rows = system.free_sample.size();
    workers.for_each(rows, grain_of(rows), [&](std::size_t row) {
        const Index i = system.free_sample[row];
        const Mat3d displaced = displaced_spread(system, state, row) +
                                local_sum_of(bodies_around(system.rest.energy, system.body, i), 0);
        // The sample's own rotation for r*: with points S is what it was.
        const Mat3d gradient = gradient_of(system.with_points[row], displaced, turn_of(state.rotation[i]));
        system.target[row] = elastic_target(system.with_points[row], gradient, system.rest.poisson);
    });
}

// How the samples of each handle that leaves rotation free turned, all together.
void find_free_turns(SampleSystem& system, const SampleState& state) {
    for (Quatd& turn : system.free_turn) turn.coeffs().setZero();
    for (std::size_t row = system.moving_rows; row < system.free_sample.size(); ++row) {
        const Index s = system.free_sample[row];
        system.free_turn[system.rest.handle[s]].coeffs() += state.rotation[s].coeffs();
    }
    for (Quatd& turn : system.free_turn) {
        const double length = turn.coeffs().norm();
        if (length > 1e-6)
            turn.coeffs() /= length;
        else
            turn.setIdentity();
    }
}

// What all bodies do, where points have an energy. A handle that leaves rotation free takes points along as
// it lies, and wants them turned as its samples are.
void find_bodies(SampleSystem& system, std::span<const HandleMotion> handles, const SampleState& state,
                 Workers& workers) {
    const std::size_t samples = system.rest.energy.samples;
    workers.for_each(system.body.size(), grain_of(system.body.size()), [&](std::size_t s) {
        Body& body = system.body[s];
        if (s < samples) {
            const Mat3d& turn = system.turn[s];
            set_four(state.displacement[s], body.way);
            set_columns(turn, body.turn);
            set_columns(body.turned ? map_of_handle(system, handles, s) : stretched_turn(system, state, s),
                        body.map);
        } else if (s < samples + system.rest.energy.handles()) {
            const auto handle = static_cast<Index>(s - samples);
            set_four(handles[handle].offset, body.way);
            set_columns(handles[handle].linear - Mat3d::Identity(), body.map);
            const bool free = is_set(system.rest.turns_freely, handle);
            set_columns(turn_of(free ? system.free_turn[handle] : handles[handle].rotation), body.turn);
        } else {
            set_columns(growth_of(handles[s - samples - system.rest.energy.handles()]), body.turn);
        }
    });
}

// A⁰: what maps are before they are fitted.
void start_maps(SampleSystem& system, const SampleState& state, Workers& workers) {
    const double of_points = system.rest.energy.share, of_links = 1 - of_points;
    const std::size_t rows = system.stretch.size();
    workers.for_chunks(rows, grain_of(rows), [&](std::size_t begin, std::size_t end) {
        for_link_motions(system, state, begin, end, [&](std::size_t row, const LinkMotion& moved) {
            Mat3d map = of_links * moved.gradient + of_points * moved.turn; // A⁰ - I
            if (!system.target.empty())
                map += of_points * (moved.turn * system.target[row] + system.target[row]);
            const Quatd back = state.rotation[system.free_sample[row]].conjugate();
            system.stretch[row] = turn_of(back) + back * map;
        });
    });
}

// How the material answers the shape as it is, by links, and how samples send the points around them, then.
void find_first_answers(SampleSystem& system, std::span<const HandleMotion> handles, const SampleState& state,
                        Workers& workers) {
    find_targets_of_links(system, state, workers);
    find_turns(system, state, workers);
    if (system.stretch.empty()) return;
    start_maps(system, state, workers);
    find_bodies(system, handles, state, workers);
    fit_maps(system, state, workers);
}

// How the material answers, and what all bodies do.
void find_answers(SampleSystem& system, std::span<const HandleMotion> handles, const SampleState& state,
                  Workers& workers) {
    find_first_answers(system, handles, state, workers);
    if (has_targets_of_points(system)) {
        find_bodies(system, handles, state, workers); // whose maps and ways alone count for this
        find_targets_of_points(system, state, workers);
        find_turns(system, state, workers);
    }
    find_bodies(system, handles, state, workers);
}

// How beds lie, with the handles' samples where they are by now. Of anchors that are none of these the way
// is told by what the handle does between them.
void find_bed_turns(SampleSystem& system, std::span<const HandleMotion> handles, const SampleState& state) {
    const SampleRest& rest = system.rest;
    for (Bed& bed : system.beds) bed.sum.setZero();
    for (const SoftHold& hold : rest.pulled) {
        if (hold.bed == no_index) continue;
        const Vec3d from_turner = hold.anchor - rest.position[hold.turner];
        const Vec3d anchor_way =
            state.displacement[hold.turner] + (handles[hold.handle].linear - Mat3d::Identity()) * from_turner;
        const Vec3d edge = rest.position[hold.sample] - hold.anchor;
        const Vec3d moved = edge + state.displacement[hold.sample] - anchor_way;
        system.beds[hold.bed].sum += hold.weight * moved * edge.transpose();
    }
    for (BedPart& part : system.bed_parts) {
        const Bed& bed = system.beds[part.bed];
        const Quatd& turner = state.rotation[part.turner];
        const double as_turner = part.own + part.as_turner * bed.spread;
        const Mat3d sum = (1 - part.as_turner) * bed.sum + as_turner * turner.toRotationMatrix();
        part.turn = turn_of(nearest_rotation(sum, turner));
    }
}

// What handles with a falloff add to the right-hand sides.
void add_pulls(SampleSystem& system, std::span<const HandleMotion> handles) {
    for (std::size_t k = 0; k < system.rest.pulled.size(); ++k) {
        const SoftHold& hold = system.rest.pulled[k];
        Vec3d way = sent(handles[hold.handle], hold.anchor);
        if (const Index part = system.bed_part[k]; part != no_index)
            way += system.bed_parts[part].turn * (system.rest.position[hold.sample] - hold.anchor);
        Eigen::Map<Vec3d>(system.sides.data() + 3 * system.unknown[hold.sample]) += hold.weight * way;
    }
}

// Step 3. Returns the longest way that a sample went.
double solve_positions(SampleSystem& system, std::span<const HandleMotion> handles, SampleState& state,
                       Workers& workers) {
    const SampleRest& rest = system.rest;
    const std::size_t rows = system.moving_rows;
    find_turns(system, state, workers);
    find_free_turns(system, state);
    find_bodies(system, handles, state, workers);
    workers.for_each(rows, grain_of(rows), [&](std::size_t row) {
        look_ahead(system, state, row);
        const Index i = system.free_sample[row];
        Vec3d given = Vec3d::Zero(); // by handles: Σ w u_j; and by bodies
        Vec3d edges = Vec3d::Zero(); // Σ w e
        Vec3d turned = Vec3d::Zero();
        for (Index link = rest.graph.first[i]; link < rest.graph.first[i + 1]; ++link) {
            const Index j = rest.graph.neighbor[link];
            edges += system.weighted_edge[link];
            turned += system.turn[j] * system.weighted_edge[link];
            if (system.grows) turned += grown(system, link, j, system.weighted_edge[link]);
            if (!(system.unknown[j] < rows)) given += rest.weight[link] * state.displacement[j];
        }
        turned += system.turn[i] * edges;
        if (!rest.energy.first.empty()) given += force_of(bodies_around(rest.energy, system.body, i));
        Eigen::Map<Vec3d>(system.sides.data() + 3 * row) = given - 0.5 * turned; // p_i - p_j = -e
    });
    add_pulls(system, handles);
    system.positions.solve({system.sides.data(), 3 * rows}, 3, workers);

    double longest = 0;
    for (std::size_t row = 0; row < rows; ++row) {
        Vec3d solved = Eigen::Map<const Vec3d>(system.sides.data() + 3 * row);
        if (!system.shift.empty()) solved += system.shift[row];
        Vec3d& displacement = state.displacement[system.free_sample[row]];
        longest = std::max(longest, (solved - displacement).squaredNorm());
        displacement = solved;
    }
    return std::sqrt(longest);
}

} // namespace

void place_handles(SampleSystem& system, std::span<const HandleMotion> handles, SampleState& state) {
    constexpr double rounding = 1e-12;
    system.grows = false;
    for (std::size_t h = 0; h < system.growth.size(); ++h) {
        system.growth[h] = 2 * growth_of(handles[h]);
        system.grows |= system.growth[h].norm() > rounding;
    }
    for (std::size_t s = 0; s < system.rest.handle.size(); ++s) {
        if (system.rest.handle[s] == no_index) continue;
        const HandleMotion& motion = handles[system.rest.handle[s]];
        state.displacement[s] = sent(motion, system.rest.position[s]);
        if (system.unknown[s] != no_index) continue; // it turns as its surroundings want
        state.rotation[s] = motion.rotation;
        system.turn[s] = turn_of(motion.rotation);
    }
    if (!system.stretch.empty()) state.handles.assign(handles.begin(), handles.end());
}

void follow_handles(SampleSystem& system, std::span<const HandleMotion> handles, SampleState& state,
                    Workers& workers) {
    // How the material answers, and the maps, before the handles leave the others behind.
    if (state.handles.empty()) {
        find_targets_of_links(system, state, workers);
        start_maps(system, state, workers);
    } else {
        find_maps(system, state.handles, state, workers);
    }
    turn_with_handles(system, handles, state, workers);
    find_bed_turns(system, handles, state); // before handles go on, and all that they pull does
    place_handles(system, handles, state);
    solve_positions(system, handles, state, workers);
}

void find_maps(SampleSystem& system, std::span<const HandleMotion> handles, const SampleState& state,
               Workers& workers) {
    if (system.stretch.empty()) return;
    for (std::size_t s = 0; s < system.turn.size(); ++s)
        if (system.unknown[s] == no_index && system.rest.handle[s] != no_index)
            system.turn[s] = turn_of(handles[system.rest.handle[s]].rotation);
    find_free_turns(system, state);
    find_first_answers(system, handles, state, workers);
}

Mat3d sample_map(const SampleSystem& system, const SampleState& state, Index i) {
    return system.stretch.empty() ? sample_gradient(system, state, i) : stretched_turn(system, state, i);
}

Mat3d sample_gradient(const SampleSystem& system, const SampleState& state, Index i) {
    Mat3d gradient;
    const std::size_t row = system.unknown[i];
    for_link_motions(system, state, row, row + 1,
                     [&](std::size_t, const LinkMotion& moved) { gradient = moved.gradient; });
    return gradient;
}

double iterate(SampleSystem& system, std::span<const HandleMotion> handles, SampleState& state,
               Workers& workers) {
    place_handles(system, handles, state);
    find_free_turns(system, state);
    // Of the state alone, whatever was computed before: what is undone and done again has the same bits.
    if (system.midway > 0) find_answers(system, handles, state, workers);
    const auto given = [&](Index s) -> const Quatd& {
        return system.unknown[s] == no_index ? state.rotation[s] : system.free_turn[system.rest.handle[s]];
    };
    assemble_rotations(
        system, system.smoothing, &BodyPair::turn,
        [&](std::size_t begin, std::size_t end) { find_local_rotations(system, state, begin, end); }, given,
        workers);
    system.rotations.solve(system.sides, 4, workers);
    for_solved_rotations(
        system, [&](Index s, const Quatd& rotation) { state.rotation[s] = rotation; }, workers);
    if (system.midway == 0) find_answers(system, handles, state, workers);
    find_bed_turns(system, handles, state);
    return solve_positions(system, handles, state, workers);
}

} // namespace knead
