#include "edit/document.h"

#include "base/error.h"
#include "base/quoted.h"
#include "base/stopwatch.h"
#include "cloud/splats.h"
#include "edit/document_pivots.h"
#include "edit/handle_motion.h"

#include <algorithm>
#include <utility>

namespace knead {

namespace {

// In a rehearsal nobody knows which points a region is after a commit. One point, twice, stands for them: no
// list of points has any twice.
std::vector<Index> unknown_points(Index any) {
    return {any, any};
}
bool is_unknown(const std::vector<Index>& points) {
    return points.size() == 2 && points[0] == points[1];
}

} // namespace

Document::Document(PointCloud cloud, const Settings& settings, Workers& workers, Upsampler& upsampler,
                   Mode mode)
    : mode_(mode), cloud_(std::move(cloud)), bounds_(bounds_of(cloud_)),
      holds_splats_(find_splats(cloud_).has_value()), workers_(workers),
      pipeline_(cloud_, workers, upsampler) {
    history_.emplace_back().settings = settings;
}

bool Document::needs_commit(const SessionAction& act) const {
    if (!is_posed()) return false;
    if (const auto* set = std::get_if<SetLine>(&act))
        return set->change.neighbors || set->change.samples || set->change.strays;
    if (const auto* line = std::get_if<HandleLine>(&act)) return !retouched_by(*line, "");
    const auto* gone = std::get_if<DeleteLine>(&act);
    return gone && handle_named(handles_, gone->handle);
}

void Document::declare(const HandleLine& line, const std::string& place) {
    if (const auto handle = retouched_by(line, place)) { // which is no other handle
        const HandleChange::Place old{*handle, handles_[*handle]};
        HandleChange change{.gone = old, .come = old};
        change.come->handle.color = line.color;
        return change_handles(std::move(change), with_pivot(now().pivots, line.name, line.pivot));
    }
    refuse_while_posed("handles", place);
    auto points = std::make_shared<const std::vector<Index>>(resolve(line, place));
    HandleChange change;
    if (const auto old = number_of(handles_, line.name))
        change.gone = {static_cast<Index>(*old), handles_[*old]};
    Index came = 0;
    for (const Handle& handle : handles_) came = std::max(came, handle.came + 1);
    change.come = {static_cast<Index>(handles_.size() - (change.gone ? 1 : 0)),
                   {line.name, line.role, std::move(points), line.free_rotation, line.falloff, line.color,
                    change.gone ? change.gone->handle.came : came}};
    change_handles(std::move(change), with_pivot(now().pivots, line.name, line.pivot));
}

void Document::commit(Progress& progress) {
    State next = next_state();
    if (is_posed()) {
        next.rest = std::make_shared<Committed>();
        next.rest->shape = mode_ == Mode::real ? posed_now(progress) : std::make_shared<const RestShape>();
        next.rest->made_from = at_;
        next.pivots = carried(next.pivots, handles_, motions_, cloud_.origin);
    }
    const auto committed = is_posed() ? next.rest : nullptr;
    next.posed = nullptr;
    take(std::move(next));
    if (committed) keep(committed);
}

void Document::change_settings(const SettingsChange& change, const std::string& place) {
    if (change.neighbors) refuse_while_posed("\"neighbors\"", place);
    if (change.samples) refuse_while_posed("\"samples\"", place);
    if (change.strays) refuse_while_posed("\"strays\"", place);
    State next = next_state();
    next.settings = changed(now().settings, change);
    take(std::move(next));
}

void Document::remove(const DeleteLine& line, const std::string& place) {
    const Index handle = find_handle(line.handle, place);
    refuse_while_posed("handles", place);
    change_handles({.gone = HandleChange::Place{handle, handles_[handle]}, .come = {}},
                   with_pivot(now().pivots, line.handle, std::nullopt));
}

void Document::rename(const RenameLine& line, const std::string& place) {
    const Index handle = find_handle(line.handle, place);
    const bool taken =
        std::ranges::any_of(handles_, [&](const Handle& other) { return other.name == line.to; });
    if (taken && line.to != line.handle)
        throw Error(Trouble::input, place,
                    "\"to\": there is a handle " + quoted(line.to) + " already; delete it first");
    const HandleChange::Place old{handle, handles_[handle]};
    HandleChange change{.gone = old, .come = old};
    change.come->handle.name = line.to;
    const auto without = with_pivot(now().pivots, line.handle, std::nullopt);
    change_handles(std::move(change), with_pivot(without, line.to, old.handle.pivot));
}

std::vector<float> Document::positions(Progress& progress) {
    std::vector<float> result = cloud_.positions;
    if (mode_ == Mode::rehearsal || is_as_opened()) return result;
    const RestShape& now = shown(progress);
    scatter(pipeline_.order(), now.positions, 3, result, workers_);
    return result;
}

std::vector<float> Document::normals(Progress& progress) {
    std::vector<float> result = read_normals(cloud_);
    if (mode_ == Mode::rehearsal || result.empty() || is_as_opened()) return result;
    const RestShape& now = shown(progress);
    scatter(pipeline_.order(), now.normals, 3, result, workers_);
    return result;
}

std::vector<float> Document::rotations(Progress& progress) {
    if (mode_ == Mode::rehearsal || !holds_splats_ || is_as_opened()) return {};
    std::vector<float> posed;
    std::shared_ptr<const RestShape> rest;
    if (under_way_) {
        (void)shown(progress); // of which the pipeline tells them
        posed = pipeline_.rotations(under_way_->motions, under_way_->samples);
    } else if (is_posed()) {
        const auto samples = samples_of(now(), progress);
        shape(progress);
        posed = pipeline_.rotations(motions_, *samples);
    } else {
        rest = rest_of(now(), progress);
    }
    const std::vector<float>& ordered = rest ? rest->rotations : posed;
    std::vector<float> result(4 * cloud_.size(), 0.0F);
    for (std::size_t i = 0; i < cloud_.size(); ++i) result[4 * i] = 1;
    scatter(pipeline_.order(), ordered, 4, result, workers_);
    return result;
}

double Document::handle_error(Progress& progress) {
    if (mode_ == Mode::rehearsal || !is_posed()) return 0;
    const RestShape& posed = shape(progress);
    const std::shared_ptr<const RestShape> committed = rest_of(now(), progress);
    const RestShape& rest = committed ? *committed : pipeline_.opened();
    double largest = 0;
    for (std::size_t i = 0; i < pipeline_.order().points(); ++i) {
        const Index label = pipeline_.labels().point[i];
        if (label == no_index) continue;
        const Index handle = pipeline_.handle_of(label);
        const HandleMotion motion = handle < motions_.size() ? motions_[handle] : HandleMotion{};
        const Vec3d target = moved_point(motion, point_at(rest.positions, i));
        largest = std::max(largest, (point_at(posed.positions, i) - target).norm());
    }
    return bounds_.diagonal() > 0 ? largest / bounds_.diagonal() : largest;
}

HandleDemand Document::demand(Progress& progress) {
    if (mode_ == Mode::rehearsal || !is_posed()) return {};
    shape(progress); // the pipeline is prepared for this state
    return pipeline_.demand(motions_, *samples_of(now(), progress));
}

Index Document::find_handle(const std::string& name, const std::string& place, const char* key) const {
    if (const auto handle = number_of(handles_, name)) return static_cast<Index>(*handle);
    std::string words = quoted(key) + ": there is no handle " + quoted(name) + " here";
    if (handles_.empty()) throw Error(Trouble::input, place, words + "; declare one first");
    words += "; there are";
    for (const Handle& handle : handles_) words += " " + quoted(handle.name);
    throw Error(Trouble::input, place, words);
}

// Only points that are named: those of a region depend on the shape.
std::optional<Index> Document::held_as_in(const HandleLine& line, const std::string& place) const {
    const auto number = number_of(handles_, line.name);
    if (!number || std::holds_alternative<Region>(line.points)) return std::nullopt;
    const Handle* const old = &handles_[*number];
    const bool holds_alike =
        old->role == line.role && old->free_rotation == line.free_rotation && old->falloff == line.falloff;
    if (!holds_alike) return std::nullopt;
    const std::vector<Index> points = resolve_points(line, cloud_, nullptr, place);
    if (*old->points != points && !is_unknown(*old->points)) return std::nullopt; // those may be these
    return static_cast<Index>(*number);
}

bool Document::has(const HandleLine& line) const {
    const auto handle = held_as_in(line, "");
    return handle && handles_[*handle].color == line.color && handles_[*handle].pivot == line.pivot;
}

std::optional<Index> Document::retouched_by(const HandleLine& line, const std::string& place) const {
    const Handle* const old = handle_named(handles_, line.name);
    if (old && old->color == line.color && old->pivot == line.pivot) return std::nullopt;
    return held_as_in(line, place);
}

Index Document::movable_handle(const std::string& name, const char* key, const std::string& place) const {
    const Index handle = find_handle(name, place, key);
    if (handles_[handle].role != HandleRole::moving)
        throw Error(Trouble::input, place,
                    quoted(key) + ": " + quoted(name) +
                        " is not a moving handle; declare it with \"role\":\"moving\"");
    return handle;
}

void Document::refuse_while_posed(const std::string& what, const std::string& place) const {
    if (!is_posed()) return;
    const auto posed = std::ranges::find_if(motions_, leaves_rest);
    const std::string who =
        posed == motions_.end()
            ? std::string("handles are posed")
            : quoted(handles_[static_cast<std::size_t>(posed - motions_.begin())].name) + " is posed";
    throw Error(Trouble::input, place,
                what + " cannot change while " + who + "; put a {\"op\":\"commit\"} line before this one");
}

void Document::prepare_ahead(Progress& progress) {
    if (mode_ == Mode::rehearsal) return;
    if (handles_.empty())
        pipeline_.prepare_ahead(now().settings, progress);
    else
        prepare(progress);
}

void Document::prepare(Progress& progress) {
    prepare_for(at_, progress);
}

void Document::upsample(const std::vector<HandleMotion>& motions, const SampleState& state) {
    posed_is_now_ = false; // the caller may still be cancelled, and then keeps the state that it had
    const Stopwatch clock;
    pipeline_.upsample(motions, state);
    log_.upsample.push_back(clock.seconds());
}

// Nothing was ever moved, as far as is shown.
bool Document::is_as_opened() const {
    return !now().rest && !is_posed() && !under_way_;
}

const RestShape& Document::shown(Progress& progress) {
    if (!under_way_) return shape(progress);
    if (!under_way_->is_shown) show(*under_way_);
    return pipeline_.posed();
}

std::shared_ptr<const RestShape> Document::keep_shown(Progress& progress) {
    if (&shown(progress) == &pipeline_.posed()) return pipeline_.keep_posed();
    return now().rest ? rest_of(now(), progress) : pipeline_.keep_opened();
}

// The posed shape, or the rest shape where nothing is posed. After an undo it is computed again from the
// samples.
const RestShape& Document::shape(Progress& progress) {
    if (!now().rest && !is_posed()) pipeline_.prepare_order(progress);
    if (!is_posed()) return now().rest ? *rest_of(now(), progress) : pipeline_.opened();
    if (!posed_is_now_) {
        const auto samples = samples_of(now(), progress);
        prepare(progress);
        pipeline_.upsample(motions_, *samples);
        posed_is_now_ = true;
    }
    return pipeline_.posed();
}

std::shared_ptr<const RestShape> Document::posed_now(Progress& progress) {
    const auto samples = samples_of(now(), progress);
    shape(progress);
    return posed_shape(motions_, *samples);
}

std::shared_ptr<const RestShape> Document::posed_shape(const std::vector<HandleMotion>& motions,
                                                       const SampleState& samples) {
    if (!holds_splats_) return pipeline_.keep_posed();
    auto shape = std::make_shared<RestShape>(pipeline_.posed());
    shape->rotations = pipeline_.rotations(motions, samples);
    return shape;
}

// Regions are told on the rest shape now. A point lies where the file says plus how far it was moved, so one
// that did not move is exactly where the file says.
std::vector<Index> Document::resolve(const HandleLine& line, const std::string& place) {
    if (mode_ == Mode::rehearsal && now().rest && std::holds_alternative<Region>(line.points)) {
        for (Index i = 0; i < cloud_.size(); ++i)
            if (is_finite(cloud_, i)) return unknown_points(i);
    }
    SilentProgress silent;
    const std::vector<float> rest = now().rest ? positions(silent) : std::vector<float>{};
    const auto file_position = [&](std::size_t i) -> Vec3d {
        const Vec3d opened = cloud_.file_position(i);
        return rest.empty() ? opened : Vec3d(opened + (point_at(rest, i) - point_at(cloud_.positions, i)));
    };
    return resolve_points(line, cloud_, file_position, place);
}

std::string words_about_swallowed(const Document& document, const std::string& handle) {
    const auto number = number_of(document.handles(), handle);
    if (!number || document.pipeline().moves_points(static_cast<Index>(*number))) return {};
    return "handle " + quoted(handle) +
           " moves nothing: handles that were made later hold all of its points; make it again to "
           "give them back to it";
}

std::string words_about_loose(const Document& document, const std::string& handle) {
    const auto number = number_of(document.handles(), handle);
    if (!number || !document.pipeline().is_on_loose_part(static_cast<Index>(*number))) return {};
    return "the part of the cloud that " + quoted(handle) +
           " is on has nothing that stays: what is fixed lies on other parts, and they do not hang "
           "together";
}

} // namespace knead
