#include "base/counts.h"
#include "bench/report.h"
#include "bench/turns.h"

#include <cmath>

namespace knead {

namespace {

bool holds(const Deviation& deviation) {
    return deviation.largest <= turn_bar;
}

bool keeps_its_twist(const TurnResult& result) {
    return !result.twist || std::abs(*result.twist - *result.asked_twist) <= twist_bar;
}

std::string twist_words(const TurnResult& result) {
    return result.twist ? digits_text(*result.twist, 0) + "°" : "";
}

std::string verdict(const TurnResult& result, const Deviation& deviation) {
    return result.aimed ? verdict_text(holds(deviation)) : "ambiguous";
}

std::string twist_verdict(const TurnResult& result) {
    return !result.twist || !result.aimed ? "" : verdict_text(keeps_its_twist(result));
}

} // namespace

std::string turns_text(std::span<const TurnResult> results) {
    TextTable table{
        {"Ways to one pose, 1000 samples, 3 iterations a frame: largest distance from the longest way's "
         "settled shape, % of D, aim " +
         digits_text(100 * turn_bar, 0) + "; what is left of a twist, aim within " +
         digits_text(twist_bar, 0) + "°"},
        {"course", "points", "frames", "at the last %", "", "settled %", "", "twist", "",
         "iterations of settling"}};
    for (const TurnResult& result : results)
        table.push_back({result.course, grouped(result.points), grouped(result.frames),
                         percent_text(result.at_last_frame.largest), verdict(result, result.at_last_frame),
                         percent_text(result.settled.largest), verdict(result, result.settled),
                         twist_words(result), twist_verdict(result),
                         std::to_string(result.iterations) + (result.at_rest ? "" : ", not at rest")});
    return format_table(table);
}

ReportJson turns_json(std::span<const TurnResult> results) {
    ReportJson json = ReportJson::array();
    for (const TurnResult& result : results) {
        ReportJson entry{{"course", result.course},
                         {"points", result.points},
                         {"frames", result.frames},
                         {"at_last_frame", json_of(result.at_last_frame)},
                         {"settled", json_of(result.settled)},
                         {"bar", result.aimed ? ReportJson(turn_bar) : ReportJson()},
                         {"iterations", result.iterations},
                         {"at_rest", result.at_rest}};
        entry["at_last_frame"]["holds"] =
            result.aimed ? ReportJson(holds(result.at_last_frame)) : ReportJson();
        entry["settled"]["holds"] = result.aimed ? ReportJson(holds(result.settled)) : ReportJson();
        if (result.twist)
            entry["twist"] = {{"asked", *result.asked_twist},
                              {"measured", *result.twist},
                              {"holds", result.aimed ? ReportJson(keeps_its_twist(result)) : ReportJson()}};
        json.push_back(std::move(entry));
    }
    return json;
}

} // namespace knead
