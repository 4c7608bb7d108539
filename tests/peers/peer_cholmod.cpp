// knead's factors beside CHOLMOD's, on the two matrices of a handle set, in turns in one run. Prints a table.

#include "base/stopwatch.h"
#include "bench/data_files.h"
#include "bench/machine.h"
#include "bench/made_cloud.h"
#include "bench/posing.h"
#include "bench/report.h"
#include "bench/statistics.h"
#include "io/cloud_file.h"
#include "peers/cholmod_factor.h"
#include "upsample/upsample.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

// OpenBLAS's own; its header would bring all of BLAS.
extern "C" void openblas_set_num_threads(int threads);

namespace {

using namespace knead;
using namespace knead::peers;

constexpr std::size_t plane_points = 1'000'000;
constexpr const char* plane_name = "plane";

struct Arguments {
    std::vector<std::string> clouds{"dragon", plane_name};
    std::vector<std::uint64_t> samples{5000, 20'000, 100'000};
    std::size_t repeats = 9;
};

enum Step : std::size_t { order, factorize_rotations, factorize_positions, solve_rotations, solve_positions };
constexpr std::size_t step_count = 5;
constexpr std::size_t rotation_columns = 4, position_columns = 3;

// Seconds of every repeat, and the solutions of the last.
struct Figures {
    std::string name;
    std::array<std::vector<double>, step_count> seconds;
    std::vector<double> rotations, positions;

    double median(Step step) const { return summarize(seconds[step]).median; }
};

std::vector<double> right_hand_sides(const SparseMatrix& matrix, std::size_t columns) {
    std::vector<double> values(columns * static_cast<std::size_t>(matrix.size()));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(static_cast<double>(i));
    return values;
}

// Of the second of two solves: the first one's memory is new.
template<typename Solve>
double solve_seconds(const SparseMatrix& matrix, std::size_t columns, std::vector<double>& solution,
                     Solve&& solve) {
    solution = right_hand_sides(matrix, columns);
    solve(solution);
    solution = right_hand_sides(matrix, columns);
    const Stopwatch clock;
    solve(solution);
    return clock.seconds();
}

void run_knead(const SystemMatrices& matrices, Figures& figures) {
    SparseFactor rotations, positions;
    Stopwatch clock;
    const std::vector<int> ordering = minimum_degree_order(matrices.rotations);
    figures.seconds[order].push_back(clock.lap());
    const bool rotations_good = rotations.factorize(matrices.rotations, ordering).solved;
    figures.seconds[factorize_rotations].push_back(clock.lap());
    const bool positions_good = positions.factorize(matrices.positions, ordering).solved;
    figures.seconds[factorize_positions].push_back(clock.lap());
    if (!rotations_good || !positions_good)
        throw Error(Trouble::numeric, "", "knead cannot factorise the systems");
    figures.seconds[solve_rotations].push_back(
        solve_seconds(matrices.rotations, rotation_columns, figures.rotations,
                      [&](std::vector<double>& values) { rotations.solve(values, rotation_columns); }));
    figures.seconds[solve_positions].push_back(
        solve_seconds(matrices.positions, position_columns, figures.positions,
                      [&](std::vector<double>& values) { positions.solve(values, position_columns); }));
}

void run_cholmod(const SystemMatrices& matrices, CholmodSystem& system, Figures& figures) {
    Stopwatch clock;
    system.analyze(matrices.rotations);
    figures.seconds[order].push_back(clock.lap());
    system.factorize(0, matrices.rotations);
    figures.seconds[factorize_rotations].push_back(clock.lap());
    system.factorize(1, matrices.positions);
    figures.seconds[factorize_positions].push_back(clock.lap());
    figures.seconds[solve_rotations].push_back(
        solve_seconds(matrices.rotations, rotation_columns, figures.rotations,
                      [&](std::vector<double>& values) { system.solve(0, values, rotation_columns); }));
    figures.seconds[solve_positions].push_back(
        solve_seconds(matrices.positions, position_columns, figures.positions,
                      [&](std::vector<double>& values) { system.solve(1, values, position_columns); }));
}

// Over the largest of the first.
double largest_difference(std::span<const double> a, std::span<const double> b) {
    double largest = 0, apart = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, std::abs(a[i]));
        apart = std::max(apart, std::abs(a[i] - b[i]));
    }
    return largest > 0 ? apart / largest : apart;
}

DeformationTask task_named(const std::string& name, Workers& workers) {
    SilentProgress progress;
    if (name == plane_name)
        return bending_task(name, made_cloud(Shape::plane, plane_points, workers, progress), 0);
    const DataFolders folders = scan_folders("");
    const auto path = find_data_file(folders, name + ".ply");
    if (!path) throw Error(Trouble::input, "", missing_words(folders, name + ".ply"));
    return bending_task(name, read_cloud(*path, progress), 0);
}

SystemMatrices matrices_of(const DeformationTask& task, std::uint64_t samples, Workers& workers) {
    SilentProgress progress;
    const std::unique_ptr<Upsampler> upsampler = make_reference_upsampler(workers);
    const auto document = open_task(task, with_samples(samples), workers, *upsampler);
    document->prepare_ahead(progress);
    return system_matrices(document->pipeline().system());
}

// The first is knead's, the others CHOLMOD's.
std::vector<Figures> measure(const SystemMatrices& matrices, std::size_t repeats) {
    const CholmodKind kinds[] = {CholmodKind::automatic, CholmodKind::simplicial, CholmodKind::supernodal};
    std::vector<Figures> all(1 + std::size(kinds));
    for (std::size_t r = 0; r <= repeats; ++r) {
        if (r == 1) // the first was to warm up
            for (Figures& figures : all)
                for (auto& seconds : figures.seconds) seconds.clear();
        run_knead(matrices, all[0]);
        all[0].name = "knead";
        for (std::size_t k = 0; k < std::size(kinds); ++k) {
            CholmodSystem system(kinds[k]);
            run_cholmod(matrices, system, all[1 + k]);
            all[1 + k].name = kinds[k] == CholmodKind::automatic
                                  ? std::string("CHOLMOD, its choice: ") +
                                        (system.is_supernodal() ? "supernodal" : "simplicial")
                              : kinds[k] == CholmodKind::simplicial ? "CHOLMOD, simplicial"
                                                                    : "CHOLMOD, supernodal";
        }
    }
    return all;
}

void add_figures(const std::vector<Figures>& all, TextTable& table) {
    const auto set_up = [](const Figures& figures) {
        return figures.median(order) + figures.median(factorize_rotations) +
               figures.median(factorize_positions);
    };
    const auto solve = [](const Figures& figures) {
        return figures.median(solve_rotations) + figures.median(solve_positions);
    };
    for (const Figures& figures : all) {
        std::vector<std::string> line{figures.name};
        for (std::size_t step = 0; step < step_count; ++step)
            line.push_back(duration_text(figures.median(static_cast<Step>(step))));
        if (&figures != &all[0]) {
            line.push_back(digits_text(set_up(all[0]) / set_up(figures), 2));
            line.push_back(digits_text(solve(all[0]) / solve(figures), 2));
            line.push_back(power_text(std::max(largest_difference(all[0].rotations, figures.rotations),
                                               largest_difference(all[0].positions, figures.positions))));
        }
        table.push_back(line);
    }
}

void run(const Arguments& arguments) {
    openblas_set_num_threads(1);
    Workers workers;
    TextTable table{
        {machine_text(this_machine())},
        {"CHOLMOD " + CholmodSystem(CholmodKind::automatic).version() +
         " and knead in turns, one thread and one OpenBLAS; medians of " + std::to_string(arguments.repeats) +
         " after a warm-up."},
        {"One ordering for both matrices (CHOLMOD's with its symbolic analysis), 4 right-hand sides for "
         "rotations, 3 for positions."},
        {"knead over CHOLMOD: below 1 knead is faster. Apart: the solutions, over the largest."},
        {""},
        {"", "order", "factor r", "factor p", "solve 4 r", "solve 3 p", "set-up ÷", "solve ÷", "apart"}};
    for (const std::string& name : arguments.clouds) {
        const DeformationTask task = task_named(name, workers);
        for (const std::uint64_t samples : arguments.samples) {
            std::cerr << name << ", " << samples << " samples ...\n";
            const SystemMatrices matrices = matrices_of(task, samples, workers);
            table.push_back({""});
            table.push_back({name + ", " + count_text(samples) + " samples asked: " +
                             count_text(static_cast<std::size_t>(matrices.rotations.size())) + " unknowns, " +
                             count_text(matrices.rotations.value.size()) + " entries"});
            add_figures(measure(matrices, arguments.repeats), table);
        }
    }
    std::cout << format_table(table);
}

} // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app{"knead's sparse factors and CHOLMOD's, side by side.", "peer_cholmod"};
    app.add_option(
        "clouds", arguments.clouds,
        "Scans without .ply (of KNEAD_SCANS), or \"plane\", which is made (default: dragon plane)");
    app.add_option("--samples", arguments.samples, "How many samples (default: 5000 20000 100000)")
        ->check(CLI::Range(2, 10'000'000));
    app.add_option("--repeats", arguments.repeats, "Of everything, beside a warm-up (default: 9)")
        ->check(CLI::Range(1, 1000));
    CLI11_PARSE(app, argc, argv);
    try {
        run(arguments);
    } catch (const Error& error) {
        std::cerr << "peer_cholmod: " << error.what() << "\n";
        return static_cast<int>(error.trouble());
    }
    return 0;
}
