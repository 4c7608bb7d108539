#include "bench/quality.h"

#include "base/require.h"
#include "bench/automatic_handles.h"
#include "edit/document.h"

#include <algorithm>
#include <cmath>

namespace knead {

namespace {

// What is aimed at on every survey shape: RMS over D with so many samples.
std::optional<double> bar_for(std::string_view name, const std::optional<std::uint64_t>& samples) {
    const std::vector<std::string> names = survey_names();
    if (std::ranges::find(names, name) == names.end() || !samples) return std::nullopt;
    switch (*samples) {
    case 1000:
        return 0.002;
    case 200:
        return 0.0045;
    case 50:
        return 0.009;
    default:
        return std::nullopt;
    }
}

DragLine whole_motion(const DeformationTask& task) {
    return {"handle", task.pivot, {task.pose}};
}

// A document of the task, and the shape it settles into.
class TaskRun {
public:
    TaskRun(const DeformationTask& task, const std::optional<std::uint64_t>& samples, Workers& workers,
            Upsampler& upsampler)
        : task_(task), document_(task.cloud, settings_of(samples), workers, upsampler) {
        document_.declare(handle_line("fixed", HandleRole::fixed, task.fixed), task.name);
        document_.declare(handle_line("handle", HandleRole::moving, task.handle), task.name);
    }

    std::vector<float> settled(SampleQuality& quality, Progress& progress) {
        document_.drag(whole_motion(task_), task_.name, progress);
        const std::size_t dragged = document_.log().iteration.size();
        document_.settle({settle_limit}, progress);
        quality.iterations = document_.log().iteration.size();
        quality.at_rest = quality.iterations < dragged + settle_limit;
        quality.samples = document_.pipeline().samples().size();
        quality.handle_error = document_.handle_error(progress);
        std::vector<float> positions = document_.positions(progress);
        document_.undo(task_.name);
        document_.undo(task_.name);
        return positions;
    }

    std::vector<float> after(unsigned iterations, Progress& progress) {
        SettingsChange change;
        change.iterations = iterations;
        document_.change_settings(change, task_.name);
        document_.drag(whole_motion(task_), task_.name, progress);
        std::vector<float> positions = document_.positions(progress);
        document_.undo(task_.name);
        return positions;
    }

    double diagonal() const { return document_.bounds().diagonal(); }

private:
    static Settings settings_of(const std::optional<std::uint64_t>& samples) {
        Settings settings;
        settings.samples = samples;
        return settings;
    }

    const DeformationTask& task_;
    Document document_;
};

Convergence converge(TaskRun& run, const std::optional<std::uint64_t>& asked,
                     const std::vector<float>& settled, Progress& progress) {
    Convergence result;
    result.asked = asked;
    for (const unsigned iterations : {0U, 1U, 3U, 5U, 10U})
        result.steps.push_back(
            {iterations, deviation_between(run.after(iterations, progress), settled, run.diagonal())});
    return result;
}

} // namespace

Deviation deviation_between(std::span<const float> a, std::span<const float> b, double diagonal) {
    require(a.size() == b.size(), "two poses of one cloud");
    double sum = 0;
    double largest = 0;
    for (std::size_t i = 0; i + 3 <= a.size(); i += 3) {
        double square = 0;
        for (std::size_t c = i; c < i + 3; ++c) {
            if (!std::isfinite(a[c])) continue;
            const double way = double{a[c]} - double{b[c]};
            square += way * way;
        }
        sum += square;
        largest = std::max(largest, square);
    }
    const double unit = diagonal > 0 ? diagonal : 1;
    const double points = std::max(1.0, static_cast<double>(a.size()) / 3);
    return {std::sqrt(sum / points) / unit, std::sqrt(largest) / unit};
}

TaskQuality evaluate_task(const DeformationTask& task, Workers& workers, Upsampler& upsampler,
                          Progress& progress) {
    TaskQuality quality;
    quality.name = task.name;
    quality.points = task.cloud.size();
    std::vector<float> every_point;
    const std::optional<std::uint64_t> counts[] = {std::nullopt, 1000U, 200U, 50U};
    for (const std::optional<std::uint64_t>& asked : counts) {
        TaskRun run(task, asked, workers, upsampler);
        quality.diagonal = run.diagonal();
        SampleQuality count;
        count.asked = asked;
        count.bar = bar_for(task.name, asked);
        const std::vector<float> settled = run.settled(count, progress);
        if (!asked) every_point = settled;
        count.deviation = deviation_between(settled, every_point, run.diagonal());
        quality.counts.push_back(count);
        if (!asked || asked == 1000U) quality.convergence.push_back(converge(run, asked, settled, progress));
    }
    return quality;
}

} // namespace knead
