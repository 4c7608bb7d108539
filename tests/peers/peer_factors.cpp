// knead's factors beside CHOLMOD's and SuperLU's, on the two matrices of a handle set, in turns in one run.
// Prints a table.

#include "base/counts.h"
#include "base/stopwatch.h"
#include "bench/data_files.h"
#include "bench/machine.h"
#include "bench/made_cloud.h"
#include "bench/posing.h"
#include "bench/report.h"
#include "bench/statistics.h"
#include "io/cloud_file.h"
#include "peers/cholmod_factor.h"
#include "peers/superlu_factor.h"
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

// Where the numbers of a right-hand side stand: one after the other, or beside those of the others row by
// row.
enum class Layout { columns, rows };

std::vector<double> right_hand_sides(const SparseMatrix& matrix, std::size_t columns, Layout layout) {
    const auto size = static_cast<std::size_t>(matrix.size());
    std::vector<double> values(columns * size);
    for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t i = 0; i < size; ++i)
            values[layout == Layout::rows ? i * columns + c : c * size + i] =
                std::sin(static_cast<double>(c * size + i));
    return values;
}

// The same solution column by column.
std::vector<double> by_columns(const std::vector<double>& values, std::size_t columns, Layout layout) {
    if (layout == Layout::columns) return values;
    const std::size_t size = values.size() / columns;
    std::vector<double> result(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) result[i % columns * size + i / columns] = values[i];
    return result;
}

// All steps of one solver: order(), factorize(which, matrix), solve(which, values, columns), the rotations'
// system being number 0.
template<typename Order, typename Factorize, typename Solve>
void run_solver(const SystemMatrices& matrices, Layout layout, Figures& figures, Order&& find_order,
                Factorize&& factorize, Solve&& solve) {
    Stopwatch clock;
    find_order();
    figures.seconds[order].push_back(clock.lap());
    factorize(0, matrices.rotations);
    figures.seconds[factorize_rotations].push_back(clock.lap());
    factorize(1, matrices.positions);
    figures.seconds[factorize_positions].push_back(clock.lap());
    const auto timed = [&](std::size_t which, const SparseMatrix& matrix, std::size_t columns, Step step) {
        std::vector<double> values = right_hand_sides(matrix, columns, layout);
        solve(which, values, columns); // its memory is new
        values = right_hand_sides(matrix, columns, layout);
        const Stopwatch solving;
        solve(which, values, columns);
        figures.seconds[step].push_back(solving.seconds());
        return by_columns(values, columns, layout);
    };
    figures.rotations = timed(0, matrices.rotations, rotation_columns, solve_rotations);
    figures.positions = timed(1, matrices.positions, position_columns, solve_positions);
}

void run_knead(const SystemMatrices& matrices, Figures& figures) {
    Workers workers(1); // as the others have
    std::vector<int> ordering;
    std::array<SparseFactor, 2> factors;
    run_solver(
        matrices, Layout::rows, figures, [&] { ordering = minimum_degree_order(matrices.rotations); },
        [&](std::size_t which, const SparseMatrix& matrix) {
            if (!factors.at(which).factorize(matrix, ordering).solved)
                throw Error(Trouble::numeric, "", "knead cannot factorise the systems");
        },
        [&](std::size_t which, std::vector<double>& values, std::size_t columns) {
            factors.at(which).solve(values, columns, workers);
        });
}

void run_superlu(const SystemMatrices& matrices, Figures& figures) {
    std::vector<int> ordering;
    std::array<SuperLuFactor, 2> factors;
    run_solver(
        matrices, Layout::columns, figures, [&] { ordering = minimum_degree_order(matrices.rotations); },
        [&](std::size_t which, const SparseMatrix& matrix) { factors.at(which).factorize(matrix, ordering); },
        [&](std::size_t which, std::vector<double>& values, std::size_t columns) {
            factors.at(which).solve(values, columns);
        });
}

void run_cholmod(const SystemMatrices& matrices, CholmodSystem& system, Figures& figures) {
    run_solver(
        matrices, Layout::columns, figures, [&] { system.analyze(matrices.rotations); },
        [&](std::size_t which, const SparseMatrix& matrix) { system.factorize(which, matrix); },
        [&](std::size_t which, std::vector<double>& values, std::size_t columns) {
            system.solve(which, values, columns);
        });
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

std::string name_of(CholmodKind kind, const CholmodSystem& system) {
    switch (kind) {
    case CholmodKind::automatic:
        return std::string("CHOLMOD, its choice: ") + (system.is_supernodal() ? "supernodal" : "simplicial");
    case CholmodKind::simplicial:
        return "CHOLMOD, simplicial";
    case CholmodKind::supernodal:
        return "CHOLMOD, supernodal";
    }
    return {};
}

// The first is knead's, the last SuperLU's, the others CHOLMOD's.
std::vector<Figures> measure(const SystemMatrices& matrices, std::size_t repeats) {
    const CholmodKind kinds[] = {CholmodKind::automatic, CholmodKind::simplicial, CholmodKind::supernodal};
    std::vector<Figures> all(2 + std::size(kinds));
    all.front().name = "knead";
    all.back().name = "SuperLU";
    for (std::size_t r = 0; r <= repeats; ++r) {
        if (r == 1) // the first was to warm up
            for (Figures& figures : all)
                for (auto& seconds : figures.seconds) seconds.clear();
        run_knead(matrices, all.front());
        for (std::size_t k = 0; k < std::size(kinds); ++k) {
            CholmodSystem system(kinds[k]);
            run_cholmod(matrices, system, all[1 + k]);
            all[1 + k].name = name_of(kinds[k], system);
        }
        run_superlu(matrices, all.back());
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
         ", SuperLU and knead in turns, one thread and one OpenBLAS; medians of " +
         std::to_string(arguments.repeats) + " after a warm-up."},
        {"One ordering for both matrices (CHOLMOD's with its symbolic analysis), 4 right-hand sides for "
         "rotations, 3 for positions."},
        {"knead over the others: below 1 knead is faster. Apart: the solutions, over the largest."},
        {""},
        {"", "order", "factor r", "factor p", "solve 4 r", "solve 3 p", "set-up ÷", "solve ÷", "apart"}};
    for (const std::string& name : arguments.clouds) {
        const DeformationTask task = task_named(name, workers);
        for (const std::uint64_t samples : arguments.samples) {
            std::cerr << name << ", " << samples << " samples ...\n";
            const SystemMatrices matrices = matrices_of(task, samples, workers);
            table.push_back({""});
            table.push_back({name + ", " + grouped(samples) + " samples asked: " +
                             grouped(static_cast<std::size_t>(matrices.rotations.size())) + " unknowns, " +
                             grouped(matrices.rotations.value.size()) + " entries"});
            add_figures(measure(matrices, arguments.repeats), table);
        }
    }
    std::cout << format_table(table);
}

} // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app{"knead's sparse factors beside CHOLMOD's and SuperLU's.", "peer_factors"};
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
        std::cerr << "peer_factors: " << error.what() << "\n";
        return static_cast<int>(error.trouble());
    }
    return 0;
}
