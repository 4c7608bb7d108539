#include "edit/document.h"

#include "base/error.h"
#include "base/require.h"
#include "base/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace knead {

namespace {

// A sample that goes less far than this in an iteration, in units of the cloud's size, is at rest.
constexpr double at_rest = 1e-8;

// How far a handle may send its points: so many diagonals of the cloud, and not beyond what floats can hold.
constexpr double most_diagonals = 1e12;
constexpr double farthest = 1e30;

std::string quoted(const std::string& name) {
    return "\"" + name + "\"";
}

void refuse_absurd(const HandleMotion& motion, double diagonal, std::size_t frame, const std::string& place) {
    // Points that all lie in one place have no size to compare with.
    const double reach = diagonal > 0 ? std::min(most_diagonals * diagonal, farthest) : farthest;
    const bool sane = motion.offset.allFinite() && motion.linear.allFinite() &&
                      motion.offset.norm() < reach && motion.linear.norm() < most_diagonals &&
                      motion.linear.norm() * diagonal < reach;
    if (!sane)
        throw Error(Trouble::input, place,
                    "\"frames\": frame " + std::to_string(frame) +
                        " (from 0) sends the handle out of all range");
}

} // namespace

Document::Document(PointCloud cloud, const Settings& settings, Workers& workers, Upsampler& upsampler,
                   Mode mode)
    : mode_(mode), cloud_(std::move(cloud)), bounds_(bounds_of(cloud_)),
      pipeline_(cloud_, workers, upsampler) {
    now_.settings = settings;
}

void Document::declare(const HandleLine& line, const std::string& place) {
    refuse_while_posed("handles", place);
    auto points = std::make_shared<const std::vector<Index>>(resolve(line, place));
    State next = now_;
    std::erase_if(next.handles, [&](const Handle& handle) { return handle.name == line.name; });
    next.handles.push_back({line.name, line.role, std::move(points)});
    next.motions.assign(next.handles.size(), HandleMotion{});
    take(std::move(next));
}

void Document::drag(const DragLine& line, const std::string& place, Progress& progress) {
    const Index handle = find_handle(line.handle, place);
    if (now_.handles[handle].role != HandleRole::moving)
        throw Error(Trouble::input, place,
                    "\"handle\": " + quoted(line.handle) +
                        " is not a moving handle; declare it with \"role\":\"moving\"");
    State next = now_;
    std::vector<HandleMotion> frames;
    for (const HandlePose& pose : line.frames) {
        const Quatd& before = frames.empty() ? now_.motions[handle].rotation : frames.back().rotation;
        frames.push_back(motion_of(pose, line.pivot, cloud_.origin, before));
        refuse_absurd(frames.back(), bounds_.diagonal(), frames.size() - 1, place);
    }

    if (mode_ == Mode::rehearsal) {
        next.motions[handle] = frames.back();
        next.samples = std::make_shared<const SampleState>();
        return take(std::move(next));
    }
    prepare(progress);
    SampleState state = now_.samples ? *now_.samples : pipeline_.rest_state();
    for (std::size_t f = 0; f < frames.size(); ++f) {
        progress.step("following the handle", static_cast<double>(f) / static_cast<double>(frames.size()));
        next.motions[handle] = frames[f];
        pipeline_.follow_handles(next.motions, state);
        run_iterations(next.motions, state, next.settings.iterations, false, progress);
        upsample(next.motions, state);
        ++log_.frames;
    }
    next.samples = std::make_shared<const SampleState>(std::move(state));
    take(std::move(next));
    posed_is_now_ = true;
}

void Document::settle(const SettleLine& line, Progress& progress) {
    State next = now_;
    if (now_.samples && mode_ == Mode::real) {
        prepare(progress);
        SampleState state = *now_.samples;
        run_iterations(now_.motions, state, line.iterations, true, progress);
        upsample(now_.motions, state);
        next.samples = std::make_shared<const SampleState>(std::move(state));
    }
    take(std::move(next));
    posed_is_now_ = now_.samples != nullptr;
}

void Document::commit(Progress& progress) {
    State next = now_;
    if (now_.samples)
        next.rest =
            std::make_shared<const RestShape>(mode_ == Mode::real ? shape_now(progress) : RestShape{});
    next.samples = nullptr;
    next.motions.assign(next.handles.size(), HandleMotion{});
    take(std::move(next));
}

void Document::change_settings(const SettingsChange& change, const std::string& place) {
    if (change.neighbors) refuse_while_posed("\"neighbors\"", place);
    if (change.samples) refuse_while_posed("\"samples\"", place);
    if (change.strays) refuse_while_posed("\"strays\"", place);
    State next = now_;
    next.settings = changed(now_.settings, change);
    take(std::move(next));
}

void Document::remove(const DeleteLine& line, const std::string& place) {
    const Index handle = find_handle(line.handle, place);
    refuse_while_posed("handles", place);
    State next = now_;
    next.handles.erase(next.handles.begin() + handle);
    next.motions.assign(next.handles.size(), HandleMotion{});
    take(std::move(next));
}

void Document::rename(const RenameLine& line, const std::string& place) {
    const Index handle = find_handle(line.handle, place);
    const bool taken =
        std::ranges::any_of(now_.handles, [&](const Handle& other) { return other.name == line.to; });
    if (taken && line.to != line.handle)
        throw Error(Trouble::input, place,
                    "\"to\": there is a handle " + quoted(line.to) + " already; delete it first");
    State next = now_;
    next.handles[handle].name = line.to;
    take(std::move(next));
}

void Document::undo(const std::string& place) {
    if (past_.empty()) throw Error(Trouble::input, place, "there is nothing to undo");
    future_.push_back(std::exchange(now_, std::move(past_.back())));
    past_.pop_back();
    posed_is_now_ = false;
}

void Document::redo(const std::string& place) {
    if (future_.empty()) throw Error(Trouble::input, place, "there is nothing to redo");
    past_.push_back(std::exchange(now_, std::move(future_.back())));
    future_.pop_back();
    posed_is_now_ = false;
}

std::vector<float> Document::positions(Progress& progress) {
    std::vector<float> result = cloud_.positions;
    if (mode_ == Mode::rehearsal || (!now_.rest && !now_.samples)) return result;
    const RestShape& shape = shape_now(progress);
    const PointOrder& order = pipeline_.order();
    for (std::size_t i = 0; i < order.points(); ++i)
        std::copy_n(shape.positions.data() + 3 * i, 3, result.data() + 3 * std::size_t{order.file_index[i]});
    return result;
}

std::vector<float> Document::normals(Progress& progress) {
    std::vector<float> result = read_normals(cloud_);
    if (mode_ == Mode::rehearsal || result.empty() || (!now_.rest && !now_.samples)) return result;
    const RestShape& shape = shape_now(progress);
    const PointOrder& order = pipeline_.order();
    for (std::size_t i = 0; i < order.points(); ++i)
        std::copy_n(shape.normals.data() + 3 * i, 3, result.data() + 3 * std::size_t{order.file_index[i]});
    return result;
}

double Document::handle_error(Progress& progress) {
    if (mode_ == Mode::rehearsal || !now_.samples) return 0;
    const RestShape& posed = shape_now(progress);
    const RestShape& rest = now_.rest ? *now_.rest : pipeline_.opened();
    double largest = 0;
    for (std::size_t i = 0; i < pipeline_.order().points(); ++i) {
        const Index label = pipeline_.labels().point[i];
        if (label == no_index) continue;
        const auto at = [i](const std::vector<float>& positions) {
            return Eigen::Map<const Vec3f>(positions.data() + 3 * i).cast<double>();
        };
        const HandleMotion motion =
            label == pipeline_.labels().outside ? HandleMotion{} : now_.motions[label];
        const Vec3d target = motion.linear * at(rest.positions) + motion.offset;
        largest = std::max(largest, (at(posed.positions) - target).norm());
    }
    return bounds_.diagonal() > 0 ? largest / bounds_.diagonal() : largest;
}

Index Document::find_handle(const std::string& name, const std::string& place) const {
    for (Index h = 0; h < now_.handles.size(); ++h)
        if (now_.handles[h].name == name) return h;
    std::string words = "\"handle\": there is no handle " + quoted(name) + " here";
    if (now_.handles.empty()) throw Error(Trouble::input, place, words + "; declare one first");
    words += "; there are";
    for (const Handle& handle : now_.handles) words += " " + quoted(handle.name);
    throw Error(Trouble::input, place, words);
}

void Document::refuse_while_posed(const std::string& what, const std::string& place) const {
    if (now_.samples)
        throw Error(
            Trouble::input, place,
            what + " cannot change while handles are posed; put a {\"op\":\"commit\"} line before this one");
}

void Document::take(State next) {
    past_.push_back(std::exchange(now_, std::move(next)));
    future_.clear();
    posed_is_now_ = false;
}

void Document::prepare(Progress& progress) {
    pipeline_.prepare({now_.settings, now_.handles, now_.rest}, progress);
}

std::size_t Document::run_iterations(const std::vector<HandleMotion>& motions, SampleState& state,
                                     std::size_t count, bool until_at_rest, Progress& progress) {
    for (std::size_t done = 0; done < count; ++done) {
        progress.stop_if_cancelled();
        const Stopwatch clock;
        const double way = pipeline_.iterate(motions, state);
        log_.iteration.push_back(clock.seconds());
        if (until_at_rest && way <= at_rest * pipeline_.cloud_size()) return done + 1;
    }
    return count;
}

void Document::upsample(const std::vector<HandleMotion>& motions, const SampleState& state) {
    posed_is_now_ = false; // the caller may still be cancelled, and then keeps the state that it had
    const Stopwatch clock;
    pipeline_.upsample(motions, state);
    log_.upsample.push_back(clock.seconds());
}

// The posed shape, or the rest shape where nothing is posed. After an undo it is computed again from the
// samples.
const RestShape& Document::shape_now(Progress& progress) {
    if (!now_.samples) return now_.rest ? *now_.rest : pipeline_.opened();
    if (!posed_is_now_) {
        prepare(progress);
        pipeline_.upsample(now_.motions, *now_.samples);
        posed_is_now_ = true;
    }
    return pipeline_.posed();
}

// Regions are told on the rest shape now. A point lies where the file says plus how far it was moved, so one
// that did not move is exactly where the file says.
std::vector<Index> Document::resolve(const HandleLine& line, const std::string& place) {
    if (mode_ == Mode::rehearsal && now_.rest && std::holds_alternative<Region>(line.points)) {
        for (Index i = 0; i < cloud_.size(); ++i)
            if (is_finite(cloud_, i)) return {i};
    }
    SilentProgress silent;
    const std::vector<float> rest = now_.rest ? positions(silent) : std::vector<float>{};
    const auto at = [](const std::vector<float>& positions, std::size_t i) {
        return Eigen::Map<const Vec3f>(positions.data() + 3 * i).cast<double>();
    };
    const auto file_position = [&](std::size_t i) -> Vec3d {
        const Vec3d opened = cloud_.file_position(i);
        return rest.empty() ? opened : Vec3d(opened + (at(rest, i) - at(cloud_.positions, i)));
    };
    return resolve_points(line, cloud_, file_position, place);
}

} // namespace knead
