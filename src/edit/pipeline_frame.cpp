// What a Pipeline does in every frame, and what is told of the frame that it showed last.

#include "base/quoted.h"
#include "base/require.h"
#include "deform/least_turn.h"
#include "deform/rotation.h"
#include "edit/pipeline.h"
#include "upsample/point_rotations.h"

#include <numbers>

namespace knead {

namespace {

// [A | b] of a sample that turned (A = M - I) and moved about its rest position.
Motion motion_about(const Mat3d& beyond_identity, const Vec3d& offset) {
    Motion motion;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            motion.map[4 * row + column] = static_cast<float>(beyond_identity(row, column));
        motion.map[4 * row + 3] = static_cast<float>(offset[row]);
    }
    return motion;
}

Motion motion_of_handle(const HandleMotion& handle) {
    return motion_about(handle.linear - Mat3d::Identity(), handle.offset);
}

// The turn in a motion: the one nearest to `near` where it leaves that open, and of its hemisphere.
Quatd rotation_in(const Motion& motion, const Quatd& near) {
    using Map = Eigen::Matrix<float, 3, 4, Eigen::RowMajor>;
    const Mat3d turn = Eigen::Map<const Map>(motion.map).leftCols<3>().cast<double>();
    return nearest_rotation(Mat3d::Identity() + turn, near);
}

} // namespace

std::span<const HandleMotion> Pipeline::all_motions(const std::vector<HandleMotion>& motions) {
    require(motions.size() == slots_.slot.size(), "a motion a handle");
    handle_motions_.assign(slots_.handles.size() + 1, HandleMotion{});
    for (std::size_t h = 0; h < motions.size(); ++h) handle_motions_[slots_.slot[h]] = motions[h];
    return handle_motions_;
}

void Pipeline::follow_handles(const std::vector<HandleMotion>& motions, SampleState& state) {
    knead::follow_handles(system_, all_motions(motions), state, workers_);
}

double Pipeline::iterate(const std::vector<HandleMotion>& motions, SampleState& state,
                         Acceleration& acceleration) {
    if (has_coarse_)
        return knead::iterate(system_, coarse_, all_motions(motions), state, acceleration, workers_);
    return knead::iterate(system_, all_motions(motions), state, acceleration, workers_);
}

void Pipeline::anchor(const std::vector<HandleMotion>& motions, SampleState& state,
                      CoarseFollowing& following) {
    knead::anchor(system_, coarse_, all_motions(motions), state, following, workers_);
}

double Pipeline::follow_coarsely(const std::vector<HandleMotion>& motions, unsigned iterations,
                                 CoarseFollowing& following, SampleState& state) {
    return knead::follow_coarsely(system_, coarse_, all_motions(motions), iterations, following, state,
                                  workers_);
}

// A single place that may turn, be it of several points, has the place of its handle, and the turn of its
// surroundings.
template<typename Visit>
void Pipeline::for_lone_pegs(Visit&& visit) const {
    for (Index s = 0; s < samples_.size(); ++s) {
        const Index handle = system_.rest.handle[s];
        if (handle >= slots_.handles.size() || system_.unknown[s] == no_index) continue;
        if (holds_one_place_[handle]) visit(s, handle);
    }
}

// What moves the points, for these poses and this state.
void Pipeline::make_motions(const std::vector<HandleMotion>& motions, const SampleState& state) {
    const std::span<const HandleMotion> given_motions = all_motions(motions);
    find_maps(system_, given_motions, state, workers_);
    const bool takes_along = !every_point_ || !rest_shape().normals.empty();
    workers_.for_each(samples_.size(), 256, [&](std::size_t s) {
        const Index handle = system_.rest.handle[s];
        const bool given = handle != no_index && system_.unknown[s] == no_index;
        if (given && handle != labels_.outside) {
            motions_[s] = motion_of_handle(given_motions[handle]);
        } else {
            // Moved as its surroundings are, a sample takes what is between it and the next ones along;
            // where every point is a sample that is normals alone.
            const bool stretches = takes_along && system_.unknown[s] != no_index;
            const Mat3d moved =
                stretches ? sample_map(system_, state, static_cast<Index>(s)) : turn_of(state.rotation[s]);
            motions_[s] = motion_about(moved, state.displacement[s] - moved * system_.rest.position[s]);
        }
    });
    for (std::size_t h = 0; h < motions.size(); ++h)
        motions_[first_handle_motion_ + slots_.slot[h]] = motion_of_handle(motions[h]);
    for_lone_pegs([&](Index s, Index handle) { motions_[first_handle_motion_ + handle] = motions_[s]; });
    const std::size_t first_carried = motions_.size() - carried_.size();
    workers_.for_each(carried_.size(), 16, [&](std::size_t part) {
        motions_[first_carried + part] = carried_motion(carried_, part, motions_);
    });
}

std::shared_ptr<const DeviceFrame> Pipeline::frame(const std::vector<HandleMotion>& motions,
                                                   const SampleState& state) {
    make_motions(motions, state);
    return upsampler_.frame(motions_);
}

void Pipeline::upsample(const std::vector<HandleMotion>& motions, const SampleState& state) {
    make_motions(motions, state);
    ++upsampled_;
    const auto [posed, was_written] = posed_.next(workers_);
    for (const Index block : upsampler_.run(motions_, posed.positions, posed.normals,
                                            was_written ? Held::last_frame : Held::nothing))
        written_[block] = upsampled_;
    for_lone_pegs([&, &to = posed](Index s, Index /*handle*/) { put_exactly(s, state.displacement[s], to); });
}

// A turn about a point is A p + b in floats, where A p and b cancel but for their rounding: a peg that is
// held keeps its bytes all the same. In a block that was not written it is there already.
void Pipeline::put_exactly(Index sample, const Vec3d& displacement, RestShape& posed) {
    const RestShape& rest = rest_shape();
    const Index vertex = samples_[sample];
    for (Index point = order_.first_point[vertex]; point < order_.first_point[vertex + 1]; ++point) {
        const Index held_by = labels_.point[point];
        if (held_by != no_index && held_by != labels_.vertex[vertex])
            continue; // another's, in the same place
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t at = 3 * std::size_t{point} + axis;
            const double way = displacement[static_cast<Eigen::Index>(axis)];
            const float there =
                way == 0 ? rest.positions[at] : static_cast<float>(double{rest.positions[at]} + way);
            if (posed.positions[at] == there) continue;
            posed.positions[at] = there;
            written_[point / points_in_block] = upsampled_;
        }
    }
}

// Of handles that turned by more than what one cannot tell from the other way round.
std::vector<LostTurn> Pipeline::lost_turns(const std::vector<HandleMotion>& motions,
                                           const SampleState& state) const {
    constexpr double degree = std::numbers::pi / 180, least_asked = 300, least_lost = 180;
    std::vector<LostTurn> lost;
    std::vector<WayEnd> ends(samples_.size());
    for (std::size_t handle = 0; handle < motions.size(); ++handle) {
        const double asked = motions[handle].turned.cwiseAbs().maxCoeff() / degree;
        if (asked < least_asked) continue;
        for (std::size_t s = 0; s < samples_.size(); ++s) {
            const Index label = system_.rest.handle[s];
            const bool stays = label != no_index &&
                               (label == labels_.outside || slots_.handles[label].role == HandleRole::fixed);
            ends[s] = stays ? WayEnd::from : handle_of(label) == handle ? WayEnd::to : WayEnd::neither;
        }
        const std::optional<double> kept = least_turn(system_, state, ends);
        if (kept && *kept / degree < asked - least_lost)
            lost.push_back({quoted(input_.handles[handle].name), asked, *kept / degree});
    }
    return lost;
}

HandleDemand Pipeline::demand(const std::vector<HandleMotion>& motions, const SampleState& state) const {
    const RestShape& rest = rest_shape();
    const Parting parting =
        parting_of(*graph_, labels_, standing_points(), rest.positions, posed().positions);
    HandleDemand demand{
        strain_of(system_, state), parting.factor, {}, {}, rounding_of(posed().positions, cloud_size_),
        lost_turns(motions, state)};
    const auto name_of = [&](Index label) {
        const Index handle = handle_of(label);
        return handle < input_.handles.size() ? quoted(input_.handles[handle].name)
                                              : std::string("what lies outside the region");
    };
    if (parting.one != no_index) demand.one = name_of(parting.one), demand.other = name_of(parting.other);
    return demand;
}

std::vector<float> Pipeline::rotations(const std::vector<HandleMotion>& motions,
                                       const SampleState& state) const {
    require(motions.size() == slots_.slot.size() && state.rotation.size() == samples_.size(),
            "a motion a handle, and a turn a sample");
    std::vector<Quatd> turns(motions_.size(), Quatd::Identity());
    for (std::size_t s = 0; s < samples_.size(); ++s) {
        const Index handle = handle_of(system_.rest.handle[s]);
        const bool given = handle < motions.size() && system_.unknown[s] == no_index;
        turns[s] = given ? motions[handle].rotation : rotation_in(motions_[s], state.rotation[s]);
    }
    for (std::size_t h = 0; h < motions.size(); ++h)
        turns[first_handle_motion_ + slots_.slot[h]] = motions[h].rotation;
    for_lone_pegs([&](Index s, Index handle) { turns[first_handle_motion_ + handle] = turns[s]; });
    for (std::size_t carried = turns.size() - carried_.size(); carried < turns.size(); ++carried)
        turns[carried] = rotation_in(motions_[carried], Quatd::Identity());
    const std::span<const float> before = input_.rest ? input_.rest->rotations : std::span<const float>{};
    return point_rotations(upsample_input(), turns, before, workers_);
}

} // namespace knead
