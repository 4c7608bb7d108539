#include "app/estimated_normals.h"

#include "base/stopwatch.h"
#include "graph/shading_normals.h"

#include <new>
#include <utility>

namespace knead {

namespace {

// So long, in seconds, nothing moves until the shape is taken to rest.
constexpr double rest = 0.25;

// An estimate that takes no longer, in seconds, is made while the shape moves, for a part of the time.
constexpr double quick = 0.12;
constexpr double part_of_time = 0.25;

// The window and the solver have work of their own.
constexpr unsigned threads = 2;

} // namespace

void EstimatedNormals::begin_anew() {
    ++cloud_;
    order_.reset();
    seen_ = estimated_ = 0;
    cost_ = begun_ = 0;
    due_ = false;
}

void EstimatedNormals::look_at(const Editor& editor, bool wanted, double now) {
    due_ = false;
    if (!wanted || !editor.document || !editor.document->graph || !editor.frame.normals().empty()) return;
    if (editor.frame.version != seen_) {
        seen_ = editor.frame.version;
        changed_ = now;
    }
    due_ = estimated_ != seen_;
    const bool rests = estimated_ == 0 || now - changed_ > rest;
    const bool in_motion = cost_ < quick && now - begun_ > cost_ / part_of_time;
    const bool has_points = !editor.frame.on_device; // those that are seen
    if (due_ && has_points && (rests || in_motion) && !thread_) begin(editor, now);
}

bool EstimatedNormals::made_in_motion(const Editor& editor, bool wanted) const {
    return wanted && editor.frame.normals().empty() && cost_ < quick;
}

bool EstimatedNormals::outdated() const {
    return cost_ >= quick && estimated_ != seen_;
}

void EstimatedNormals::begin(const Editor& editor, double now) {
    if (!order_) order_ = std::make_shared<const PointOrder>(*editor.opened.order);
    estimated_ = seen_;
    of_cloud_ = cloud_;
    begun_ = now;
    due_ = false;
    result_.with([](Result& result) { result = {}; });
    thread_ = std::make_unique<Background>(
        [&result = result_, order = order_, graph = editor.document->graph, shape = editor.frame.shape] {
            const Stopwatch clock;
            std::vector<float> normals;
            try {
                Workers workers(threads);
                const std::vector<float> vertices = vertex_positions(*order, shape->positions, workers);
                normals = spread_to_points(shading_normals(*graph, vertices, workers), order->vertex);
            } catch (const std::bad_alloc&) { // then the points are flat
                normals.clear();
            }
            result.with([&](Result& r) { r = {true, clock.seconds(), std::move(normals)}; });
        });
}

std::optional<std::vector<float>> EstimatedNormals::take() {
    if (!thread_ || !result_.with([](const Result& result) { return result.done; })) return std::nullopt;
    thread_.reset();
    Result result = result_.with([](Result& r) { return std::exchange(r, {}); });
    if (of_cloud_ != cloud_) return std::nullopt;
    cost_ = result.seconds;
    return std::move(result.normals);
}

} // namespace knead
