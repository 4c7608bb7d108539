#include "bench/demands.h"

#include "bench/made_cloud.h"
#include "bench/posing.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace knead {

namespace {

constexpr unsigned settle_limit = 1000;
constexpr std::size_t points = 6000;
constexpr double free_half = 2; // the free part of the bar lies between the heights ±2
constexpr std::size_t slabs = 16;

// The largest over the smallest stretch along z between neighbouring slabs of the free part, less 1.
double unevenness(std::span<const float> rest, std::span<const float> posed) {
    std::vector<double> before(slabs, 0), now(slabs, 0), count(slabs, 0);
    for (std::size_t i = 2; i < rest.size(); i += 3) {
        const double part = (double{rest[i]} + free_half) / (2 * free_half);
        if (!(part >= 0 && part < 1)) continue;
        const auto slab = static_cast<std::size_t>(part * slabs);
        before[slab] += double{rest[i]};
        now[slab] += double{posed[i]};
        ++count[slab];
    }
    double smallest = 1e300, largest = 0;
    for (std::size_t s = 1; s < slabs; ++s) {
        const double stretch = (now[s] / count[s] - now[s - 1] / count[s - 1]) /
                               (before[s] / count[s] - before[s - 1] / count[s - 1]);
        smallest = std::min(smallest, stretch);
        largest = std::max(largest, stretch);
    }
    return largest / smallest - 1;
}

using Chosen = std::function<bool(const Vec3d&, Index)>;

DeformationTask bar_task(const PointCloud& bar, const Chosen& is_fixed, const Chosen& is_handle,
                         const HandlePose& pose) {
    DeformationTask task;
    task.cloud = bar;
    task.pose = pose;
    for (Index i = 0; i < bar.size(); ++i) {
        const Vec3d place = bar.file_position(i);
        if (is_fixed(place, i))
            task.fixed.push_back(i);
        else if (is_handle(place, i))
            task.handle.push_back(i);
    }
    return task;
}

} // namespace

DemandResult evaluate_demand(const DemandCase& demand_case, Workers& workers, Upsampler& upsampler,
                             Progress& progress) {
    const DeformationTask& task = demand_case.task;
    const auto document = open_task(task, Settings{}, workers, upsampler);
    document->drag(whole_motion(task), demand_case.name, progress);
    settle(*document, settle_limit, progress);
    DemandResult result;
    result.name = demand_case.name;
    result.points = task.cloud.size();
    result.demand = document->demand(progress);
    result.too_much = demand_case.too_much;
    result.words = words_about_demand(result.demand);
    if (demand_case.straight) result.uneven = unevenness(task.cloud.positions, document->positions(progress));
    result.handle_error = document->handle_error(progress);
    return result;
}

std::vector<DemandResult> evaluate_demands(Workers& workers, Upsampler& upsampler, Progress& progress) {
    const PointCloud bar = made_cloud(Shape::bar, points, workers, progress);
    const Chosen foot = [](const Vec3d& p, Index) { return p.z() <= -free_half; };
    const Chosen top = [](const Vec3d& p, Index) { return p.z() >= free_half; };
    const Chosen upper = [](const Vec3d& p, Index) { return p.z() > 0; };
    const Chosen lower = [](const Vec3d& p, Index) { return p.z() <= 0; };
    const Chosen odd = [](const Vec3d& p, Index i) { return std::abs(p.z()) < 0.5 && i % 2 == 1; };
    const Chosen even = [](const Vec3d& p, Index i) { return std::abs(p.z()) < 0.5 && i % 2 == 0; };
    const auto pulled = [&](double length) {
        return bar_task(bar, foot, top, shifted({0, 0, 2 * free_half * (length - 1)}));
    };
    const DemandCase cases[] = {
        {"bar, twisted 135°", generated_task("made-bar", workers, progress), false, false},
        {"tube, bent 120°", generated_task("made-cylinder", workers, progress), false, false},
        {"plane, shifted", generated_task("made-plane", workers, progress), false, false},
        {"bar, twice as long", pulled(2), false, true},
        {"bar, half as long", pulled(0.5), false, true},
        {"bar, 4 times as long", pulled(4), true, true},
        {"bar, a quarter as long", pulled(0.25), true, true},
        {"bar, turned back on itself", pulled(-0.5), false, false},
        {"bar, one half off the other", bar_task(bar, lower, upper, shifted({1, 0, 0})), true, false},
        {"bar, every other point off", bar_task(bar, even, odd, shifted({0.5, 0, 0})), true, false},
    };
    std::vector<DemandResult> results;
    for (const DemandCase& each : cases)
        results.push_back(evaluate_demand(each, workers, upsampler, progress));
    return results;
}

} // namespace knead
