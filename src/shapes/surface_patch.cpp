#include "shapes/surface_patch.h"

#include "shapes/profile.h"
#include "shapes/purposes.h"
#include "shapes/random.h"
#include "shapes/staged_loop.h"

#include <algorithm>
#include <cmath>

namespace knead {

namespace {

struct Row {
    std::size_t first = 0; // among the patch's points
    std::size_t points = 0;
    double phase = 0; // where the row begins, in cells
};

// A patch's part of the points.
struct Part {
    Profile mass; // over u
    std::size_t first = 0;
    std::size_t points = 0;
};

std::vector<Part> share_points(const std::vector<SurfacePatch>& patches, std::size_t points) {
    std::vector<Part> parts;
    double whole = 0;
    for (const SurfacePatch& patch : patches) {
        const auto mass_at = [&](double u) { return patch.area(u) * patch.density(u); };
        parts.push_back({make_profile(patch.low, patch.high, mass_at), 0, 0});
        whole += parts.back().mass.whole();
    }
    double below = 0;
    std::size_t given = 0;
    for (Part& part : parts) {
        below += part.mass.whole();
        const auto end = static_cast<std::size_t>(std::round(static_cast<double>(points) * below / whole));
        part.first = given;
        part.points = std::min(end, points) - given;
        given += part.points;
    }
    parts.back().points += points - given;
    return parts;
}

std::vector<std::size_t> rows_of(const SurfacePatch& patch, const Part& part) {
    const double per_mass = static_cast<double>(part.points) / part.mass.whole();
    return cut_into_rows(part.points, [&](double fraction) {
        const double u = place_of(part.mass, fraction);
        return patch.width(u) * std::sqrt(per_mass * patch.density(u));
    });
}

void sample_row(const SurfacePatch& patch, const Part& part, const Row& row, const SamplingOptions& options,
                PointColumns& columns) {
    for (std::size_t i = 0; i < row.points; ++i) {
        const std::size_t at = part.first + row.first + i;
        Random random(options.seed, purpose_surface, at);
        const double along = jittered(static_cast<double>(i), random.uniform()) + row.phase;
        const double row_place = jittered(0, random.uniform()) * static_cast<double>(row.points);
        const double v = along / static_cast<double>(row.points);
        const double mass = (static_cast<double>(row.first) + row_place) / static_cast<double>(part.points);
        const SurfacePoint point = patch.point(place_of(part.mass, mass), v - std::floor(v));
        const double lift = options.noise > 0 ? options.noise * random.gaussian() : 0;
        put_point(columns, at, point.position + lift * point.normal, point.normal);
    }
}

} // namespace

void sample_patches(const std::vector<SurfacePatch>& patches, const SamplingOptions& options,
                    PointColumns& columns, Workers& workers, Progress& progress) {
    const std::vector<Part> parts = share_points(patches, options.points);
    for (std::size_t p = 0; p < patches.size(); ++p) {
        const Part& part = parts[p];
        if (part.points == 0) continue;
        const std::vector<std::size_t> first = rows_of(patches[p], part);
        const double share = static_cast<double>(part.points) / static_cast<double>(options.points);
        const double done = static_cast<double>(part.first) / static_cast<double>(options.points);
        staged_loop(workers, progress, {"making points", done, done + share}, first.size() - 1,
                    [&](std::size_t r) {
                        Row row{first[r], first[r + 1] - first[r], 0};
                        if (patches[p].closed)
                            row.phase = Random(options.seed, purpose_row, part.first + r).uniform();
                        sample_row(patches[p], part, row, options, columns);
                    });
    }
}

} // namespace knead
