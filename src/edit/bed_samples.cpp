#include "edit/bed_samples.h"

#include "graph/bridges.h"

#include <algorithm>
#include <limits>

namespace knead {

namespace {

constexpr double nearest_spacing = 0.0072; // of the cloud's size
constexpr double spacing_by_way = 0.15;

// Of very many points around a handle, so many are asked.
constexpr std::size_t enough_points = 4096;

struct Candidate {
    Vec3d position;
    double away = 0;   // from what is a sample already
    double wanted = 0; // as far as this, at the most
    Index vertex = 0;

    double lack() const { return away / wanted; }
};

// What lies around one handle.
struct Ground {
    std::vector<Candidate> points;
    Vec3d lowest = Vec3d::Constant(std::numeric_limits<double>::infinity());
    Vec3d highest = -lowest;
    std::size_t most_lacking = 0;

    void add(const Candidate& point) {
        points.push_back(point);
        lowest = lowest.cwiseMin(point.position);
        highest = highest.cwiseMax(point.position);
    }

    double lack() const { return points.empty() ? 0 : points[most_lacking].lack(); }

    void add_samples(std::span<const Vec3d> places) {
        for (const Vec3d& place : places)
            for (Candidate& point : points)
                point.away = std::min(point.away, (point.position - place).norm());
        const auto most = std::ranges::max_element(points, {}, &Candidate::lack);
        most_lacking = static_cast<std::size_t>(most - points.begin());
    }

    // Whether a sample there may make any point lack less.
    bool is_near(const Vec3d& place) const {
        const Vec3d outside = (lowest - place).cwiseMax(place - highest);
        return outside.maxCoeff() < (highest - lowest).maxCoeff();
    }
};

Ground ground_of(std::span<const SmallPatch> patches, std::span<const NearPatch> near,
                 const std::vector<Index>& base, std::span<const std::uint8_t> hanging,
                 std::span<const float> positions, double cloud_size) {
    Ground ground;
    std::vector<Vec3d> samples;
    const std::size_t stride = 1 + near.size() / enough_points;
    for (std::size_t k = 0; k < near.size(); ++k) {
        const Index vertex = near[k].vertex;
        const Vec3d place = point_at(positions, vertex);
        if (std::ranges::binary_search(base, vertex)) {
            samples.push_back(place);
        } else if (k % stride == 0 && !hangs(hanging, vertex)) {
            const double way = patches[near[k].patch].radius + near[k].distance;
            ground.add(
                {place, near[k].distance, nearest_spacing * cloud_size + spacing_by_way * way, vertex});
        }
    }
    ground.add_samples(samples);
    return ground;
}

} // namespace

std::vector<Index> bed_samples(std::span<const SmallPatch> patches, const Vicinities& near,
                               std::span<const Index> base, std::span<const std::uint8_t> hanging,
                               std::span<const float> positions, double cloud_size, std::size_t most) {
    std::vector<Index> chosen;
    if (patches.empty()) return chosen;
    std::vector<Index> ascending(base.begin(), base.end());
    std::ranges::sort(ascending);
    std::vector<Ground> grounds;
    for (const std::vector<NearPatch>& around : near)
        if (!around.empty())
            grounds.push_back(ground_of(patches, around, ascending, hanging, positions, cloud_size));
    while (chosen.size() < most && !grounds.empty()) {
        const Ground& poorest = *std::ranges::max_element(grounds, {}, &Ground::lack);
        if (!(poorest.lack() > 1)) break;
        const Candidate point = poorest.points[poorest.most_lacking];
        chosen.push_back(point.vertex);
        for (Ground& ground : grounds)
            if (ground.is_near(point.position)) ground.add_samples({&point.position, 1});
    }
    return chosen;
}

} // namespace knead
