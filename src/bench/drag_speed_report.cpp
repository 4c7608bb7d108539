// The speed of drags as text and as JSON.

#include "base/counts.h"
#include "bench/drag_speed.h"
#include "bench/report.h"
#include "edit/json_text.h"

namespace knead {

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
                          {"seconds", json_of(way.frame)},
                          {"upsample_seconds", json_of(way.upsample)}};
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
            return ReportJson{{"seconds", json_of(w.frame)},
                              {"seconds_first", w.first_frame},
                              {"last_step", json_of(w.last_step)},
                              {"first_at_rest", json_of(w.first_at_rest)},
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
