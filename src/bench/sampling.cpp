#include "bench/sampling.h"

#include "bench/made_cloud.h"
#include "bench/posing.h"
#include "io/cloud_file.h"
#include "shapes/random.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace knead {

namespace {

constexpr unsigned settle_limit = 600;

// Points that a task's pose sends somewhere, at rest and posed, in the coordinates of the file.
struct Field {
    std::vector<float> rest, posed;
    double diagonal = 0;
    bool at_rest = false;
};

std::vector<float> in_file_coordinates(const PointCloud& cloud, std::vector<float> positions) {
    for (std::size_t i = 0; i < positions.size(); ++i)
        positions[i] += static_cast<float>(cloud.origin[static_cast<Eigen::Index>(i % 3)]);
    return positions;
}

Field settled_field(const DeformationTask& task, const Settings& settings, Workers& workers,
                    Upsampler& upsampler, Progress& progress) {
    const auto document = open_task(task, settings, workers, upsampler);
    document->drag(whole_motion(task), task.name, progress);
    Field field;
    field.at_rest = settle(*document, settle_limit, progress).at_rest;
    field.rest = in_file_coordinates(task.cloud, task.cloud.positions);
    field.posed = in_file_coordinates(task.cloud, document->positions(progress));
    field.diagonal = document->bounds().diagonal();
    return field;
}

// One line of the table: a cloud beside its twin.
struct Pair {
    std::string shape, sampling;
    DeformationTask task, twin;
    std::size_t counted = 0;
    Strays strays = Strays::freeze; // of the cloud; its twin has none
    std::vector<std::optional<std::uint64_t>> samples{{}, 1000U};
};

constexpr std::size_t made_points = 10'000;
constexpr int denser = 20;

ShapeOptions even(std::uint64_t seed = 1, std::size_t points = made_points) {
    ShapeOptions options;
    options.points = points;
    options.seed = seed;
    return options;
}

// Denser and denser from end to end.
ShapeOptions graded() {
    ShapeOptions options = even();
    options.gradient = denser;
    return options;
}

// As many points on the surface as `even()`, so many spacings off it, and strays beside them.
ShapeOptions rough(double noise, double strays) {
    ShapeOptions options = even();
    options.points = static_cast<std::size_t>(std::ceil(made_points / (1 - strays)));
    options.noise = noise;
    options.outliers = strays;
    return options;
}

// The survey's tube made anew: as long and as wide, held by as much, sent the same way.
DeformationTask resampled(const DeformationTask& cylinder, Workers& workers, Progress& progress) {
    const Bounds bounds = bounds_of(cylinder.cloud);
    const Vec3d size = bounds.highest - bounds.lowest;
    const Vec3d middle = (bounds.highest + bounds.lowest) / 2;
    // A made tube is 1 × 1 × 5, and stretching it would stretch its sampling: three of them end to end are
    // cut off where the survey's ends.
    const PointCloud made = made_cloud(Shape::cylinder, cylinder.cloud.size(), workers, progress);
    const double made_length = 5 * size.x();
    std::vector<float> positions;
    for (const double shift : {-made_length, 0.0, made_length})
        for (std::size_t i = 0; i < made.size(); ++i) {
            const Vec3d place = made.file_position(i) * size.x() + Vec3d(0, 0, shift);
            if (std::abs(place.z()) > size.z() / 2) continue;
            const Vec3f kept = (place + middle).cast<float>();
            positions.insert(positions.end(), kept.begin(), kept.end());
        }
    DeformationTask task;
    task.name = cylinder.name;
    task.cloud = make_cloud(positions);
    task.pivot = cylinder.pivot;
    task.pose = cylinder.pose;
    double lower = bounds.lowest.z(), upper = bounds.highest.z();
    for (const Index i : cylinder.fixed) lower = std::max(lower, cylinder.cloud.file_position(i).z());
    for (const Index i : cylinder.handle) upper = std::min(upper, cylinder.cloud.file_position(i).z());
    for (Index i = 0; i < task.cloud.size(); ++i) {
        const double z = task.cloud.file_position(i).z();
        if (z <= lower) task.fixed.push_back(i);
        if (z >= upper) task.handle.push_back(i);
    }
    return task;
}

// The same with so many more points, evenly in its box, enlarged by a tenth of its diagonal all round: behind
// its own, and held by no handle.
DeformationTask with_dust(DeformationTask task, double fraction) {
    constexpr std::uint64_t purpose = 1;
    const std::size_t own = task.cloud.size();
    const Bounds bounds = bounds_of(task.cloud);
    const Vec3d margin = Vec3d::Constant(0.1 * bounds.diagonal());
    std::vector<float> positions = in_file_coordinates(task.cloud, task.cloud.positions);
    for (std::size_t i = 0; i < static_cast<std::size_t>(fraction * static_cast<double>(own)); ++i) {
        Random random(1, purpose, i);
        for (Eigen::Index axis = 0; axis < 3; ++axis)
            positions.push_back(static_cast<float>(
                random.between(bounds.lowest[axis] - margin[axis], bounds.highest[axis] + margin[axis])));
    }
    task.cloud = make_cloud(positions);
    return task;
}

// The dragon, whose coils lie close together, among strays.
void add_dusty_dragon(const DataFolders& scans, Progress& progress, std::vector<Pair>& pairs) {
    const auto path = find_data_file(scans, "dragon.ply");
    if (!path) return;
    const DeformationTask twin = bending_task("dragon", read_cloud(*path, progress), 60);
    const std::size_t points = twin.cloud.size();
    for (const auto& [words, strays] :
         {std::pair{"2 % strays", Strays::freeze}, {"2 % strays, bridged", Strays::bridge}})
        pairs.push_back({"dragon, bent 60°", words, with_dust(twin, 0.02), twin, points, strays, {1000U}});
}

// Some of a task's points.
DeformationTask task_of(const DeformationTask& task, const std::vector<Index>& points) {
    DeformationTask result = task;
    const std::vector<float> all = in_file_coordinates(task.cloud, task.cloud.positions);
    const auto holds = [](const std::vector<Index>& handle, Index i) {
        return std::ranges::binary_search(handle, i);
    };
    std::vector<float> positions;
    result.fixed.clear();
    result.handle.clear();
    for (Index k = 0; k < points.size(); ++k) {
        const float* at = &all[3 * std::size_t{points[k]}];
        positions.insert(positions.end(), at, at + 3);
        if (holds(task.fixed, points[k])) result.fixed.push_back(k);
        if (holds(task.handle, points[k])) result.handle.push_back(k);
    }
    result.cloud = make_cloud(positions);
    return result;
}

// One of so many points of a task, thrown at random, and behind them all others of the middle third along z,
// as if somebody had scanned that from near. The former count: no part more than another.
Pair with_denser_middle(const DeformationTask& task) {
    constexpr std::uint64_t purpose = 2;
    const Bounds bounds = bounds_of(task.cloud);
    std::vector<Index> points, others;
    for (Index i = 0; i < task.cloud.size(); ++i) {
        const double z =
            (task.cloud.file_position(i).z() - bounds.lowest.z()) / (bounds.highest.z() - bounds.lowest.z());
        if (Random(1, purpose, i).uniform() < 1.0 / denser)
            points.push_back(i);
        else if (z > 1.0 / 3 && z < 2.0 / 3)
            others.push_back(i);
    }
    Pair pair;
    pair.counted = points.size();
    points.insert(points.end(), others.begin(), others.end());
    pair.task = task_of(task, points);
    return pair;
}

std::vector<Pair> all_pairs(const DataFolders& survey, const DataFolders& scans, Workers& workers,
                            Progress& progress) {
    const auto task = [&](const char* name, const ShapeOptions& options) {
        return generated_task(name, options, workers, progress);
    };
    std::vector<Pair> pairs;
    if (const auto folder = survey_folder(survey)) {
        DeformationTask rings = read_survey_task(*folder, "cylinder");
        DeformationTask twin = resampled(rings, workers, progress);
        const std::size_t points = rings.cloud.size();
        pairs.push_back({"survey's cylinder", "in rings", std::move(rings), std::move(twin), points});
    }
    const std::pair<const char*, const char*> shapes[] = {{"made-cylinder", "tube, bent 120°"},
                                                          {"made-bar", "bar, twisted 135°"}};
    const struct {
        const char* words;
        ShapeOptions options;
        Strays strays = Strays::freeze;
    } samplings[] = {{"another seed", even(2)},
                     {"1 : 20 denser", graded()},
                     {"noise of ½ spacing", rough(0.5, 0)},
                     {"2 % strays", rough(0, 0.02)},
                     {"2 % strays, bridged", rough(0, 0.02), Strays::bridge},
                     {"noise and strays", rough(0.5, 0.02)},
                     {"both, bridged", rough(0.5, 0.02), Strays::bridge}};
    for (const auto& [name, words] : shapes)
        for (const auto& each : samplings)
            pairs.push_back(
                {words, each.words, task(name, each.options), task(name, even()), made_points, each.strays});
    for (const auto& [words, options] : {std::pair{"another seed", even(2)}, {"1 : 20 denser", graded()}})
        pairs.push_back({"solid bar, bent 120°", words, task("made-solid-bar", options),
                         task("made-solid-bar", even()), made_points});
    for (const auto& [name, words] : shapes) {
        pairs.push_back(with_denser_middle(task(name, even(1, denser * made_points))));
        pairs.back().shape = words;
        pairs.back().sampling = "middle 20 times denser";
        pairs.back().twin = task(name, even());
    }
    add_dusty_dragon(scans, progress, pairs);
    return pairs;
}

} // namespace

SamplingResult compare_samplings(const DeformationTask& task, std::size_t counted,
                                 const DeformationTask& twin, const std::optional<std::uint64_t>& samples,
                                 Strays strays, Workers& workers, Upsampler& upsampler, Progress& progress) {
    Settings settings = with_samples(samples);
    const Field b = settled_field(twin, settings, workers, upsampler, progress);
    settings.strays = strays;
    const Field a = settled_field(task, settings, workers, upsampler, progress);
    SamplingResult result;
    result.points = task.cloud.size();
    result.twin_points = twin.cloud.size();
    result.asked = samples;
    result.at_rest = a.at_rest && b.at_rest;
    // D is the twin's: strays make the other's box larger.
    result.deviation = field_deviation({a.rest, a.posed, counted}, {b.rest, b.posed, twin.cloud.size()},
                                       b.diagonal, workers);
    return result;
}

std::vector<SamplingResult> evaluate_sampling(const DataFolders& survey, const DataFolders& scans,
                                              Workers& workers, Upsampler& upsampler, Progress& progress) {
    std::vector<SamplingResult> results;
    for (const Pair& pair : all_pairs(survey, scans, workers, progress))
        for (const std::optional<std::uint64_t>& samples : pair.samples) {
            results.push_back(compare_samplings(pair.task, pair.counted, pair.twin, samples, pair.strays,
                                                workers, upsampler, progress));
            results.back().shape = pair.shape;
            results.back().sampling = pair.sampling;
        }
    return results;
}

} // namespace knead
