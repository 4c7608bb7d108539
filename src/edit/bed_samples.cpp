#include "edit/bed_samples.h"

#include "graph/bridges.h"

#include <algorithm>
#include <limits>

namespace knead {

namespace {

constexpr double nearest_spacing = 0.0072; // of the cloud's size
constexpr double spacing_by_way = 0.15;

// A patch with so many samples around it wants no more.
constexpr std::size_t enough_samples = 256;

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
    double farthest = 0; // the largest `away`

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
        farthest = 0;
        for (const Candidate& point : points) farthest = std::max(farthest, point.away);
    }

    // Whether a sample there may be nearer to any point than all others.
    bool is_near(const Vec3d& place) const {
        const Vec3d outside = (lowest - place).cwiseMax(place - highest).cwiseMax(0);
        return outside.norm() < farthest;
    }
};

// What lies around a handle with so many small patches.
Ground ground_of(std::span<const SmallPatch> patches, std::span<const NearPatch> near,
                 std::span<const std::uint8_t> hanging, std::span<const float> positions, double cloud_size) {
    Ground ground;
    std::vector<Vec3d> samples;
    std::vector<Index> of;
    for (const NearPatch& each : near) {
        of.push_back(each.patch);
        const Vec3d place = point_at(positions, each.vertex);
        if (each.is_sample) {
            samples.push_back(place);
        } else if (!hangs(hanging, each.vertex)) {
            const double way = patches[each.patch].radius + each.distance;
            ground.add(
                {place, each.distance, nearest_spacing * cloud_size + spacing_by_way * way, each.vertex});
        }
    }
    std::ranges::sort(of);
    const auto count = static_cast<std::size_t>(std::unique(of.begin(), of.end()) - of.begin());
    if (samples.size() > enough_samples * count) return {};
    ground.add_samples(samples);
    return ground;
}

} // namespace

std::vector<Index> bed_samples(std::span<const SmallPatch> patches, const Vicinities& near,
                               std::span<const std::uint8_t> hanging, std::span<const float> positions,
                               double cloud_size, std::size_t most) {
    std::vector<Index> chosen;
    std::vector<Ground> grounds;
    for (const std::vector<NearPatch>& around : near)
        if (most > 0 && !around.empty())
            grounds.push_back(ground_of(patches, around, hanging, positions, cloud_size));
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
