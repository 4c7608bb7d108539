#include "bench/stiffness.h"

#include "bench/made_cloud.h"
#include "bench/posing.h"

#include <optional>

namespace knead {

namespace {

constexpr unsigned settle_limit = 600;
constexpr float scale = 1000;

struct Look {
    std::vector<float> positions; // in the order of the file, of the cloud at its own size
    double diagonal = 0;
    double noise = 0;
    bool at_rest = false;
};

Look look_of(const DeformationTask& task, double stiffness, const std::optional<std::uint64_t>& samples,
             Workers& workers, Upsampler& upsampler, Progress& progress) {
    Settings settings = with_samples(samples);
    settings.stiffness = stiffness;
    const auto document = open_task(task, settings, workers, upsampler);
    document->drag(whole_motion(task), task.name, progress);
    Look look;
    look.at_rest = settle(*document, settle_limit, progress).at_rest;
    look.positions = document->positions(progress);
    look.noise = link_noise(document->pipeline(), document->shape(progress).positions);
    look.diagonal = document->bounds().diagonal();
    return look;
}

DeformationTask enlarged(const DeformationTask& task) {
    DeformationTask large = task;
    std::vector<float> positions;
    for (std::size_t i = 0; i < task.cloud.size(); ++i) {
        const Vec3f place = (task.cloud.file_position(i) * double{scale}).cast<float>();
        positions.insert(positions.end(), place.begin(), place.end());
    }
    large.cloud = make_cloud(positions);
    large.pivot *= double{scale};
    large.pose.translate *= double{scale};
    return large;
}

StiffnessResult::Count compare_count(const DeformationTask& task, const DeformationTask& large,
                                     double stiffness, std::uint64_t samples, const Look& every_point,
                                     Workers& workers, Upsampler& upsampler, Progress& progress) {
    const Look own = look_of(task, stiffness, samples, workers, upsampler, progress);
    Look other = look_of(large, stiffness, samples, workers, upsampler, progress);
    for (float& value : other.positions) value /= scale;
    StiffnessResult::Count count;
    count.asked = samples;
    count.deviation = deviation_between(own.positions, every_point.positions, own.diagonal);
    count.at_scale = deviation_between(other.positions, own.positions, own.diagonal);
    count.at_rest = own.at_rest && other.at_rest;
    return count;
}

} // namespace

double stiffness_rms_bar(std::uint64_t samples) {
    return samples < 1000 ? 0.0045 : 0.002;
}

std::vector<StiffnessResult> evaluate_stiffness(const DeformationTask& task,
                                                std::span<const double> stiffnesses,
                                                std::span<const std::uint64_t> samples, Workers& workers,
                                                Upsampler& upsampler, Progress& progress) {
    const DeformationTask large = enlarged(task);
    const Look usual = look_of(task, Settings{}.stiffness, std::nullopt, workers, upsampler, progress);
    std::vector<StiffnessResult> results;
    for (const double stiffness : stiffnesses) {
        const Look every_point = look_of(task, stiffness, std::nullopt, workers, upsampler, progress);
        StiffnessResult result;
        result.stiffness = stiffness;
        result.points = task.cloud.size();
        result.from_usual = deviation_between(every_point.positions, usual.positions, usual.diagonal);
        result.noise = every_point.noise;
        result.at_rest = every_point.at_rest;
        for (const std::uint64_t count : samples)
            result.counts.push_back(
                compare_count(task, large, stiffness, count, every_point, workers, upsampler, progress));
        results.push_back(std::move(result));
    }
    return results;
}

std::vector<StiffnessResult> evaluate_stiffness(Workers& workers, Upsampler& upsampler, Progress& progress) {
    constexpr double stiffnesses[] = {1e-4, 1e-3, 1e-2, 0.1, 1};
    constexpr std::uint64_t samples[] = {200, 1000, 5000};
    const DeformationTask task = bending_task("bar", made_cloud(Shape::bar, 10'000, workers, progress), 60);
    return evaluate_stiffness(task, stiffnesses, samples, workers, upsampler, progress);
}

} // namespace knead
