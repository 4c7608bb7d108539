#include "bench/quality.h"

#include "bench/posing.h"

#include <algorithm>

namespace knead {

namespace {

bool is_of_the_survey(std::string_view name) {
    const std::vector<std::string> names = survey_names();
    return std::ranges::find(names, name) != names.end();
}

// What is aimed at on every survey shape: RMS over D with so many samples.
std::optional<double> bar_for(std::string_view name, const std::optional<std::uint64_t>& samples) {
    if (!is_of_the_survey(name) || !samples) return std::nullopt;
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

// What is aimed at on every survey shape: the largest distance over D after so many iterations.
std::optional<double> bar_after(std::string_view name, unsigned iterations) {
    if (!is_of_the_survey(name)) return std::nullopt;
    if (iterations == 5) return 0.005;
    if (iterations == 10) return 0.001;
    return std::nullopt;
}

// The task's document; every pose is taken back again.
class TaskRun {
public:
    TaskRun(const DeformationTask& task, const std::optional<std::uint64_t>& samples, Workers& workers,
            Upsampler& upsampler)
        : task_(task), document_(open_task(task, with_samples(samples), workers, upsampler)) {}

    std::vector<float> settled(SampleQuality& quality, Progress& progress) {
        document_->drag(whole_motion(task_), task_.name, progress);
        const Settling settling = settle(*document_, settle_limit, progress);
        quality.iterations = settling.iterations;
        quality.at_rest = settling.at_rest;
        quality.samples = document_->pipeline().samples().size();
        quality.noise = link_noise(document_->pipeline(), document_->shape(progress).positions);
        quality.handle_error = document_->handle_error(progress);
        std::vector<float> positions = document_->positions(progress);
        document_->undo(task_.name);
        document_->undo(task_.name);
        return positions;
    }

    std::vector<float> after(unsigned iterations, Progress& progress) {
        SettingsChange change;
        change.iterations = iterations;
        document_->change_settings(change, task_.name);
        document_->drag(whole_motion(task_), task_.name, progress);
        std::vector<float> positions = document_->positions(progress);
        document_->undo(task_.name);
        return positions;
    }

    const std::string& name() const { return task_.name; }
    double diagonal() const { return document_->bounds().diagonal(); }

private:
    const DeformationTask& task_;
    std::unique_ptr<Document> document_;
};

Convergence converge(TaskRun& run, const std::optional<std::uint64_t>& asked,
                     const std::vector<float>& settled, Progress& progress) {
    Convergence result;
    result.asked = asked;
    for (const unsigned iterations : {0U, 1U, 3U, 5U, 10U})
        result.steps.push_back({iterations,
                                deviation_between(run.after(iterations, progress), settled, run.diagonal()),
                                bar_after(run.name(), iterations)});
    return result;
}

} // namespace

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
