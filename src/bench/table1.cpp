#include "bench/table1.h"

#include "base/error.h"
#include "base/large_pages.h"
#include "base/memory.h"
#include "base/stopwatch.h"
#include "bench/automatic_handles.h"
#include "bench/bare_pipeline.h"
#include "bench/made_cloud.h"
#include "bench/upsampler_probe.h"
#include "edit/handle_motion.h"
#include "edit/pipeline.h"
#include "io/cloud_file.h"
#include "upsample/devices.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace knead {

namespace {

constexpr std::size_t plane_points = 1'000'000;
constexpr std::size_t frames = 30;
constexpr std::size_t warm_up_frames = 3;
constexpr double bend_degrees = 30;

// Which of the paper's figures we compare with, from its Table 1.
constexpr FourFigures none{};
constexpr FourFigures at_5000{std::nullopt, 1000, 30, 8};
constexpr std::array<Table1Row, 7> rows_of_table{{
    {"bunny", "bunny.ply", 100, none, none},
    {"bunny", "bunny.ply", 1000, {0.5, 2.0, 0.019, 0.004}, none},
    {"armadillo", "armadillo_172974.ply", 200, none, none},
    {"armadillo", "armadillo_172974.ply", 5000, {3.2, 18.3, 0.098, 0.018}, at_5000},
    {"dragon",
     "dragon.ply",
     200,
     {390.2, 0.1, 0.002, 0.037},
     {300, std::nullopt, std::nullopt, std::nullopt}},
    {"dragon", "dragon.ply", 5000, {13.7, 23.3, 0.116, 0.040}, at_5000},
    {"plane", "", 200, {1923, 0.1, 0.002, 0.083}, none},
}};

// The two automatic handles as a pipeline takes them.
struct BendingPipelineInput {
    PipelineInput input;
    AutomaticHandles automatic;
};

BendingPipelineInput bending_input(const PointCloud& cloud, std::size_t samples) {
    BendingPipelineInput result{{}, automatic_handles(cloud)};
    const auto handle = [](const char* name, HandleRole role, const std::vector<Index>& points) {
        return Handle{name, role, shared_points(points)};
    };
    result.input.settings.samples = samples;
    result.input.handles = {handle("fixed", HandleRole::fixed, result.automatic.fixed),
                            handle("moving", HandleRole::moving, result.automatic.moving)};
    return result;
}

// How much memory was taken since it was made.
class MemoryTaken {
public:
    std::uint64_t held() const { return since(resident_memory()); }
    std::uint64_t peak() const { return since(peak_memory()); }

private:
    std::uint64_t since(std::uint64_t now) const { return is_known_ ? now - std::min(before_, now) : 0; }

    bool is_known_ = forget_peak_memory();
    std::uint64_t before_ = resident_memory();
};

// What a row holds without its pipeline having any part in it.
std::uint64_t bytes_beside_pipeline(const PointCloud& cloud, const PipelineInput& input) {
    std::uint64_t bytes = cloud.positions.size() * sizeof(float);
    for (const Handle& handle : input.handles) bytes += handle.points->size() * sizeof(Index);
    return bytes;
}

// The set-up, again and again from nothing. Leaves `pipeline` prepared, and `memory` from before any of that
// was there.
void measure_set_up(const PointCloud& cloud, const PipelineInput& input, std::size_t repeats,
                    UpsamplerProbe& probe, Workers& workers, Progress& progress,
                    std::unique_ptr<Pipeline>& pipeline, std::optional<MemoryTaken>& memory,
                    RowFigures& figures) {
    std::vector<double> order, neighbors, sampling, geodesic, set_up, factorize;
    for (std::size_t r = 0; r <= repeats; ++r) {
        pipeline.reset();
        const bool warms_up = r == 0;
        if (r == 1) { // the device is open by now; what it holds of points is counted, too
            probe.prepare({}, 0);
            memory.emplace();
        }
        pipeline = std::make_unique<Pipeline>(cloud, workers, probe);
        pipeline->prepare(input, progress);
        if (warms_up) continue;
        const StageSeconds& seconds = pipeline->seconds();
        order.push_back(seconds.order);
        neighbors.push_back(seconds.neighbors);
        sampling.push_back(seconds.sampling);
        geodesic.push_back(seconds.geodesic);
        set_up.push_back(seconds.order + seconds.neighbors + seconds.sampling + seconds.geodesic +
                         seconds.device);
        factorize.push_back(seconds.factorize);
    }
    figures.order = summarize(order);
    figures.neighbors = summarize(neighbors);
    figures.sampling = summarize(sampling);
    figures.geodesic = summarize(geodesic);
    figures.set_up = summarize(set_up);
    figures.factorize = summarize(factorize);
}

// Frames of a bend that grows, as a hand would drag it.
void measure_frames(const PointCloud& cloud, const BendingPipelineInput& bending, Pipeline& pipeline,
                    Progress& progress, RowFigures& figures) {
    std::vector<double> solve, upsample;
    SampleState state = pipeline.rest_state();
    Acceleration acceleration;
    std::vector<HandleMotion> motions(2);
    pipeline.follow_handles(motions, state);
    for (std::size_t f = 0; f < warm_up_frames + frames; ++f) {
        progress.step("bending", static_cast<double>(f) / (warm_up_frames + frames));
        const double degrees = bend_degrees * static_cast<double>(f + 1) / (warm_up_frames + frames);
        motions[1] =
            motion_of(bent_by(bending.automatic, degrees), bending.automatic.pivot, cloud.origin, motions[1]);
        forget(acceleration);
        Stopwatch clock;
        for (unsigned i = 0; i < bending.input.settings.iterations; ++i) {
            pipeline.iterate(motions, state, acceleration);
            const double seconds = clock.lap();
            if (f >= warm_up_frames) solve.push_back(seconds);
        }
        pipeline.upsample(motions, state);
        if (f >= warm_up_frames) upsample.push_back(clock.seconds());
    }
    figures.solve = summarize(solve);
    figures.upsample = summarize(upsample);
}

double largest_difference(std::span<const float> a, std::span<const float> b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, std::abs(double{a[i]} - double{b[i]}));
    return largest;
}

UpsampleFigures compare_upsamplers(UpsamplerProbe& probe, Workers& workers, Progress& progress) {
    const UpsampleInput& input = probe.input();
    const std::unique_ptr<Upsampler> reference = make_reference_upsampler(workers);
    reference->prepare(input, probe.motions().size());
    std::vector<float> moved[2], turned[2];
    std::vector<double> seconds[2];
    for (auto& positions : moved) resize_in_large_pages(positions, input.positions.size(), workers);
    for (auto& normals : turned) resize_in_large_pages(normals, input.normals.size(), workers);
    // In turns, so that what else the machine does meets both alike.
    for (std::size_t f = 0; f < warm_up_frames + frames; ++f) {
        progress.step("comparing with the reference", static_cast<double>(f) / (warm_up_frames + frames));
        for (const std::size_t which : {0, 1}) {
            Upsampler& upsampler = which == 0 ? probe.inner() : *reference;
            const Stopwatch clock;
            upsampler.run(probe.motions(), moved[which], turned[which], Held::nothing);
            if (f >= warm_up_frames) seconds[which].push_back(clock.seconds());
        }
    }
    UpsampleFigures figures;
    figures.device = summarize(seconds[0]);
    figures.reference = summarize(seconds[1]);
    figures.largest_difference =
        std::max(largest_difference(moved[0], moved[1]), largest_difference(turned[0], turned[1]));
    figures.bytes = bytes_a_frame(probe);
    figures.copy = copy_seconds(figures.bytes, frames, workers);
    figures.with_normals = !input.normals.empty();
    figures.own_memory = measure_in_own_memory(probe, frames);
    return figures;
}

void note_warning(Upsampler& upsampler, std::vector<std::string>& warnings) {
    const std::string words = upsampler.take_warning();
    if (!words.empty() && std::ranges::find(warnings, words) == warnings.end()) warnings.push_back(words);
}

RowFigures measure_with(UpsamplerProbe& probe, const PointCloud& cloud, std::size_t samples,
                        std::size_t repeats, Workers& workers, Progress& progress) {
    const BendingPipelineInput bending = bending_input(cloud, samples);
    RowFigures figures;
    std::unique_ptr<Pipeline> pipeline;
    std::optional<MemoryTaken> memory;
    measure_set_up(cloud, bending.input, repeats, probe, workers, progress, pipeline, memory, figures);
    figures.points = cloud.size();
    figures.vertices = pipeline->order().vertices();
    figures.samples = pipeline->samples().size();
    measure_frames(cloud, bending, *pipeline, progress, figures);
    if (memory && memory->peak() > 0) {
        figures.memory_held = memory->held() + bytes_beside_pipeline(cloud, bending.input);
        figures.memory_peak = memory->peak() + bytes_beside_pipeline(cloud, bending.input);
    }
    figures.upsampling = compare_upsamplers(probe, workers, progress);
    return figures;
}

UpsamplerProbe make_probe(const Table1Options& options, Workers& workers,
                          std::vector<std::string>& warnings) {
    UpsamplerChoice choice = make_upsampler(options.device, workers, options.threads);
    if (!choice.warning.empty() && std::ranges::find(warnings, choice.warning) == warnings.end())
        warnings.push_back(choice.warning);
    return UpsamplerProbe(std::move(choice.upsampler));
}

} // namespace

double share_of_copy(const UpsampleFigures& figures) {
    return ratio(figures.copy, figures.device);
}

double share_of_memory(const UpsampleFigures& figures, double copy_bytes_per_second) {
    const double most = copy_bytes_per_second * figures.device.median;
    return most > 0 ? static_cast<double>(figures.bytes) / most : 0;
}

std::span<const Table1Row> table1_rows() {
    return rows_of_table;
}

std::string name_of(const Table1Row& row) {
    return std::string(row.model) + "/" + std::to_string(row.samples);
}

std::vector<Table1Row> rows_named(std::span<const std::string> names) {
    const auto is_meant = [](const Table1Row& row, const std::string& name) {
        return name == row.model || name == name_of(row);
    };
    std::string known;
    for (const Table1Row& row : rows_of_table) known.append(known.empty() ? "" : ", ").append(name_of(row));
    for (const std::string& name : names) {
        if (std::ranges::any_of(rows_of_table, [&](const Table1Row& row) { return is_meant(row, name); }))
            continue;
        std::string words = "there is no row \"";
        words.append(name).append("\" in the table; there are ").append(known);
        throw Error(Trouble::usage, "", words.append(", and a model's name means all of its rows"));
    }
    std::vector<Table1Row> rows;
    for (const Table1Row& row : rows_of_table)
        if (names.empty() ||
            std::ranges::any_of(names, [&](const auto& name) { return is_meant(row, name); }))
            rows.push_back(row);
    return rows;
}

RowFigures measure_row(const PointCloud& cloud, std::size_t samples, const Table1Options& options,
                       Workers& workers, Progress& progress, std::vector<std::string>& warnings) {
    UpsamplerProbe probe = make_probe(options, workers, warnings);
    RowFigures figures = measure_with(probe, cloud, samples, options.repeats, workers, progress);
    note_warning(probe, warnings);
    return figures;
}

FourFigures factors_over_paper(const Table1Result& result) {
    const auto factor = [&](const std::optional<double>& paper, const Summary& ours) {
        const bool known = paper && result.missing.empty() && ours.median > 0;
        return known ? std::optional(*paper / ours.median) : std::nullopt;
    };
    const FourFigures& paper = result.row.paper;
    const RowFigures& ours = result.figures;
    return {factor(paper.set_up, ours.set_up), factor(paper.factorize, ours.factorize),
            factor(paper.solve, ours.solve), factor(paper.upsample, ours.upsample)};
}

Table1 measure_table1(std::span<const Table1Row> rows, const Table1Options& options, Progress& progress) {
    Table1 table;
    table.machine = this_machine();
    table.repeats = options.repeats;
    Workers workers(options.threads);
    table.threads = workers.threads();
    UpsamplerProbe probe = make_probe(options, workers, table.warnings);
    table.device = probe.device();
    progress.step("copying memory", 0);
    table.copy_bytes_per_second = memory_copy_rate(workers);

    PointCloud cloud;
    std::string_view model; // whose cloud that is
    for (const Table1Row& row : rows) {
        Table1Result result;
        result.row = row;
        const auto path = row.file.empty() ? std::nullopt : find_data_file(options.scans, row.file);
        if (!row.file.empty() && !path) {
            result.missing = missing_words(options.scans, row.file);
        } else {
            if (model != row.model)
                cloud = path ? read_cloud(*path, progress)
                             : made_cloud(Shape::plane, plane_points, workers, progress);
            model = row.model;
            result.figures = measure_with(probe, cloud, row.samples, options.repeats, workers, progress);
            note_warning(probe, table.warnings);
        }
        table.results.push_back(std::move(result));
    }
    return table;
}

} // namespace knead
