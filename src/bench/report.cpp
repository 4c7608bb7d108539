#include "bench/report.h"

namespace knead {

std::string asked_text(const std::optional<std::uint64_t>& samples) {
    return samples ? count_text(*samples) : "every point";
}

std::string percent_text(double fraction) {
    return digits_text(100 * fraction, 2);
}

std::string verdict_text(bool holds) {
    return holds ? "pass" : "FAIL";
}

ReportJson json_of(const Deviation& deviation) {
    return {{"rms", deviation.rms}, {"largest", deviation.largest}};
}

ReportJson asked_json(const std::optional<std::uint64_t>& samples) {
    return samples ? ReportJson(*samples) : ReportJson("all");
}

} // namespace knead
