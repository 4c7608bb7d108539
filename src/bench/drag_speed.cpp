#include "bench/drag_speed.h"

#include "base/counts.h"
#include "base/require.h"
#include "base/stopwatch.h"
#include "bench/posing.h"
#include "bench/report.h"
#include "edit/json_text.h"
#include "upsample/devices.h"

#include <algorithm>

namespace knead {

namespace {

constexpr double degrees = 60;
constexpr int frames = 30, frames_at_rest = 8;
constexpr double share_of_region = 0.05;

// Drags the document's handle through the task's pose, and takes that back. `rested`: where it came to rest.
DraggedWay drag(const DeformationTask& task, bool coarse, Document& document, LineArray<float>& rested,
                Progress& progress) {
    DraggedWay result;
    std::vector<double> seconds;
    LineArray<float> before;
    const double diagonal = document.bounds().diagonal();
    const auto shape = [&] { return document.pipeline().posed().positions; };
    const Eigen::AngleAxisd whole(task.pose.rotate);
    document.begin_drag("handle", task.pivot, task.name, progress);
    for (int frame = 1; frame <= frames; ++frame) {
        if (frame == frames) before = shape();
        HandlePose pose = turned(degrees * frame / frames, whole.axis());
        pose.coarse = coarse;
        const Stopwatch clock;
        document.drag_frame(pose, task.name, progress);
        (frame == 1 ? result.first_frame : seconds.emplace_back()) = clock.seconds();
    }
    result.frame = summarize(std::move(seconds));
    const LineArray<float> last = shape();
    result.last_step = deviation_between(before, last, diagonal);
    for (int frame = 0; frame < frames_at_rest; ++frame) {
        document.drag_frame(turned(degrees, whole.axis()), task.name, progress);
        if (frame == 0) result.first_at_rest = deviation_between(last, shape(), diagonal);
    }
    rested = shape();
    result.to_rest = deviation_between(last, rested, diagonal);
    document.abandon();
    return result;
}

} // namespace

DragSpeeds measure_drags(const std::string& name, PointCloud cloud, std::span<const std::uint64_t> samples,
                         const Table1Options& options, Progress& progress) {
    require(!samples.empty(), "a number of samples to drag with");
    Workers workers(options.threads);
    UpsamplerChoice choice = make_upsampler(options.device, workers, options.threads);
    DragSpeeds speeds{this_machine(), name, choice.upsampler->device(), cloud.size(), {}, {}, {}};
    if (!choice.warning.empty()) speeds.warnings.push_back(choice.warning);
    const DeformationTask task = bending_task(name, std::move(cloud), degrees);
    for (const std::uint64_t count : samples) {
        if (count >= speeds.points) continue;
        const auto document = open_task(task, with_samples(count), workers, *choice.upsampler);
        DragSpeed row;
        LineArray<float> rested, rested_too;
        row.full = drag(task, false, *document, rested, progress);
        row.coarse = drag(task, true, *document, rested_too, progress);
        row.samples = document->pipeline().samples().size();
        row.upsample = summarize(document->log().upsample).median;
        row.apart = deviation_between(rested, rested_too, document->bounds().diagonal());
        speeds.rows.push_back(row);
    }
    speeds.region =
        measure_region(task, share_of_region, std::ranges::min(samples), options, workers, progress);
    return speeds;
}

namespace {

TextTable region_table(const RegionSpeed& speed) {
    TextTable table{{},
                    {"A handle turned by 30° in 40 frames, in a region of interest of " +
                     grouped(speed.points) + " points and without one"},
                    {},
                    {"", "samples", "frame", "min…max", "upsampling", "min…max", "faster by"}};
    const auto line = [&](const char* what, const RegionSpeed::Frames& way, const std::string& factor) {
        table.push_back({what, grouped(way.samples), duration_text(way.frame.median), spread_text(way.frame),
                         duration_text(way.upsample.median), spread_text(way.upsample), factor});
    };
    line("whole", speed.whole, "");
    line("region", speed.region,
         factor_text(speed.whole.frame.median / speed.region.frame.median) + ", " +
             factor_text(speed.whole.upsample.median / speed.region.upsample.median));
    return table;
}

ReportJson region_json(const RegionSpeed& speed) {
    const auto of = [](const RegionSpeed::Frames& way) {
        return ReportJson{{"samples", way.samples},
                          {"seconds", way.frame.median},
                          {"seconds_min", way.frame.lowest},
                          {"seconds_max", way.frame.highest},
                          {"upsample_seconds", way.upsample.median},
                          {"upsample_seconds_min", way.upsample.lowest},
                          {"upsample_seconds_max", way.upsample.highest}};
    };
    return {{"points", speed.points}, {"without", of(speed.whole)}, {"with", of(speed.region)}};
}

} // namespace

std::string drag_speeds_text(const DragSpeeds& speeds) {
    TextTable table{{machine_text(speeds.machine)},
                    {speeds.cloud + ", " + grouped(speeds.points) + " points on " + speeds.device},
                    {"Bent by 60° in 30 frames, then at rest. Distances in % of D, rms / largest point"},
                    {},
                    {"samples", "answer", "frame", "min…max", "first", "last step", "first at rest",
                     "to rest", "faster by"}};
    const auto apart = [](const Deviation& d) {
        return percent_text(d.rms) + " / " + percent_text(d.largest);
    };
    for (const DragSpeed& row : speeds.rows) {
        const auto line = [&](const char* who, const DraggedWay& way, const std::string& factor) {
            table.push_back({grouped(row.samples), who, duration_text(way.frame.median),
                             spread_text(way.frame), duration_text(way.first_frame), apart(way.last_step),
                             apart(way.first_at_rest), apart(way.to_rest), factor});
        };
        line("all", row.full, "");
        line("few", row.coarse, factor_text(row.full.frame.median / row.coarse.frame.median));
        table.push_back({"  of a frame, upsampling " + duration_text(row.upsample) +
                         "; at rest the two are apart by " + apart(row.apart)});
    }
    return format_table(table) + format_table(region_table(speeds.region));
}

std::string drag_speeds_json(const DragSpeeds& speeds) {
    ReportJson json = machine_json(speeds.machine);
    json["cloud"] = speeds.cloud;
    json["points"] = speeds.points;
    json["device"] = speeds.device;
    json["rows"] = ReportJson::array();
    for (const DragSpeed& row : speeds.rows) {
        const auto way = [](const DraggedWay& w) {
            return ReportJson{
                {"seconds", w.frame.median},         {"seconds_min", w.frame.lowest},
                {"seconds_max", w.frame.highest},    {"seconds_first", w.first_frame},
                {"last_step", json_of(w.last_step)}, {"first_at_rest", json_of(w.first_at_rest)},
                {"to_rest", json_of(w.to_rest)}};
        };
        json["rows"].push_back({{"samples", row.samples},
                                {"full", way(row.full)},
                                {"coarse", way(row.coarse)},
                                {"upsample_seconds", row.upsample},
                                {"apart", json_of(row.apart)}});
    }
    json["region"] = region_json(speeds.region);
    return json_text(json);
}

} // namespace knead
