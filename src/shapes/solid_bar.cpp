#include "shapes/profile.h"
#include "shapes/purposes.h"
#include "shapes/random.h"
#include "shapes/simple_shapes.h"
#include "shapes/staged_loop.h"

#include <cmath>

namespace knead {

namespace {

struct Layer {
    std::size_t first = 0;
    std::size_t points = 0;
};

// The layer is a square grid of cells; a point's place across the layers is drawn by mass, as its row is.
void sample_layer(const Profile& mass, const Layer& layer, const SamplingOptions& options,
                  PointColumns& columns) {
    const double count = static_cast<double>(layer.points);
    const auto rows = static_cast<std::size_t>(std::max(1.0, std::round(std::sqrt(count))));
    for (std::size_t row = 0; row < rows; ++row) {
        const std::size_t begin = layer.points * row / rows;
        const std::size_t end = layer.points * (row + 1) / rows;
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t at = layer.first + i;
            Random random(options.seed, purpose_solid, at);
            const double in_row = static_cast<double>(end - begin);
            const double x = jittered(static_cast<double>(i - begin), random.uniform()) / in_row;
            const double y = (static_cast<double>(begin) + jittered(0, random.uniform()) * in_row) / count;
            const double below = static_cast<double>(layer.first) + jittered(0, random.uniform()) * count;
            const double z = place_of(mass, below / static_cast<double>(options.points));
            Vec3d place(x - half_width, y - half_width, z);
            if (options.noise > 0)
                for (double& coordinate : place) coordinate += options.noise * random.gaussian();
            put_point(columns, at, place, Vec3d::Zero());
        }
    }
}

} // namespace

void sample_solid_bar(double gradient, const SamplingOptions& options, PointColumns& columns,
                      Workers& workers, Progress& progress) {
    const auto density = [=](double z) {
        return gradient_density(gradient, (z + half_length) / (2 * half_length));
    };
    const Profile mass = make_profile(-half_length, half_length, density);
    const double per_mass = static_cast<double>(options.points) / mass.whole();
    const std::vector<std::size_t> first = cut_into_rows(options.points, [&](double fraction) {
        const double per_length = std::cbrt(per_mass * density(place_of(mass, fraction)));
        return per_length * per_length;
    });
    staged_loop(workers, progress, {"making points"}, first.size() - 1, [&](std::size_t l) {
        sample_layer(mass, {first[l], first[l + 1] - first[l]}, options, columns);
    });
}

} // namespace knead
