#include "bench/scan_samples.h"

#include "bench/deviation.h"
#include "bench/posing.h"
#include "io/cloud_file.h"

namespace knead {

namespace {

constexpr double bend_degrees = 60;
constexpr unsigned settle_limit = 300;
constexpr NamedScan scans[] = {
    {"bunny", "bunny.ply"},     {"armadillo", "armadillo_172974.ply"}, {"dragon", "dragon.ply"},
    {"horse", "horse_48k.ply"}, {"lidar", "lidar_lone_star_519k.ply"}, {"room", "open3d_fragment_196k.ply"}};
constexpr std::size_t of_the_paper = 3;
constexpr std::uint64_t sample_counts[] = {10'000, 5000, 1000, 200, 100, 50};

// The settled shape, in the order of computation, which depends on the cloud alone.
std::vector<float> settled(const DeformationTask& task, ScanSampleCount& count, double& diagonal,
                           Workers& workers, Upsampler& upsampler, Progress& progress) {
    const auto document = open_task(task, with_samples(count.asked), workers, upsampler);
    document->drag(whole_motion(task), task.name, progress);
    const Settling settling = settle(*document, settle_limit, progress);
    const LineArray<float>& shape = document->shape(progress).positions;
    std::vector<float> positions(shape.begin(), shape.end());
    count.samples = document->pipeline().samples().size();
    count.iterations = settling.iterations;
    count.at_rest = settling.at_rest;
    count.noise = link_noise(document->pipeline(), positions);
    diagonal = document->bounds().diagonal();
    return positions;
}

} // namespace

std::span<const NamedScan> scans_of_the_paper() {
    return std::span(scans).first(of_the_paper);
}

std::span<const NamedScan> scans_to_sample() {
    return scans;
}

ScanSamples evaluate_scan_samples(const DeformationTask& task, std::span<const std::uint64_t> counts,
                                  Workers& workers, Upsampler& upsampler, Progress& progress) {
    ScanSamples result;
    result.name = task.name;
    result.points = task.cloud.size();
    double diagonal = 0;
    ScanSampleCount full;
    if (task.cloud.size() > full_samples) full.asked = full_samples;
    const std::vector<float> all = settled(task, full, diagonal, workers, upsampler, progress);
    result.counts.push_back(full);
    for (const std::uint64_t asked : counts) {
        if (asked >= full.samples) continue;
        ScanSampleCount count;
        count.asked = asked;
        const std::vector<float> few = settled(task, count, diagonal, workers, upsampler, progress);
        const Deviation deviation = deviation_between(few, all, diagonal);
        count.rms = deviation.rms;
        count.largest = deviation.largest;
        result.counts.push_back(count);
    }
    return result;
}

ScanSamples evaluate_scan_samples(const NamedScan& scan, const DataFolders& folders, Workers& workers,
                                  Upsampler& upsampler, Progress& progress) {
    const auto path = find_data_file(folders, scan.file);
    if (!path) {
        ScanSamples result;
        result.name = scan.name;
        result.missing = missing_words(folders, scan.file);
        return result;
    }
    const DeformationTask task = bending_task(scan.name, read_cloud(*path, progress), bend_degrees);
    return evaluate_scan_samples(task, sample_counts, workers, upsampler, progress);
}

} // namespace knead
