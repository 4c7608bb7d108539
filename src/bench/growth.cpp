#include "bench/growth.h"

#include "bench/made_cloud.h"
#include "upsample/devices.h"

#include <algorithm>
#include <cmath>

namespace knead {

namespace {

constexpr std::size_t fewest_points = 10'000;
constexpr std::size_t samples_by_points = 1000;
constexpr std::size_t points_by_samples = 1'000'000;
constexpr std::size_t fewest_samples = 100, most_samples = 100'000;

// first, 3 first, 10 first, 30 first … up to `last`.
std::vector<std::size_t> sizes(std::size_t first, std::size_t last) {
    std::vector<std::size_t> result;
    for (std::size_t decade = first; decade <= last; decade *= 10)
        for (const std::size_t size : {decade, 3 * decade})
            if (size <= last) result.push_back(size);
    return result;
}

// The plane as a file with positions and colours has it.
PointCloud colored_plane(std::size_t points, Workers& workers, Progress& progress) {
    PointCloud cloud = make_cloud(made_cloud(Shape::plane, points, workers, progress).positions);
    const std::vector<std::uint8_t> gray(points, 128);
    for (const char* color : {"red", "green", "blue"}) add_attribute(cloud, color, gray);
    return cloud;
}

} // namespace

std::span<const Stage> growth_stages() {
    static constexpr std::array<Stage, 8> stages{{{"order", &RowFigures::order},
                                                  {"neighbors", &RowFigures::neighbors},
                                                  {"sampling", &RowFigures::sampling},
                                                  {"geodesic", &RowFigures::geodesic},
                                                  {"set-up", &RowFigures::set_up},
                                                  {"factorize", &RowFigures::factorize},
                                                  {"solve", &RowFigures::solve},
                                                  {"upsample", &RowFigures::upsample}}};
    return stages;
}

Growth measure_growth(std::size_t most_points, const Table1Options& options, Progress& progress) {
    Growth growth;
    growth.machine = this_machine();
    Workers workers(options.threads);
    growth.threads = workers.threads();
    growth.device = make_upsampler(options.device, workers, options.threads).upsampler->device();
    progress.step("copying memory", 0);
    growth.copy_bytes_per_second = memory_copy_rate(workers);
    const auto measure = [&](const PointCloud& cloud, std::size_t samples) {
        return measure_row(cloud, samples, options, workers, progress, growth.warnings);
    };
    for (const std::size_t points : sizes(fewest_points, most_points))
        growth.by_points.push_back(measure(colored_plane(points, workers, progress), samples_by_points));
    const PointCloud cloud = colored_plane(std::min(points_by_samples, most_points), workers, progress);
    for (const std::size_t samples : sizes(fewest_samples, std::min(most_samples, cloud.size() / 10)))
        growth.by_samples.push_back(measure(cloud, samples));
    return growth;
}

std::optional<double> fitted_exponent(std::span<const RowFigures> rows, std::size_t RowFigures::*size,
                                      const Stage& stage) {
    double count = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const RowFigures& row : rows) {
        const double seconds = (row.*stage.seconds).median;
        if (!(seconds > 0) || row.*size == 0) continue;
        const double along = std::log(static_cast<double>(row.*size)), up = std::log(seconds);
        count += 1, x += along, y += up, xx += along * along, xy += along * up;
    }
    const double spread = count * xx - x * x;
    if (count < 2 || spread <= 1e-9) return std::nullopt;
    return (count * xy - x * y) / spread;
}

} // namespace knead
