#include "base/counts.h"
#include "bench/report.h"
#include "bench/stiffness.h"

#include <cmath>
#include <cstdio>

namespace knead {

namespace {

bool holds(const StiffnessResult::Count& count) {
    return count.deviation.rms <= stiffness_rms_bar(count.asked);
}

bool holds_at_scale(const StiffnessResult::Count& count) {
    return count.at_scale.largest <= scale_bar;
}

std::string short_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

} // namespace

std::string stiffness_text(std::span<const StiffnessResult> results) {
    TextTable table{
        {"Stiffness α: a bar bent by 60°; how far turns spread, √α of its size; with every point a sample, "
         "rms "
         "from α = 0.01's shape and"},
        {"of the links' stretch; with m samples, rms from every point a sample; and 1000 times as large, "
         "largest from that; all % of D"},
        {"stiffness", "spread %", "from 0.01 %", "links %", "samples", "rms %", "aim", "", "× 1000 %", "aim",
         "", "settled"}};
    for (const StiffnessResult& result : results)
        for (const StiffnessResult::Count& count : result.counts) {
            const bool first = &count == &result.counts.front();
            const auto once = [first](const std::string& text) { return first ? text : ""; };
            table.push_back(
                {once(short_text(result.stiffness)), once(digits_text(100 * std::sqrt(result.stiffness), 0)),
                 once(percent_text(result.from_usual.rms)), once(percent_text(result.noise)),
                 grouped(count.asked), percent_text(count.deviation.rms),
                 percent_text(stiffness_rms_bar(count.asked)), verdict_text(holds(count)),
                 digits_text(100 * count.at_scale.largest, 3), percent_text(scale_bar),
                 verdict_text(holds_at_scale(count)), count.at_rest && result.at_rest ? "yes" : "no"});
        }
    return format_table(table);
}

ReportJson stiffness_json(std::span<const StiffnessResult> results) {
    ReportJson json = ReportJson::array();
    for (const StiffnessResult& result : results) {
        ReportJson entry{{"stiffness", result.stiffness},
                         {"points", result.points},
                         {"from_usual", json_of(result.from_usual)},
                         {"link_noise", result.noise},
                         {"at_rest", result.at_rest},
                         {"samples", ReportJson::array()}};
        for (const StiffnessResult::Count& count : result.counts)
            entry["samples"].push_back({{"asked", count.asked},
                                        {"deviation", json_of(count.deviation)},
                                        {"bar", stiffness_rms_bar(count.asked)},
                                        {"holds", holds(count)},
                                        {"at_scale_1000", json_of(count.at_scale)},
                                        {"scale_bar", scale_bar},
                                        {"scale_holds", holds_at_scale(count)},
                                        {"at_rest", count.at_rest}});
        json.push_back(std::move(entry));
    }
    return json;
}

} // namespace knead
