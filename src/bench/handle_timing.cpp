#include "bench/handle_timing.h"

#include "base/counts.h"
#include "base/stopwatch.h"
#include "bench/automatic_handles.h"
#include "bench/bare_pipeline.h"
#include "bench/made_cloud.h"
#include "bench/report.h"
#include "edit/json_text.h"
#include "edit/pipeline.h"
#include "upsample/devices.h"

#include <array>

namespace knead {

namespace {

constexpr std::size_t fewest_points = 100'000;
constexpr std::array<std::uint64_t, 2> samples_asked{1000, 5000}; // around few, the energy is that of points
constexpr double radius_of_third = 0.03, radius_of_disc = 0.15;   // of the cloud's size

// Who else holds what, and where in their list the third handle is.
struct Arrangement {
    bool in_disc = false, is_first = false;
};
constexpr std::array<Arrangement, 3> arrangements{{{false, false}, {false, true}, {true, false}}};

struct TimedStage {
    const char* name;
    double StageSeconds::*before;
    Summary HandleTimingRow::*after;
};
constexpr std::array<TimedStage, 4> stages{{
    {"sampling", &StageSeconds::sampling, &HandleTimingRow::sampling},
    {"geodesic", &StageSeconds::geodesic, &HandleTimingRow::geodesic},
    {"factorize", &StageSeconds::factorize, &HandleTimingRow::factorize},
    {"device", &StageSeconds::device, &HandleTimingRow::device},
}};

std::vector<Handle> two_handles(const PointCloud& cloud) {
    AutomaticHandles automatic = automatic_handles(cloud);
    return {{"", HandleRole::fixed, shared_points(std::move(automatic.fixed))},
            {"", HandleRole::moving, shared_points(std::move(automatic.moving))}};
}

// What lies so near the middle, or else what does not.
Handle handle_of_disc(const PointCloud& cloud, double radius, bool inside, HandleRole role) {
    const Bounds bounds = bounds_of(cloud);
    const Vec3d middle = (bounds.lowest + bounds.highest) / 2;
    std::vector<Index> points;
    for (Index i = 0; i < cloud.size(); ++i)
        if (((cloud.file_position(i) - middle).norm() <= radius) == inside) points.push_back(i);
    return {"", role, shared_points(std::move(points))};
}

HandleTimingRow measure_plane(const PointCloud& cloud, std::uint64_t samples, Arrangement arrangement,
                              std::size_t repeats, Upsampler& upsampler, Workers& workers,
                              Progress& progress) {
    Pipeline pipeline(cloud, workers, upsampler);
    PipelineInput without;
    without.settings.samples = samples;
    without.handles = two_handles(cloud);
    pipeline.prepare(without, progress);
    const double size = pipeline.cloud_size();
    if (arrangement.in_disc)
        without.handles = {handle_of_disc(cloud, radius_of_disc * size, false, HandleRole::fixed)};
    PipelineInput with = without;
    const Handle third = handle_of_disc(cloud, radius_of_third * size, true, HandleRole::moving);
    with.handles.insert(arrangement.is_first ? with.handles.begin() : with.handles.end(), third);

    HandleTimingRow figures;
    figures.points = cloud.size();
    figures.in_handle = third.points->size();
    figures.is_in_disc = arrangement.in_disc;
    figures.is_first = arrangement.is_first;
    std::array<std::vector<double>, stages.size()> seconds;
    std::vector<double> frame, live;
    for (std::size_t change = 0; change < 2 * (repeats + 1); ++change) {
        const PipelineInput& input = change % 2 == 0 ? with : without;
        const StageSeconds before = pipeline.seconds();
        Stopwatch clock;
        pipeline.prepare(input, progress);
        const double prepared = clock.lap();
        pose_from_rest(pipeline, std::vector<HandleMotion>(input.handles.size()), input.settings.iterations);
        const double shown = clock.lap();
        if (change % 2 == 0) figures.samples = pipeline.samples().size();
        if (change < 2) continue; // warms up
        for (std::size_t s = 0; s < stages.size(); ++s)
            seconds.at(s).push_back(pipeline.seconds().*stages.at(s).before - before.*stages.at(s).before);
        frame.push_back(shown);
        live.push_back(prepared + shown);
    }
    for (std::size_t s = 0; s < stages.size(); ++s) figures.*stages.at(s).after = summarize(seconds.at(s));
    figures.frame = summarize(frame);
    figures.live = summarize(live);
    return figures;
}

} // namespace

HandleTiming measure_handle_timing(std::size_t most_points, const Table1Options& options,
                                   Progress& progress) {
    HandleTiming timing;
    timing.machine = this_machine();
    Workers workers(options.threads);
    timing.threads = workers.threads();
    UpsamplerChoice choice = make_upsampler(options.device, workers, options.threads);
    if (!choice.warning.empty()) timing.warnings.push_back(choice.warning);
    timing.device = choice.upsampler->device();
    for (std::size_t points = fewest_points; points <= most_points; points *= 10) {
        const PointCloud cloud = made_cloud(Shape::plane, points, workers, progress);
        for (const std::uint64_t samples : samples_asked)
            for (const Arrangement& arrangement : arrangements)
                timing.rows.push_back(measure_plane(cloud, samples, arrangement, options.repeats,
                                                    *choice.upsampler, workers, progress));
    }
    if (std::string words = choice.upsampler->take_warning(); !words.empty())
        timing.warnings.push_back(std::move(words));
    return timing;
}

std::string handle_timing_text(const HandleTiming& timing) {
    std::vector<std::string> heading{"points", "samples", "in handle", "free", "place"};
    for (const TimedStage& stage : stages) heading.emplace_back(stage.name);
    for (const char* name : {"frame", "live again", "spread"}) heading.emplace_back(name);
    TextTable table{{machine_text(timing.machine)},
                    {std::to_string(timing.threads) + (timing.threads == 1 ? " thread" : " threads") +
                     " and " + timing.device},
                    {"A third handle on the plane comes or goes, at this place in the list: the stages that "
                     "run again, and the first frame."},
                    {"Free is what two handles at opposite edges leave, or a disc of 15 % around it."},
                    {""},
                    heading};
    for (const HandleTimingRow& row : timing.rows) {
        std::vector<std::string> line{grouped(row.points), grouped(row.samples), grouped(row.in_handle),
                                      row.is_in_disc ? "disc" : "most", row.is_first ? "first" : "last"};
        for (const TimedStage& stage : stages) line.push_back(duration_text((row.*stage.after).median));
        line.push_back(duration_text(row.frame.median));
        line.push_back(duration_text(row.live.median));
        line.push_back(spread_text(row.live));
        table.push_back(line);
    }
    return format_table(table);
}

std::string handle_timing_json(const HandleTiming& timing) {
    ReportJson json = machine_json(timing.machine);
    json["threads"] = timing.threads;
    json["device"] = timing.device;
    json["warnings"] = timing.warnings;
    json["rows"] = ReportJson::array();
    for (const HandleTimingRow& row : timing.rows) {
        ReportJson seconds;
        for (const TimedStage& stage : stages) seconds[stage.name] = json_of(row.*stage.after);
        seconds["frame"] = json_of(row.frame);
        seconds["live"] = json_of(row.live);
        json["rows"].push_back({{"points", row.points},
                                {"samples", row.samples},
                                {"in_handle", row.in_handle},
                                {"free", row.is_in_disc ? "disc" : "most"},
                                {"place", row.is_first ? "first" : "last"},
                                {"seconds", seconds}});
    }
    return json_text(json);
}

} // namespace knead
