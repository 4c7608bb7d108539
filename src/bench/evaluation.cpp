#include "bench/evaluation.h"

#include "base/error.h"
#include "base/quoted.h"
#include "bench/made_cloud.h"
#include "io/cloud_file.h"
#include "upsample/devices.h"

#include <algorithm>

namespace knead {

namespace {

constexpr const char* twisted_name = "made-bar";
constexpr const char* elasticity_name = "elasticity";
constexpr const char* sampling_name = "sampling";
constexpr const char* turns_name = "turns";
constexpr const char* stiffness_name = "stiffness";
constexpr const char* demands_name = "demands";
constexpr const char* small_name = "small";

std::string samples_name(const NamedScan& scan) {
    return std::string("samples-") + scan.name;
}

// Generated clouds on which properties are checked.
struct MadeCloud {
    const char* name;
    Shape shape;
    std::size_t points;
};
constexpr MadeCloud made_clouds[] = {
    {twisted_name, Shape::bar, 20'000},
    {"made-solid-bar", Shape::solid_bar, 20'000},
    {"made-knot", Shape::knot, 20'000},
    {"made-creature", Shape::creature, 50'000},
};

std::vector<std::string> task_names(const EvaluationOptions& options) {
    return survey_folder(options.survey) ? survey_names() : generated_names();
}

bool is_chosen(const EvaluationOptions& options, const std::string& name) {
    return options.shapes.empty() || std::ranges::find(options.shapes, name) != options.shapes.end();
}

void refuse_unknown_names(const EvaluationOptions& options) {
    const std::vector<std::string> known = evaluation_names(options);
    for (const std::string& name : options.shapes) {
        if (std::ranges::find(known, name) != known.end()) continue;
        std::string words = "there is no shape " + quoted(name) + " to evaluate; there are";
        for (const std::string& other : known) words += " " + other;
        throw Error(Trouble::usage, "", words);
    }
}

void evaluate_tasks(const EvaluationOptions& options, Workers& workers, Upsampler& upsampler,
                    Progress& progress, Evaluation& result) {
    const auto folder = survey_folder(options.survey);
    result.has_survey = folder.has_value();
    if (!folder)
        result.remark = missing_words(options.survey, "survey shape") + "; likenesses stand in for them";
    for (const std::string& name : task_names(options)) {
        if (!is_chosen(options, name)) continue;
        const DeformationTask task =
            folder ? read_survey_task(*folder, name) : generated_task(name, workers, progress);
        result.tasks.push_back(evaluate_task(task, workers, upsampler, progress));
    }
}

void evaluate_studies(const EvaluationOptions& options, Workers& workers, Upsampler& upsampler,
                      Progress& progress, Evaluation& result) {
    if (is_chosen(options, twisted_name)) result.twist = evaluate_twist(workers, upsampler, progress);
    if (is_chosen(options, elasticity_name)) {
        const std::optional<std::uint64_t> counts[] = {200U, 1000U, std::nullopt};
        result.stretches = evaluate_elasticity(counts, workers, upsampler, progress);
    }
    if (is_chosen(options, sampling_name))
        result.samplings = evaluate_sampling(options.survey, options.scans, workers, upsampler, progress);
    if (is_chosen(options, turns_name)) result.turns = evaluate_turns(workers, upsampler, progress);
    if (is_chosen(options, stiffness_name))
        result.stiffnesses = evaluate_stiffness(workers, upsampler, progress);
    if (is_chosen(options, demands_name)) result.demands = evaluate_demands(workers, upsampler, progress);
    if (is_chosen(options, small_name))
        result.small_handles = evaluate_small_handles(workers, upsampler, progress);
    for (const NamedScan& scan : scans_to_sample())
        if (is_chosen(options, samples_name(scan)))
            result.scans.push_back(evaluate_scan_samples(scan, options.scans, workers, upsampler, progress));
}

void evaluate_clouds(const EvaluationOptions& options, Progress& progress, Evaluation& result) {
    const auto check = [&](const std::string& name, const PointCloud& cloud) {
        result.clouds.push_back(evaluate_cloud(name, cloud, options.device, options.threads, progress));
    };
    for (const MadeCloud& made : made_clouds) {
        if (!is_chosen(options, made.name)) continue;
        Workers workers(options.threads);
        check(made.name, made_cloud(made.shape, made.points, workers, progress));
    }
    for (const auto& path : data_files(options.scans, ".ply")) {
        const std::string name = path.stem().string();
        if (!is_chosen(options, name)) continue;
        const PointCloud cloud = read_cloud(path, progress);
        if (bounds_of(cloud).finite_points == 0)
            throw Error(Trouble::input, path.string(), "holds no point with finite coordinates");
        check(name, cloud);
    }
}

} // namespace

std::vector<std::string> evaluation_names(const EvaluationOptions& options) {
    std::vector<std::string> names = task_names(options);
    for (const MadeCloud& made : made_clouds)
        if (std::ranges::find(names, made.name) == names.end()) names.emplace_back(made.name);
    for (const char* name :
         {elasticity_name, sampling_name, turns_name, stiffness_name, demands_name, small_name})
        names.emplace_back(name);
    for (const NamedScan& scan : scans_to_sample()) names.push_back(samples_name(scan));
    for (const auto& path : data_files(options.scans, ".ply")) names.push_back(path.stem().string());
    return names;
}

Evaluation evaluate(const EvaluationOptions& options, Progress& progress) {
    refuse_unknown_names(options);
    Evaluation result;
    result.machine = this_machine();
    {
        Workers workers(options.threads);
        const UpsamplerChoice choice = make_upsampler(options.device, workers, options.threads);
        result.device = choice.upsampler->device();
        if (!choice.warning.empty()) result.warnings.push_back(choice.warning);
        evaluate_tasks(options, workers, *choice.upsampler, progress, result);
        evaluate_studies(options, workers, *choice.upsampler, progress, result);
        const std::string words = choice.upsampler->take_warning();
        if (!words.empty()) result.warnings.push_back(words);
    }
    evaluate_clouds(options, progress, result);
    return result;
}

} // namespace knead
