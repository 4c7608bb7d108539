#include "base/counts.h"
#include "bench/report.h"
#include "bench/small_handles.h"

namespace knead {

namespace {

bool holds(const Deviation& deviation) {
    return deviation.rms <= small_rms_bar && deviation.largest <= small_largest_bar;
}

bool holds(const Askew& askew) {
    return askew.half <= askew_bar && askew.tenth <= most_askew_bar;
}

} // namespace

std::string small_handles_text(std::span<const SmallResult> results) {
    TextTable table{{"Small and scaling handles: distance from every point a sample, % of D, aim " +
                     digits_text(100 * small_rms_bar, 1) + " and nowhere over " +
                     digits_text(100 * small_largest_bar, 0) + "; degrees between"},
                    {"normals and surface, of half of the points and of all but a tenth, aim " +
                     digits_text(askew_bar, 0) + "° and " + digits_text(most_askew_bar, 0) + "°"},
                    {"gesture", "points", "asked", "samples", "rms %", "largest %", "", "half", "nine tenths",
                     "", "iterations"}};
    for (const SmallResult& result : results)
        table.push_back({result.asked ? "" : result.name, result.asked ? "" : grouped(result.points),
                         asked_text(result.asked), grouped(result.samples),
                         result.asked ? percent_text(result.deviation.rms) : unknown_text,
                         result.asked ? percent_text(result.deviation.largest) : unknown_text,
                         result.asked ? verdict_text(holds(result.deviation)) : "",
                         digits_text(result.askew.half, 1), digits_text(result.askew.tenth, 1),
                         verdict_text(holds(result.askew)),
                         std::to_string(result.iterations) + (result.at_rest ? "" : ", not at rest")});
    return format_table(table);
}

ReportJson small_handles_json(std::span<const SmallResult> results) {
    ReportJson json = ReportJson::array();
    for (const SmallResult& result : results)
        json.push_back({{"gesture", result.name},
                        {"points", result.points},
                        {"asked_samples", asked_json(result.asked)},
                        {"samples", result.samples},
                        {"rms", result.deviation.rms},
                        {"largest", result.deviation.largest},
                        {"rms_bar", result.asked ? ReportJson(small_rms_bar) : ReportJson()},
                        {"largest_bar", result.asked ? ReportJson(small_largest_bar) : ReportJson()},
                        {"holds", result.asked ? ReportJson(holds(result.deviation)) : ReportJson()},
                        {"askew_half", result.askew.half},
                        {"askew_tenth", result.askew.tenth},
                        {"askew_bars", {askew_bar, most_askew_bar}},
                        {"askew_holds", holds(result.askew)},
                        {"iterations", result.iterations},
                        {"at_rest", result.at_rest}});
    return json;
}

} // namespace knead
