#include "base/counts.h"
#include "bench/report.h"
#include "bench/scan_samples.h"

namespace knead {

std::string scan_samples_text(std::span<const ScanSamples> scans) {
    TextTable table{
        {"Samples on scans: two automatic handles, bent by 60°, settled after one frame; distance from the "
         "first line's shape, % of D;"},
        {noise_words()},
        {"scan", "points", "asked", "samples", "rms %", "largest %", "noise %", "times", "", "iterations"}};
    for (const ScanSamples& scan : scans) {
        if (!scan.missing.empty()) table.push_back({scan.name + ": " + scan.missing});
        for (const ScanSampleCount& count : scan.counts) {
            const bool first = &count == &scan.counts.front();
            const double times = noise_times(count.noise, scan.counts.front().noise);
            table.push_back(
                {first ? scan.name : "", first ? grouped(scan.points) : "", asked_text(count.asked),
                 grouped(count.samples), first ? unknown_text : percent_text(count.rms),
                 first ? unknown_text : percent_text(count.largest), percent_text(count.noise),
                 first ? "" : digits_text(times, 2), first ? "" : verdict_text(times <= noise_bar),
                 std::to_string(count.iterations) + (count.at_rest ? "" : ", not at rest")});
        }
    }
    return format_table(table);
}

ReportJson scan_samples_json(std::span<const ScanSamples> scans) {
    ReportJson json = ReportJson::array();
    for (const ScanSamples& scan : scans) {
        ReportJson entry{{"name", scan.name},
                         {"missing", scan.missing.empty() ? ReportJson() : ReportJson(scan.missing)},
                         {"points", scan.points},
                         {"samples", ReportJson::array()}};
        for (const ScanSampleCount& count : scan.counts) {
            const double times = noise_times(count.noise, scan.counts.front().noise);
            entry["samples"].push_back({{"asked", asked_json(count.asked)},
                                        {"samples", count.samples},
                                        {"rms", count.rms},
                                        {"largest", count.largest},
                                        {"noise", count.noise},
                                        {"noise_times", times},
                                        {"noise_bar", noise_bar},
                                        {"holds", times <= noise_bar},
                                        {"iterations", count.iterations},
                                        {"at_rest", count.at_rest}});
        }
        json.push_back(std::move(entry));
    }
    return json;
}

} // namespace knead
