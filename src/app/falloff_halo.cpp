#include "app/falloff_halo.h"

#include "graph/distances.h"

#include <new>
#include <utility>

namespace knead {

namespace {

// The vertices that a handle holds, each once.
std::vector<Index> vertices_of(const Editor& editor, const std::vector<Index>& points) {
    std::vector<bool> seen(editor.opened.order->vertices(), false);
    std::vector<Index> vertices;
    for (const Index point : points) {
        if (editor.ordered[point] == no_index) continue; // it has no place
        const Index vertex = editor.opened.order->vertex[editor.ordered[point]];
        if (!seen[vertex]) vertices.push_back(vertex);
        seen[vertex] = true;
    }
    return vertices;
}

// Some of what lies around the handle, all over as dense.
std::vector<HaloDot> dots_among(const std::vector<Reached>& reached, std::size_t held, double falloff) {
    const std::size_t around = reached.size() - held;
    const std::size_t count = std::min(around, most_halo_dots);
    std::vector<HaloDot> dots;
    dots.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
        const Reached& each = reached[held + k * around / count];
        dots.push_back({each.vertex, static_cast<float>(1 - each.distance / falloff)});
    }
    return dots;
}

} // namespace

void FalloffHalo::begin_anew() {
    searched_ = {};
    dots_.reset();
}

FalloffHalo::Of FalloffHalo::due(const Editor& editor, bool wanted) {
    const Handle* const handle = wanted && editor.document ? chosen_handle(editor) : nullptr;
    if (!handle || !editor.document->graph || handle->role == HandleRole::region_of_interest) return {};
    const double falloff = std::max(handle->falloff, least_falloff(editor, *handle));
    return falloff > 0 ? Of{handle->points, falloff, editor.document->graph} : Of{};
}

void FalloffHalo::look_at(const Editor& editor, bool wanted) {
    Of of = due(editor, wanted);
    if (thread_ && result_.with([](const Result& result) { return result.done; })) {
        thread_.reset();
        Result found = result_.with([](Result& result) { return std::exchange(result, {}); });
        if (of.points && of == searched_ && !found.dots.empty())
            dots_ = std::make_shared<const std::vector<HaloDot>>(std::move(found.dots));
    }
    if (of == searched_) return;
    dots_.reset();
    if (!thread_) begin(editor, std::move(of)); // one at a time
}

void FalloffHalo::begin(const Editor& editor, Of of) {
    searched_ = std::move(of);
    if (!searched_.points) return;
    const PointOrder& order = *editor.opened.order;
    const bool has_twins = order.vertices() < order.points();
    thread_ = std::make_unique<Background>([&result = result_, of = searched_, shape = editor.opened.opened,
                                            held = vertices_of(editor, *searched_.points),
                                            order = has_twins ? std::make_shared<const PointOrder>(order)
                                                              : nullptr] {
        std::vector<HaloDot> dots;
        try {
            std::vector<float> merged;
            if (order) {
                Workers workers(1);
                merged = vertex_positions(*order, shape->positions, workers);
            }
            const std::span<const float> positions =
                order ? std::span<const float>(merged) : std::span<const float>(shape->positions);
            dots =
                dots_among(reached_within(*of.graph, positions, held, of.falloff), held.size(), of.falloff);
        } catch (const std::bad_alloc&) { // then there is nothing to see
            dots.clear();
        }
        result.with([&](Result& r) { r = {true, std::move(dots)}; });
    });
}

} // namespace knead
