// The stages of a Pipeline that run again when the handles change.

#include "base/stopwatch.h"
#include "edit/bed_samples.h"
#include "edit/pipeline.h"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace knead {

namespace {

// Where less than one in so many vertices is free, samples go there.
constexpr std::size_t little_free = 4;

// Of the samples asked for, this many more may be spent on the borders of handles.
constexpr double handle_share = 0.2;

constexpr std::size_t grain = 1 << 14;

// So many samples handles need at the least.
std::size_t parts_with_border(std::span<const HeldBlock> held, const Components& components) {
    std::vector<HeldPart> parts;
    for (const HeldBlock& block : held)
        for (const BorderVertex& border : block.borders)
            parts.push_back({border.label, components.component[border.vertex]});
    std::sort(parts.begin(), parts.end());
    return static_cast<std::size_t>(std::unique(parts.begin(), parts.end()) - parts.begin());
}

std::size_t handle_budget(std::size_t base_samples) {
    return static_cast<std::size_t>(handle_share * static_cast<double>(base_samples));
}

} // namespace

// What is around what is small of the handles.
Vicinities Pipeline::find_vicinities(Progress& progress) {
    const std::size_t handles = slots_.handles.size();
    PatchesOfHandles found{
        knead::small_patches(handles, labels_.vertex, held_blocks_, *graph_, vertex_positions(), cloud_size_),
        {}};
    for (const Handle& handle : slots_.handles) found.points.push_back(handle.points);
    small_patches_ = std::make_shared<const PatchesOfHandles>(std::move(found));
    return vicinities(handles, small_patches_->patches, samples_, labels_.vertex, held_blocks_, *graph_,
                      vertex_positions(), workers_, progress);
}

void Pipeline::find_pulled(const Vicinities& near, Progress& progress) {
    pulled_ = pulled_samples(slots_.handles, labels_.vertex, components_->component, held_blocks_,
                             small_patches_->patches, near, samples_, *graph_, vertex_positions(), workers_,
                             progress);
}

void Pipeline::prepare_labels() {
    const Stopwatch clock;
    label_vertices();
    find_held_inside();
    seconds_.sampling += clock.seconds();
}

// Of each label whether it holds much, which may end early: all but the smallest, which hold less than one in
// so many of the vertices that are free, all together. Those may come and go, and the samples stay. Nothing
// where the others leave more than one in so many of all vertices.
std::vector<bool> Pipeline::labels_that_leave_little() const {
    std::vector<std::size_t> count(slots_.handles.size() + 1, 0); // and what is outside
    for (const HeldBlock& block : held_blocks_)
        for (const HeldExtent& extent : block.extents) count[extent.label] += extent.count;
    const std::size_t vertices = order_.vertices();
    const std::size_t held = std::accumulate(count.begin(), count.end(), std::size_t{0});
    std::vector<std::size_t> label(count.size());
    std::iota(label.begin(), label.end(), std::size_t{0});
    std::ranges::stable_sort(label, {}, [&](std::size_t each) { return count[each]; });
    std::vector<bool> much(count.size(), true);
    std::size_t small = 0; // held by those that do not
    for (const std::size_t each : label) {
        if (little_free * (small + count[each]) >= vertices - held) break;
        small += count[each];
        much[each] = false;
    }
    if (held == vertices || little_free * (vertices - held + small) >= vertices) return {};
    while (!much.empty() && !much.back()) much.pop_back();
    return much;
}

// Where little of the cloud is free: samples are of use there alone. Looks again at what changed hands, and
// at what is beside it, as long as the same handles hold much.
void Pipeline::find_held_inside() {
    std::vector<bool> hold_much = labels_that_leave_little();
    const auto is_held = [&](Index v) { return is_set(hold_much, labels_.vertex[v]); };
    const auto is_inside = [&](Index v) -> std::uint8_t {
        return is_held(v) && std::ranges::all_of(graph_->row(v), is_held) ? 1 : 0;
    };
    bool changed = false;
    if (hold_much == hold_much_ && !hold_much.empty()) {
        const auto look_at = [&](Index v) {
            const std::uint8_t now = is_inside(v);
            changed |= now != held_inside_[v];
            held_inside_[v] = now;
        };
        for (std::size_t block = 0; block < labels_.changed.size(); ++block) {
            if (!labels_.changed[block]) continue;
            const auto [begin, end] = rows_of_block(block, order_.vertices());
            for (std::size_t v = begin; v < end; ++v) {
                look_at(static_cast<Index>(v));
                std::ranges::for_each(graph_->row(v), look_at);
            }
        }
    } else {
        std::vector<std::uint8_t> inside(hold_much.empty() ? 0 : order_.vertices());
        workers_.for_each(inside.size(), grain,
                          [&](std::size_t v) { inside[v] = is_inside(static_cast<Index>(v)); });
        changed = inside != held_inside_;
        held_inside_ = std::move(inside);
        hold_much_ = std::move(hold_much);
    }
    if (changed && !every_point_) stale_.samples = true;
}

void Pipeline::prepare_handles(Progress& progress) {
    Stopwatch clock;
    samples_.resize(base_samples_);
    const Vicinities near = find_vicinities(progress);
    if (every_point_) { // their graph is that of the points, whatever the handles are
        find_pulled(near, progress);
        choose_coarse_samples();
        seconds_.geodesic += clock.lap();
        return;
    }
    const VertexShape shape{order_.cube, vertex_positions(), *graph_, *components_, hanging_};
    std::vector<bool> turning; // what is inside of them goes by samples: followed_by()
    for (Index label = 0; label < slots_.handles.size(); ++label) turning.push_back(turns_freely(label));
    const std::size_t budget = handle_budget(base_samples_);
    const std::size_t at_least = parts_with_border(held_blocks_, *components_);
    const std::vector<Index> in_beds =
        bed_samples(small_patches_->patches, near, hanging_, vertex_positions(), cloud_size_,
                    (budget - std::min(budget, at_least)) / 2);
    HandleSamples needed = handle_samples(shape, labels_.of_vertices(), held_blocks_, samples_, territories_,
                                          turning, budget - in_beds.size());
    needed.added.insert(needed.added.end(), in_beds.begin(), in_beds.end());
    samples_.insert(samples_.end(), needed.added.begin(), needed.added.end());
    seconds_.sampling += clock.lap();

    stale_.samples = true; // a flood that is cancelled leaves lists that nothing can revert
    const std::vector<TerritoryBorder> borders =
        change_added(territories_, needed.added, *graph_, link_lengths_, workers_, progress);
    nearest_.first_handle = first_handle_number();
    change_starts(from_handles_, handle_starts(needed.borders), nearest_, changed_rows_, *graph_,
                  link_lengths_, workers_, progress);
    stale_.samples = false;
    std::vector<WideRow> rows = rows_of_base_;
    const std::vector<WideRow> more = rows_without(from_handles_, nearest_, needed.added);
    rows.insert(rows.end(), more.begin(), more.end());
    sample_graph_ = knead::sample_graph(rows, borders, workers_);
    find_pulled(near, progress);
    choose_coarse_samples();
    seconds_.geodesic += clock.lap();
}

// Handles have the numbers from here on, which stay what they are while samples come and go: so what was
// flooded of a handle stays good. Rows are not made wide for that.
Index Pipeline::first_handle_number() const {
    const std::size_t room = base_samples_ + handle_budget(base_samples_);
    const std::size_t handles = slots_.handles.size() + 1; // and what is outside
    const bool would_widen = base_samples_ < NarrowRow::none && room + handles > NarrowRow::none;
    return static_cast<Index>(would_widen ? samples_.size() : std::max(samples_.size(), room));
}

bool Pipeline::turns_freely(Index label) const {
    return label < slots_.handles.size() && slots_.handles[label].free_rotation;
}

// The handles that leave rotation free and turn as one, with the component where: they have one sample, or
// border without any. Ascending.
std::vector<std::pair<Index, Index>> Pipeline::find_hinges(std::span<const BorderVertex> borders) const {
    std::vector<std::pair<Index, Index>> hinges;
    std::vector<Index> with_sample;
    std::vector<std::size_t> own; // samples of each handle
    for (const BorderVertex& border : borders) {
        if (!turns_freely(border.label)) continue;
        if (with_sample.empty()) {
            with_sample = samples_;
            std::ranges::sort(with_sample);
            own.resize(slots_.handles.size());
            for (const Index v : samples_)
                if (labels_.vertex[v] < own.size()) ++own[labels_.vertex[v]];
        }
        if (own[border.label] == 1 || !std::ranges::binary_search(with_sample, border.vertex))
            hinges.emplace_back(border.label, components_->component[border.vertex]);
    }
    std::ranges::sort(hinges);
    hinges.erase(std::unique(hinges.begin(), hinges.end()), hinges.end());
    return hinges;
}

// Between samples, a handle is near where its border is near, not where a sample of it is: it starts from all
// along the border, with the number of its own motion. A row of pegs, which leaves rotation free and has
// samples all along its border, turns with each of them, and those start for it. (What is wider would be torn
// off between its samples: the border lies where the handle says, and what is beside it where samples with
// turns of their own say. A lone one would be torn off where samples are few: weights of samples share out
// what is right at one of them, too.) And free samples that were added start like base samples.
std::vector<FloodStart> Pipeline::handle_starts(std::span<const BorderVertex> borders) const {
    const std::vector<std::pair<Index, Index>> hinges = find_hinges(borders);
    const auto is_peg = [&](Index label, Index vertex) {
        return turns_freely(label) &&
               !std::ranges::binary_search(hinges, std::pair{label, components_->component[vertex]});
    };
    std::vector<FloodStart> starts;
    for (const BorderVertex& border : borders)
        if (!is_peg(border.label, border.vertex))
            starts.push_back({border.vertex, nearest_.first_handle + border.label});
    for (auto s = static_cast<Index>(base_samples_); s < samples_.size(); ++s)
        if (const Index label = labels_.vertex[samples_[s]]; label == no_index || is_peg(label, samples_[s]))
            starts.push_back({samples_[s], s});
    return starts;
}

void Pipeline::choose_coarse_samples() {
    coarse_.samples = {};
    if (!wants_coarse_level(samples_.size())) return;
    std::vector<Vec3d> position;
    std::vector<Index> handle;
    for (const Index v : samples_) {
        position.push_back(point_at(vertex_positions(), v));
        handle.push_back(labels_.vertex[v]);
    }
    coarse_.samples = coarse_samples(sample_graph_.graph, position, handle, workers_);
}

// An outlier has no say: held or not, it is like the vertex that it hangs on, or turns along with it. Its own
// points still follow their handle, but nothing else does for its sake.
void Pipeline::label_hanging() {
    workers_.for_each(hanging_.size(), grain, [&](std::size_t v) { // in blocks: see rows_in_block
        if (!hanging_[v]) return;
        Index label = labels_.vertex[graph_->row(v).front()]; // which does not hang
        if (label != no_index && turns_freely(label)) label = no_index;
        if (labels_.vertex[v] == label) return;
        labels_.vertex[v] = label;
        labels_.held[v / rows_in_block] = labels_.changed[v / rows_in_block] = 1;
    });
}

// Who holds what, and which components hold a handle.
void Pipeline::label_vertices() {
    label_points(slots_.handles, order_, cloud_.size(), workers_, labels_);
    label_hanging();
    find_held(labels_.of_vertices(), labels_.changed, *graph_, vertex_positions(), *components_, workers_,
              held_blocks_);
    std::vector<bool> held(components_->size.size(), false);
    for (const HeldBlock& block : held_blocks_)
        for (const HeldPart& part : block.parts) held[part.component] = true;
    stale_.contacts |= held != held_component_;
    held_component_ = std::move(held);
    note_single_places();
    count_strays();
    find_standing_points();
}

void Pipeline::note_single_places() {
    std::vector<std::size_t> count(slots_.handles.size(), 0);
    for (const HeldBlock& block : held_blocks_)
        for (const HeldExtent& extent : block.extents)
            if (extent.label < count.size()) count[extent.label] += extent.count;
    holds_one_place_.assign(count.size(), false);
    for (std::size_t label = 0; label < count.size(); ++label) holds_one_place_[label] = count[label] == 1;
}

void Pipeline::find_standing_points() {
    std::vector<Index> point; // empty: of each vertex the first
    const std::size_t vertices = order_.vertices();
    const auto choose = [&](Index v) {
        const Index first = order_.first_point[v], end = order_.first_point[v + 1];
        Index own = first;
        while (own < end && labels_.point[own] != labels_.vertex[v]) ++own;
        if (own == first || own == end) return;
        if (point.empty())
            for (std::size_t u = 0; u < vertices; ++u) point.push_back(order_.first_point[u]);
        point[v] = own;
    };
    if (vertices < order_.points())
        for (std::size_t block = 0; block < labels_.held.size(); ++block) {
            if (!labels_.held[block]) continue;
            const auto [begin, end] = rows_of_block(block, vertices);
            for (std::size_t v = begin; v < end; ++v) choose(static_cast<Index>(v));
        }
    std::optional<Numbering> standing;
    if (!point.empty()) standing.emplace(std::move(point));
    if (standing == standing_) return;
    standing_ = std::move(standing);
    stale_.areas = true;
}

void Pipeline::count_strays() {
    strays_ = {};
    strays_.parts = static_cast<std::size_t>(std::ranges::count(held_component_, false));
    if (strays_.parts == 0) return;
    std::atomic<std::size_t> points = 0;
    workers_.for_chunks(order_.points(), grain, [&](std::size_t begin, std::size_t end) {
        std::size_t here = 0;
        for (std::size_t i = begin; i < end; ++i)
            here += held_component_[components_->component[order_.vertex[i]]] ? 0 : 1;
        points += here;
    });
    strays_.points = points;
}

// It looks at all points only of a handle that holds no vertex: it may still hold outliers or twins.
bool Pipeline::moves_points(Index handle) const {
    const Index label = slots_.slot[handle];
    for (const HeldBlock& block : held_blocks_)
        if (std::ranges::find(block.extents, label, &HeldExtent::label) != block.extents.end()) return true;
    return std::ranges::find(labels_.point, label) != labels_.point.end();
}

// Of the largest part that it reaches into.
bool Pipeline::is_on_loose_part(Index handle) const {
    const Index label = slots_.slot[handle];
    Index part = no_index;
    for (const HeldBlock& block : held_blocks_)
        for (const HeldPart& held : block.parts)
            if (held.label == label &&
                (part == no_index || components_->size[held.component] > components_->size[part]))
                part = held.component;
    const auto is_fixed = [&](const HeldPart& held) {
        return held.label == labels_.outside || slots_.handles[held.label].role == HandleRole::fixed;
    };
    const auto stays_here = [&](const HeldPart& held) { return held.component == part && is_fixed(held); };
    const auto is_anywhere = [&](const auto& held) {
        return std::ranges::any_of(
            held_blocks_, [&](const HeldBlock& block) { return std::ranges::any_of(block.parts, held); });
    };
    return part != no_index && is_anywhere(is_fixed) && !is_anywhere(stays_here);
}

// The handle that moves a point alone, or no_index. Beside what a handle holds itself, that is what is right
// there, inside of it: twins of what it holds, and outliers that hang on it.
Index Pipeline::followed_by(std::size_t point) const {
    if (labels_.point[point] != no_index || every_point_) return labels_.point[point];
    const Index label = labels_.vertex[order_.vertex[point]];
    return label != no_index && !turns_freely(label) ? label : no_index;
}

// Whether movers are what they were before, but for those of points whose labels changed: what no handle
// holds has the same one for all handles, if every part holds one.
bool Pipeline::are_known(const MoverNumbers& numbers) const {
    const MoverNumbers& former = mover_numbers_;
    const auto both = static_cast<std::ptrdiff_t>(std::min(numbers.turning.size(), former.turning.size()));
    return numbers.first_handle != 0 && former.first_handle == numbers.first_handle &&
           std::equal(numbers.turning.begin(), numbers.turning.begin() + both, former.turning.begin());
}

// `first_handle`: as a mover.
Pipeline::MoverNumbers Pipeline::find_mover_numbers(std::size_t first_handle) const {
    MoverNumbers numbers{strays_.parts == 0 ? first_handle : 0, std::vector<bool>(slots_.handles.size())};
    for (Index label = 0; label < numbers.turning.size(); ++label)
        numbers.turning[label] = turns_freely(label);
    return numbers;
}

// What moves the points of a block of vertices is another.
void Pipeline::note_changed_points(std::size_t block) {
    const auto [begin, end] = rows_of_block(block, order_.vertices());
    const Index first = order_.first_point[begin], last = order_.first_point[end] - 1;
    for (std::size_t of_points = first / points_in_block; of_points <= last / points_in_block; ++of_points)
        changed_points_[of_points] = 1;
}

void Pipeline::prepare_influences() {
    Stopwatch clock;
    // A held point is moved by its handle alone, whatever samples are near, and a point of a stray part by
    // nothing. Where every point is a sample there are no rows, and each is moved by the motion of its own.
    first_handle_motion_ = every_point_ ? samples_.size() : nearest_.first_handle;
    const std::size_t first_handle = nearest_.size() + first_handle_motion_; // as a mover
    const Index outside = labels_.outside;
    std::vector<Index> mover_of_label(outside + 1);
    std::iota(mover_of_label.begin(), mover_of_label.end(), static_cast<Index>(first_handle));
    const Index first_carried = mover_of_label.back() + 1;
    prepare_carried(mover_of_label);
    const auto mover_of = [&](std::size_t point) {
        const Index vertex = order_.vertex[point];
        const Index component = components_->component[vertex];
        if (const Index label = followed_by(point); label != no_index) return mover_of_label[label];
        if (held_component_[component]) return vertex;
        return carried_.size() > 0 ? first_carried + contacts_.part[component] : mover_of_label[outside];
    };
    MoverNumbers numbers = find_mover_numbers(first_handle);
    const bool only_changed = are_known(numbers);
    mover_numbers_ = {}; // until all are made: what fails on the way begins anew
    mover_of_point_.resize(order_.points());
    mover_ends_.resize(labels_.changed.size());
    changed_points_.resize(blocks_of(order_.points()), 1);
    for (std::size_t block = 0; block < labels_.changed.size(); ++block)
        if (!only_changed || labels_.changed[block]) note_changed_points(block);
    workers_.for_each(labels_.changed.size(), grain / rows_in_block, [&](std::size_t block) {
        if (only_changed && !labels_.changed[block]) return;
        labels_.changed[block] = 0;
        const auto [begin, end] = rows_of_block(block, order_.vertices());
        std::size_t& mover_end = mover_ends_[block] = 0;
        for (Index i = order_.first_point[begin]; i < order_.first_point[end]; ++i) {
            mover_of_point_[i] = mover_of(i);
            mover_end = std::max(mover_end, std::size_t{mover_of_point_[i]} + 1);
        }
    });
    motions_.assign(first_handle_motion_ + outside + 1 + carried_.size(), Motion{});
    mover_numbers_ = std::move(numbers);
    seconds_.geodesic += clock.lap();
}

// What carries the parts that hold no handle.
void Pipeline::prepare_carried(std::span<const Index> mover_of_label) {
    strays_.fate = input_.settings.strays;
    carried_ = {};
    if (strays_.fate == Strays::freeze || strays_.parts == 0) return;
    if (stale_.contacts)
        contacts_ = find_contacts(vertex_positions(), *components_, held_component_, workers_);
    stale_.contacts = false;
    std::vector<Index> mover_of_vertex(order_.vertices());
    for (Index v = 0; v < mover_of_vertex.size(); ++v)
        mover_of_vertex[v] = labels_.vertex[v] == no_index ? v : mover_of_label[labels_.vertex[v]];
    carried_ = carried_parts(contacts_, nearest_, input_.settings.weights, mover_of_vertex);
    if (carried_.size() == 0) strays_.fate = Strays::freeze; // there is nothing to carry them
}

} // namespace knead
