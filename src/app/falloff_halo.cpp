#include "app/falloff_halo.h"

#include "graph/distances.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <span>
#include <unordered_map>
#include <utility>

namespace knead {

namespace {

// The vertices that the chosen handle holds, each once: where no later one does.
std::vector<Index> vertices_of_chosen(const Editor& editor) {
    const Handle& chosen = *chosen_handle(editor);
    const auto number = static_cast<std::size_t>(&chosen - editor.document->handles.data());
    std::vector<bool> seen(editor.opened.order->vertices(), false);
    std::vector<Index> vertices;
    for (const Index point : *chosen.points) {
        const Index ordered = editor.ordered[point];
        if (ordered == no_index) continue; // it has no place
        if ((editor.marks[ordered] & mark_handle) != handle_mark(number)) continue;
        const Index vertex = editor.opened.order->vertex[ordered];
        if (!seen[vertex]) vertices.push_back(vertex);
        seen[vertex] = true;
    }
    return vertices;
}

// How far what is small of the handle pulls, by vertices.
std::unordered_map<Index, double> falloffs_of_small(const Editor& editor) {
    std::unordered_map<Index, double> falloffs;
    for (const SmallPatch* patch : small_patches(editor, *chosen_handle(editor)))
        for (const Index vertex : patch->vertices) falloffs.emplace(vertex, patch->falloff);
    return falloffs;
}

// All that the handle pulls, by how little.
std::vector<HaloDot> pulled(std::span<const Reached> reached, double own,
                            const std::unordered_map<Index, double>& falloffs_of_small) {
    std::vector<HaloDot> dots;
    for (const Reached& each : reached) {
        const auto small = falloffs_of_small.find(each.source);
        const double falloff = std::max(own, small != falloffs_of_small.end() ? small->second : 0);
        if (each.distance <= falloff)
            dots.push_back({each.vertex, static_cast<float>(1 - each.distance / falloff)});
    }
    return dots;
}

// Some of them, all over as dense. One anywhere of so many in a row: evenly taken, they would lie in stripes.
std::vector<HaloDot> thinned(const std::vector<HaloDot>& dots) {
    const std::size_t count = std::min(dots.size(), most_halo_dots);
    std::vector<HaloDot> some;
    some.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
        const double anywhere = std::fmod(0.6180339887 * static_cast<double>(k), 1.0);
        const double place = (static_cast<double>(k) + anywhere) / static_cast<double>(count);
        some.push_back(dots[static_cast<std::size_t>(place * static_cast<double>(dots.size()))]);
    }
    return some;
}

} // namespace

void FalloffHalo::begin_anew() {
    searched_ = {};
    dots_.reset();
    *stop_ = true;
}

void FalloffHalo::take_found() {
    if (!thread_ || !result_.with([](const Result& result) { return result.done; })) return;
    thread_.reset();
    Result found = result_.with([](Result& result) { return std::exchange(result, {}); });
    if (!*stop_ && !found.dots.empty())
        dots_ = std::make_shared<const std::vector<HaloDot>>(std::move(found.dots));
}

FalloffHalo::Of FalloffHalo::due(const Editor& editor, bool wanted) {
    const Handle* const handle = wanted && editor.document ? chosen_handle(editor) : nullptr;
    if (!handle || !editor.document->graph || handle->role == HandleRole::region_of_interest) return {};
    const bool is_small = !small_patches(editor, *handle).empty();
    if (!is_small && handle->falloff <= 0) return {};
    return {handle->points, handle->falloff, is_small ? editor.document->small_patches : nullptr,
            editor.document->graph};
}

void FalloffHalo::look_at(const Editor& editor, bool wanted) {
    Of of = due(editor, wanted);
    if (!(of == searched_)) begin_anew();
    take_found();
    if (!(of == searched_) && !thread_) begin(editor, std::move(of)); // one at a time
}

void FalloffHalo::begin(const Editor& editor, Of of) {
    const double farthest = std::max(of.falloff, least_falloff(editor, *chosen_handle(editor)));
    searched_ = std::move(of);
    stop_ = std::make_shared<std::atomic<bool>>(false);
    const PointOrder& order = *editor.opened.order;
    const bool has_twins = order.vertices() < order.points();
    thread_ = std::make_unique<Background>(
        [&result = result_, of = searched_, shape = editor.opened.opened, held = vertices_of_chosen(editor),
         farthest, of_small = falloffs_of_small(editor), stop = stop_,
         order = has_twins ? std::make_shared<const PointOrder>(order) : nullptr] {
            std::vector<HaloDot> dots;
            try {
                std::vector<float> merged;
                if (order) {
                    Workers workers(1);
                    merged = vertex_positions(*order, shape->positions, workers);
                }
                const std::span<const float> positions =
                    order ? std::span<const float>(merged) : std::span<const float>(shape->positions);
                const auto reached = reached_within(*of.graph, positions, held, farthest, stop.get());
                dots = thinned(pulled(std::span(reached).subspan(std::min(held.size(), reached.size())),
                                      of.falloff, of_small));
            } catch (const std::bad_alloc&) { // then there is nothing to see
                dots.clear();
            }
            result.with([&](Result& r) { r = {true, std::move(dots)}; });
        });
}

} // namespace knead
