#include "base/counts.h"
#include "bench/report.h"
#include "bench/sampling.h"

namespace knead {

namespace {

bool holds(const SamplingResult& result) {
    return result.deviation.rms <= sampling_rms_bar && result.deviation.largest <= sampling_largest_bar;
}

} // namespace

std::string sampling_text(std::span<const SamplingResult> results) {
    TextTable table{
        {"Sampling: from an evenly sampled twin that was posed alike, % of D, by the nearest points "
         "at rest; aim rms " +
         digits_text(100 * sampling_rms_bar, 1) + ", largest " + digits_text(100 * sampling_largest_bar, 1)},
        {"shape", "sampling", "points", "twin's", "samples", "rms %", "largest %", "", "settled"}};
    for (const SamplingResult& result : results)
        table.push_back({result.shape, result.sampling, grouped(result.points), grouped(result.twin_points),
                         asked_text(result.asked), percent_text(result.deviation.rms),
                         percent_text(result.deviation.largest), verdict_text(holds(result)),
                         result.at_rest ? "yes" : "no"});
    return format_table(table);
}

ReportJson sampling_json(std::span<const SamplingResult> results) {
    ReportJson json = ReportJson::array();
    for (const SamplingResult& result : results)
        json.push_back({{"shape", result.shape},
                        {"sampling", result.sampling},
                        {"points", result.points},
                        {"twin_points", result.twin_points},
                        {"asked_samples", asked_json(result.asked)},
                        {"rms", result.deviation.rms},
                        {"largest", result.deviation.largest},
                        {"rms_bar", sampling_rms_bar},
                        {"largest_bar", sampling_largest_bar},
                        {"holds", holds(result)},
                        {"at_rest", result.at_rest}});
    return json;
}

} // namespace knead
