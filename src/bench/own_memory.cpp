#include "bench/own_memory.h"

#include "bench/report.h"
#include "upsample/drawing.h"

namespace knead {

namespace {

constexpr std::size_t warm_up_frames = 3, copies = 9;

double per_second(std::size_t bytes, const Summary& seconds) {
    return seconds.median > 0 ? static_cast<double>(bytes) / seconds.median : 0;
}

std::vector<double> moving_seconds(const DeviceFrame& frame, std::size_t frames) {
    DrawnPoints drawn;
    std::vector<double> moving;
    for (std::size_t f = 0; f < warm_up_frames + frames; ++f) {
        drawn.move(frame, Held::nothing);
        if (f >= warm_up_frames) moving.push_back(drawn.moving_seconds());
    }
    return moving;
}

OwnMemoryFigures measure(const UpsamplerProbe& probe, const DeviceFrame& frame, std::size_t frames,
                         std::size_t large_copy) {
    OwnMemoryFigures figures;
    figures.moving = summarize(moving_seconds(frame, frames));
    figures.bytes = bytes_a_frame(probe);
    figures.copy = summarize(device_copy_seconds(frame, figures.bytes, frames));
    figures.copy_bytes_per_second =
        per_second(large_copy, summarize(device_copy_seconds(frame, large_copy, copies)));
    return figures;
}

} // namespace

std::optional<OwnMemoryFigures> measure_in_own_memory(UpsamplerProbe& probe, std::size_t frames,
                                                      std::size_t large_copy) {
    const auto frame = probe.inner().frame(probe.motions());
    if (!frame) return std::nullopt;
    try {
        return measure(probe, *frame, frames, large_copy);
    } catch (const DeviceFailure&) {
        return std::nullopt;
    }
}

double share_of_same_copy(const OwnMemoryFigures& figures) {
    return ratio(figures.copy, figures.moving);
}

double share_of_large_copy(const OwnMemoryFigures& figures) {
    const double most = figures.copy_bytes_per_second * figures.moving.median;
    return most > 0 ? static_cast<double>(figures.bytes) / most : 0;
}

std::vector<std::string> own_memory_heading() {
    return {"moved in", "min…max", "MB", "GB/s", "copy GB/s", "of that", "large copy GB/s", "of that"};
}

std::vector<std::string> own_memory_cells(const OwnMemoryFigures& figures) {
    const auto gigabytes = [](double bytes_per_second) { return digits_text(1e-9 * bytes_per_second, 0); };
    return {duration_text(figures.moving.median),
            spread_text(figures.moving),
            digits_text(1e-6 * static_cast<double>(figures.bytes), 1),
            gigabytes(per_second(figures.bytes, figures.moving)),
            gigabytes(per_second(figures.bytes, figures.copy)),
            share_text(share_of_same_copy(figures)),
            gigabytes(figures.copy_bytes_per_second),
            share_text(share_of_large_copy(figures))};
}

nlohmann::ordered_json own_memory_json(const std::optional<OwnMemoryFigures>& figures) {
    if (!figures) return nullptr;
    return {{"seconds", json_of(figures->moving)},
            {"bytes", figures->bytes},
            {"copy_seconds", json_of(figures->copy)},
            {"large_copy_gigabytes_per_second", 1e-9 * figures->copy_bytes_per_second},
            {"share_of_copy", share_of_same_copy(*figures)},
            {"share_of_large_copy", share_of_large_copy(*figures)}};
}

} // namespace knead
