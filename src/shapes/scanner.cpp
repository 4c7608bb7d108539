#include "shapes/scanner.h"

#include "base/require.h"
#include "shapes/depth_image.h"
#include "shapes/profile.h"
#include "shapes/purposes.h"
#include "shapes/random.h"
#include "shapes/staged_loop.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace knead {

namespace {

enum Kind : std::size_t { on_surface, behind_silhouette, in_the_air, kinds };
using Counts = std::array<std::size_t, kinds>;

// Takes `chosen` of `all` candidates: one from each of `chosen` nearly equal bins, at random in the bin.
struct EvenChoice {
    std::size_t all = 0;
    std::size_t chosen = 0;
    std::uint64_t seed = 1;
    std::uint64_t kind = 0;

    std::size_t bin_begin(std::size_t bin) const {
        return bin * (all / chosen) + bin * (all % chosen) / chosen; // bin · all / chosen without overflow
    }

    std::size_t taken_from(std::size_t bin) const {
        const std::size_t begin = bin_begin(bin);
        const auto width = static_cast<double>(bin_begin(bin + 1) - begin);
        const double place = Random(seed, purpose_choice + kind, bin).uniform();
        return begin + static_cast<std::size_t>(place * width);
    }

    // How many of the first `candidates` are taken.
    std::size_t taken_below(std::size_t candidates) const {
        if (candidates >= all) return chosen;
        const double share = static_cast<double>(candidates) / static_cast<double>(all);
        auto bin = std::min(chosen, static_cast<std::size_t>(share * static_cast<double>(chosen)));
        while (bin > 0 && taken_from(bin - 1) >= candidates) --bin;
        while (bin < chosen && taken_from(bin) < candidates) ++bin;
        return bin;
    }
};

// A walk through the candidates of one kind, in their order.
struct ChoiceWalk {
    EvenChoice choice;
    std::size_t seen = 0;  // candidates so far
    std::size_t taken = 0; // of them
    std::size_t next = 0;  // the candidate that is taken next

    ChoiceWalk() = default;
    ChoiceWalk(const EvenChoice& from, std::size_t start)
        : choice(from), seen(start), taken(from.taken_below(start)) {
        find_next();
    }

    // Whether the candidate at hand is taken; goes on to the one after it.
    bool takes() {
        if (seen++ != next || taken == choice.chosen) return false;
        ++taken;
        find_next();
        return true;
    }

private:
    void find_next() {
        if (taken < choice.chosen) next = choice.taken_from(taken);
    }
};

struct Scan {
    std::vector<DepthImage> images;     // one a viewpoint
    std::vector<Counts> before;         // of candidates before each row of all images, and of all at the end
    std::vector<std::size_t> first_row; // of each image

    const Counts& totals() const { return before.back(); }
};

// What the ray in the given column is a candidate for; `kinds` for a return that got lost.
Kind kind_of(const DepthImage& image, std::size_t row, std::size_t column) {
    const float depth = image.at(row, column);
    if (depth > 0) return on_surface;
    if (depth < 0) return kinds;
    return image.neighbour_depth(row, column) > 0 ? behind_silhouette : in_the_air;
}

void count_candidates(Scan& scan, Workers& workers) {
    std::size_t rows = 0;
    for (const DepthImage& image : scan.images) {
        scan.first_row.push_back(rows);
        rows += image.view.rows;
    }
    scan.before.assign(rows + 1, Counts{});
    for (std::size_t look = 0; look < scan.images.size(); ++look) {
        const DepthImage& image = scan.images[look];
        workers.for_each(image.view.rows, 16, [&](std::size_t row) {
            Counts& counts = scan.before[scan.first_row[look] + row + 1];
            for (std::size_t column = 0; column < image.view.columns; ++column)
                if (const Kind kind = kind_of(image, row, column); kind != kinds) ++counts[kind];
        });
    }
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t kind = 0; kind < kinds; ++kind) scan.before[row + 1][kind] += scan.before[row][kind];
}

Scan shoot(const ScannedBody& body, const std::vector<Viewpoint>& viewpoints, const ScanOptions& options,
           double rays, Workers& workers, Progress& progress) {
    Scan scan;
    double solid_angle = 0;
    for (const Viewpoint& viewpoint : viewpoints) solid_angle += view_of(body, viewpoint, 1).size;
    const double pixel = std::sqrt(solid_angle / rays);
    const double share = 1 / static_cast<double>(viewpoints.size());
    for (std::size_t look = 0; look < viewpoints.size(); ++look) {
        const StagePart part{"scanning", static_cast<double>(look) * share,
                             static_cast<double>(look + 1) * share};
        const TraceOptions trace{mix_bits(options.seed + look), options.gradient};
        scan.images.push_back(
            trace_image(body, view_of(body, viewpoints[look], pixel), trace, part, workers, progress));
    }
    count_candidates(scan, workers);
    return scan;
}

bool suffices(const Counts& found, const ScanOptions& options) {
    return found[on_surface] >= options.points - options.strays &&
           found[behind_silhouette] + found[in_the_air] >= options.strays;
}

// A first scan with few rays tells how many give a return, the real one then has enough.
Scan shoot_enough(const ScannedBody& body, const std::vector<Viewpoint>& viewpoints,
                  const ScanOptions& options, Workers& workers, Progress& progress) {
    constexpr double fewest_rays = 50000;
    Scan scan = shoot(body, viewpoints, options, fewest_rays, workers, progress);
    double rays = fewest_rays;
    for (double surplus = 1.03; !suffices(scan.totals(), options); surplus *= 1.05) {
        const Counts& found = scan.totals();
        require(found[on_surface] > 0 && found[in_the_air] > 0, "a scan that meets the body and the air");
        const double wanted = static_cast<double>(options.points - options.strays);
        const double more = std::max(wanted / static_cast<double>(found[on_surface]),
                                     static_cast<double>(options.strays) /
                                         static_cast<double>(found[behind_silhouette] + found[in_the_air]));
        rays *= std::max(1.02, surplus * more);
        scan = Scan{}; // gives its memory back first
        scan = shoot(body, viewpoints, options, rays, workers, progress);
    }
    return scan;
}

struct Return {
    Vec3d place;
    Vec3d normal;
    Colour colour;
};

Return surface_return(const ScannedBody& body, const ScanOptions& options, const ScanRay& ray, double depth,
                      Random& random) {
    const Vec3d place = ray.at(depth);
    Vec3d normal = field_normal(body.distance, place);
    Return found{place, normal, body.colour(place, normal)};
    if (options.noise > 0) found.place += options.noise * random.gaussian() * ray.direction.normalized();
    if (options.normal_noise > 0) {
        for (double& coordinate : normal) coordinate += options.normal_noise * random.gaussian();
        found.normal = normal.normalized();
    }
    return found;
}

// Beams that an edge splits come back from between it and what is far behind; dust comes from anywhere.
Return stray_return(const ScannedBody& body, const ScanRay& ray, double edge_depth, Random& random) {
    const Vec3d middle = 0.5 * (body.lowest + body.highest);
    const double reach = 0.5 * (body.highest - body.lowest).norm();
    const double to_middle = (middle - ray.eye).dot(ray.direction) / ray.direction.squaredNorm();
    const double length = ray.direction.norm();
    const double depth = edge_depth > 0 ? edge_depth + 0.15 * reach * random.uniform() / length
                                        : to_middle + reach * random.between(-0.5, 0.5) / length;
    const auto grey = static_cast<std::uint8_t>(random.between(90, 200));
    const Vec3d normal = (0.3 * random.direction() - ray.direction.normalized()).normalized();
    return {ray.at(depth), normal, {grey, grey, grey}};
}

void emit_row(const ScannedBody& body, const Scan& scan, std::size_t look, std::size_t row,
              const std::array<EvenChoice, kinds>& choices, const ScanOptions& options,
              PointColumns& columns) {
    const DepthImage& image = scan.images[look];
    std::array<ChoiceWalk, kinds> walks;
    std::size_t next = 0;
    for (std::size_t kind = 0; kind < kinds; ++kind) {
        walks[kind] = ChoiceWalk(choices[kind], scan.before[scan.first_row[look] + row][kind]);
        next += walks[kind].taken;
    }
    for (std::size_t column = 0; column < image.view.columns; ++column) {
        const Kind kind = kind_of(image, row, column);
        if (kind == kinds || !walks[kind].takes()) continue;
        Random random(image.seed, purpose_echo, row * image.view.columns + column);
        const ScanRay ray = ray_of(image.view, image.seed, row, column);
        const double depth = static_cast<double>(image.at(row, column));
        const double edge = kind == behind_silhouette ? image.neighbour_depth(row, column) : 0;
        const Return found = kind == on_surface ? surface_return(body, options, ray, depth, random)
                                                : stray_return(body, ray, edge, random);
        put_point(columns, next++, found.place, found.normal, found.colour);
    }
}

} // namespace

PointCloud scan(const ScannedBody& body, const std::vector<Viewpoint>& viewpoints, const ScanOptions& options,
                Workers& workers, Progress& progress) {
    require(options.points > options.strays, "a scan needs a point that is no stray");
    const Scan scan = shoot_enough(body, viewpoints, options, workers, progress);
    const Counts& found = scan.totals();
    const std::size_t fewest_flying = options.strays - std::min(options.strays, found[in_the_air]);
    const std::size_t flying = std::clamp(options.strays / 2, fewest_flying, found[behind_silhouette]);
    const Counts wanted{options.points - options.strays, flying, options.strays - flying};
    std::array<EvenChoice, kinds> choices;
    for (std::size_t kind = 0; kind < kinds; ++kind)
        choices[kind] = {found[kind], wanted[kind], options.seed, kind};

    PointColumns columns = make_columns(options.points, WithNormals::yes, WithColours::yes);
    const double share = 1 / static_cast<double>(scan.images.size());
    for (std::size_t look = 0; look < scan.images.size(); ++look) {
        const StagePart part{"making points", static_cast<double>(look) * share,
                             static_cast<double>(look + 1) * share};
        staged_loop(workers, progress, part, scan.images[look].view.rows,
                    [&](std::size_t row) { emit_row(body, scan, look, row, choices, options, columns); });
    }
    return finish(std::move(columns));
}

Vec3d field_normal(const std::function<double(const Vec3d&)>& distance, const Vec3d& place) {
    constexpr double step = 1e-4;
    Vec3d gradient = Vec3d::Zero();
    for (const Vec3d& corner : {Vec3d(1, -1, -1), Vec3d(-1, -1, 1), Vec3d(-1, 1, -1), Vec3d(1, 1, 1)})
        gradient += distance(place + step * corner) * corner;
    return gradient.normalized();
}

} // namespace knead
