#include "bench/report.h"

#include "base/counts.h"
#include "bench/machine.h"

namespace knead {

std::string asked_text(const std::optional<std::uint64_t>& samples) {
    return samples ? grouped(*samples) : "every point";
}

std::string share_text(double fraction) {
    return digits_text(100 * fraction, 0) + " %";
}

double noise_times(double noise, double full) {
    return full > 0 ? noise / full : 1;
}

std::string noise_words() {
    return "noise: rms of log(length posed / at rest) of the links between neighbours, %, aim " +
           digits_text(noise_bar, 1) + " times the first line's";
}

std::string percent_text(double fraction) {
    return digits_text(100 * fraction, 2);
}

std::string verdict_text(bool holds) {
    return holds ? "pass" : "FAIL";
}

std::string machine_text(const Machine& machine) {
    return machine.processor + ", " + std::to_string(machine.cores) + " cores, load " +
           digits_text(machine.load, 1) + "; knead " + machine.version + " (" + machine.commit + "), " +
           machine.compiler + ", " + machine.build;
}

ReportJson machine_json(const Machine& machine) {
    return {{"processor", machine.processor}, {"cores", machine.cores}, {"load", machine.load},
            {"compiler", machine.compiler},   {"build", machine.build}, {"version", machine.version},
            {"commit", machine.commit}};
}

ReportJson json_of(const Summary& measured) {
    return {{"median", measured.median},
            {"min", measured.lowest},
            {"max", measured.highest},
            {"count", measured.count}};
}

ReportJson json_of(const Deviation& deviation) {
    return {{"rms", deviation.rms}, {"largest", deviation.largest}};
}

ReportJson asked_json(const std::optional<std::uint64_t>& samples) {
    return samples ? ReportJson(*samples) : ReportJson("all");
}

} // namespace knead
