// The evaluation as text and as JSON.

#include "base/counts.h"
#include "bench/evaluation.h"
#include "bench/report.h"
#include "edit/json_text.h"

#include <cmath>

namespace knead {

namespace {

// How far off a kept twist may be measured: slices are not infinitely thin.
constexpr double twist_tolerance_degrees = 2;

bool holds(const SampleQuality& count) {
    return !count.bar || count.deviation.rms <= *count.bar;
}

bool holds(const StretchResult& stretch) {
    return std::abs(stretch.measured - stretch.asked) <= poisson_bar;
}

bool twist_is_kept(const TwistResult& twist, double measured) {
    return std::abs(measured - twist.asked) <= twist_tolerance_degrees;
}

std::string tasks_text(const std::vector<TaskQuality>& tasks) {
    TextTable table{{"Distance from every point a sample, % of D, settled after one frame;"},
                    {noise_words()},
                    {"shape", "points", "asked", "samples", "rms %", "bar", "", "largest %", "noise %",
                     "times", "", "handle error / D", "iterations"}};
    for (const TaskQuality& task : tasks)
        for (const SampleQuality& count : task.counts) {
            const bool first = &count == &task.counts.front();
            const double times = noise_times(count.noise, task.counts.front().noise);
            table.push_back(
                {first ? task.name : "", first ? grouped(task.points) : "", asked_text(count.asked),
                 grouped(count.samples), count.asked ? percent_text(count.deviation.rms) : unknown_text,
                 count.bar ? percent_text(*count.bar) : "", count.bar ? verdict_text(holds(count)) : "",
                 count.asked ? percent_text(count.deviation.largest) : unknown_text,
                 percent_text(count.noise), count.asked ? digits_text(times, 2) : "",
                 count.bar ? verdict_text(times <= noise_bar) : "", power_text(count.handle_error),
                 std::to_string(count.iterations) + (count.at_rest ? "" : ", not at rest")});
        }
    return format_table(table);
}

bool holds(const Convergence::Step& step) {
    return !step.bar || step.deviation.largest <= *step.bar;
}

// A column for every number of iterations, and one for the verdict where something is aimed at.
void add_convergence_columns(const Convergence& convergence, std::vector<std::string>& heads) {
    for (const auto& step : convergence.steps) {
        heads.push_back(std::to_string(step.iterations));
        if (step.bar) heads.push_back("aim " + digits_text(100 * *step.bar, 1));
    }
}

std::string convergence_text(const std::vector<TaskQuality>& tasks) {
    TextTable table{{"Largest distance from the settled shape, % of D, after so many iterations from rest"},
                    {"shape", "samples"}};
    for (const TaskQuality& task : tasks)
        for (const Convergence& convergence : task.convergence) {
            if (table[1].size() == 2) add_convergence_columns(convergence, table[1]);
            std::vector<std::string> line{&convergence == &task.convergence.front() ? task.name : "",
                                          asked_text(convergence.asked)};
            for (const auto& step : convergence.steps) {
                line.push_back(digits_text(100 * step.deviation.largest, 3));
                if (step.bar) line.push_back(verdict_text(holds(step)));
            }
            table.push_back(std::move(line));
        }
    return format_table(table);
}

std::string clouds_text(const std::vector<CloudProperties>& clouds) {
    TextTable table{{"Properties, with two handles at the ends and 1000 samples; strays stay where they are"},
                    {"cloud", "points", "strays", "rigid / D", "", "in turns / D", "", "iterations",
                     "moved by nothing", "", "handles / D", "same again", "1 and 2 threads"}};
    for (const CloudProperties& cloud : clouds)
        table.push_back({cloud.name, grouped(cloud.points), grouped(cloud.strays), power_text(cloud.rigid),
                         verdict_text(cloud.rigid <= rigid_bar), power_text(cloud.rigid_in_turns),
                         verdict_text(cloud.rigid_in_turns <= rigid_in_turns_bar),
                         std::to_string(cloud.iterations_in_turns), grouped(cloud.moved_by_nothing),
                         verdict_text(cloud.moved_by_nothing == 0), power_text(cloud.handle_error),
                         cloud.same_again ? "same" : "DIFFERENT",
                         cloud.same_for_threads ? "same" : "DIFFERENT"});
    return format_table(table);
}

std::string twist_text(const TwistResult& twist) {
    const auto line = [&](const char* when, double measured, double uneven) {
        return std::string("  ") + when + digits_text(measured, 1) + "° along it, " +
               verdict_text(twist_is_kept(twist, measured)) + "; a slice at most " + digits_text(uneven, 1) +
               "° from an even twist\n";
    };
    return "A bar of 1 : 10, " + grouped(twist.points) + " points, twisted by " +
           digits_text(twist.asked, 0) + "°, 10° and 3 iterations a frame\n" +
           line("at the last frame:    ", twist.measured, twist.uneven) +
           line("100 iterations later: ", twist.settled, twist.settled_uneven);
}

std::string stretches_text(const std::vector<StretchResult>& stretches) {
    TextTable table{{"Poisson's ratio, asked and measured at mid-length of a bar of 1 : 10 pulled by 30 %"},
                    {"bar", "points", "samples", "asked", "measured", "off by", "", "iterations"}};
    for (const StretchResult& stretch : stretches)
        table.push_back(
            {stretch.solid ? "solid" : "shell", grouped(stretch.points), asked_text(stretch.asked_samples),
             digits_text(stretch.asked, 2), digits_text(stretch.measured, 3),
             digits_text(std::abs(stretch.measured - stretch.asked), 3), verdict_text(holds(stretch)),
             std::to_string(stretch.iterations) + (stretch.at_rest ? "" : ", not at rest")});
    return format_table(table);
}

ReportJson json_of(const StretchResult& stretch) {
    return {{"solid", stretch.solid},
            {"points", stretch.points},
            {"asked_samples", asked_json(stretch.asked_samples)},
            {"asked", stretch.asked},
            {"measured", stretch.measured},
            {"along", stretch.along},
            {"bar", poisson_bar},
            {"holds", holds(stretch)},
            {"iterations", stretch.iterations},
            {"at_rest", stretch.at_rest}};
}

ReportJson json_of(const TaskQuality& task) {
    ReportJson json{{"name", task.name}, {"points", task.points}, {"diagonal", task.diagonal}};
    for (const SampleQuality& count : task.counts) {
        const double times = noise_times(count.noise, task.counts.front().noise);
        json["samples"].push_back({{"asked", asked_json(count.asked)},
                                   {"samples", count.samples},
                                   {"rms", count.deviation.rms},
                                   {"largest", count.deviation.largest},
                                   {"bar", count.bar ? ReportJson(*count.bar) : ReportJson()},
                                   {"holds", count.bar ? ReportJson(holds(count)) : ReportJson()},
                                   {"noise", count.noise},
                                   {"noise_times", times},
                                   {"noise_bar", count.bar ? ReportJson(noise_bar) : ReportJson()},
                                   {"noise_holds", count.bar ? ReportJson(times <= noise_bar) : ReportJson()},
                                   {"handle_error", count.handle_error},
                                   {"iterations", count.iterations},
                                   {"at_rest", count.at_rest}});
    }
    for (const Convergence& convergence : task.convergence) {
        ReportJson steps = ReportJson::array();
        for (const auto& step : convergence.steps) {
            ReportJson entry = json_of(step.deviation);
            entry["iterations"] = step.iterations;
            entry["bar"] = step.bar ? ReportJson(*step.bar) : ReportJson();
            entry["holds"] = step.bar ? ReportJson(holds(step)) : ReportJson();
            steps.push_back(std::move(entry));
        }
        json["convergence"].push_back(
            {{"asked", asked_json(convergence.asked)}, {"steps", std::move(steps)}});
    }
    return json;
}

ReportJson json_of(const CloudProperties& cloud) {
    return {{"name", cloud.name},
            {"points", cloud.points},
            {"stray_points", cloud.strays},
            {"rigid", cloud.rigid},
            {"rigid_in_turns", cloud.rigid_in_turns},
            {"rigid_bar", rigid_bar},
            {"rigid_in_turns_bar", rigid_in_turns_bar},
            {"iterations_in_turns", cloud.iterations_in_turns},
            {"moved_by_nothing", cloud.moved_by_nothing},
            {"handle_error", cloud.handle_error},
            {"same_again", cloud.same_again},
            {"same_for_threads", cloud.same_for_threads}};
}

} // namespace

std::string evaluation_text(const Evaluation& evaluation) {
    std::string text = "knead " + evaluation.machine.version + " (" + evaluation.machine.commit + ") on " +
                       evaluation.device + "\n";
    if (!evaluation.remark.empty()) text += evaluation.remark + "\n";
    if (!evaluation.tasks.empty())
        text += "\n" + tasks_text(evaluation.tasks) + "\n" + convergence_text(evaluation.tasks);
    if (evaluation.twist) text += "\n" + twist_text(*evaluation.twist);
    if (!evaluation.scans.empty()) text += "\n" + scan_samples_text(evaluation.scans);
    if (!evaluation.samplings.empty()) text += "\n" + sampling_text(evaluation.samplings);
    if (!evaluation.turns.empty()) text += "\n" + turns_text(evaluation.turns);
    if (!evaluation.stretches.empty()) text += "\n" + stretches_text(evaluation.stretches);
    if (!evaluation.stiffnesses.empty()) text += "\n" + stiffness_text(evaluation.stiffnesses);
    if (!evaluation.demands.empty()) text += "\n" + demands_text(evaluation.demands);
    if (!evaluation.small_handles.empty()) text += "\n" + small_handles_text(evaluation.small_handles);
    if (!evaluation.clouds.empty()) text += "\n" + clouds_text(evaluation.clouds);
    return text;
}

std::string evaluation_json(const Evaluation& evaluation) {
    ReportJson json{{"version", evaluation.machine.version},
                    {"commit", evaluation.machine.commit},
                    {"device", evaluation.device},
                    {"survey", evaluation.has_survey},
                    {"warnings", evaluation.warnings},
                    {"tasks", ReportJson::array()},
                    {"clouds", ReportJson::array()},
                    {"elasticity", ReportJson::array()},
                    {"scan_samples", scan_samples_json(evaluation.scans)},
                    {"sampling", sampling_json(evaluation.samplings)},
                    {"turns", turns_json(evaluation.turns)},
                    {"stiffness", stiffness_json(evaluation.stiffnesses)},
                    {"demands", demands_json(evaluation.demands)},
                    {"small", small_handles_json(evaluation.small_handles)},
                    {"twist", ReportJson()}};
    for (const TaskQuality& task : evaluation.tasks) json["tasks"].push_back(json_of(task));
    for (const StretchResult& stretch : evaluation.stretches) json["elasticity"].push_back(json_of(stretch));
    for (const CloudProperties& cloud : evaluation.clouds) json["clouds"].push_back(json_of(cloud));
    if (const auto& twist = evaluation.twist)
        json["twist"] = {{"points", twist->points},
                         {"asked_degrees", twist->asked},
                         {"measured_degrees", twist->measured},
                         {"uneven_degrees", twist->uneven},
                         {"settled_degrees", twist->settled},
                         {"settled_uneven_degrees", twist->settled_uneven},
                         {"holds", twist_is_kept(*twist, twist->measured)},
                         {"settled_holds", twist_is_kept(*twist, twist->settled)}};
    return json_text(json);
}

} // namespace knead
