// How many iterations and milliseconds CGAL and knead take to within 1 % of D of where each converges, on the
// same points with the same handles. Prints a table.

#include "base/counts.h"
#include "bench/automatic_handles.h"
#include "bench/data_files.h"
#include "bench/machine.h"
#include "bench/posing.h"
#include "bench/report.h"
#include "io/cloud_file.h"
#include "peers/cgal_deformation.h"
#include "upsample/devices.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>

namespace {

using namespace knead;
using namespace knead::peers;

constexpr double bar = 0.01;
constexpr double bend_degrees = 60;

struct Arguments {
    std::vector<std::string> shapes;
    std::size_t most_iterations = 2000;
    std::size_t repeats = 3;
    unsigned threads = 0;
};

// A task, the mesh that CGAL needs of it, and how that came about.
struct MeshTask {
    DeformationTask task;
    std::vector<Triangle> triangles;
    std::string words;
};

MeshTask survey_task(const std::filesystem::path& folder, const std::string& name) {
    MeshTask result{read_survey_task(folder, name), read_triangles(folder / (name + ".off")), ""};
    result.words = name + ": " + grouped(result.task.cloud.size()) + " vertices, " +
                   grouped(result.triangles.size()) + " triangles";
    return result;
}

MeshTask scan_task(const std::filesystem::path& path) {
    SilentProgress progress;
    const PointCloud scan = read_cloud(path, progress);
    FoundMesh mesh = find_mesh(scan);
    MeshTask result;
    result.words = path.stem().string() + ", bent by " + digits_text(bend_degrees, 0) +
                   "°: " + grouped(mesh.cloud.size()) + " of its " + grouped(scan.size()) +
                   " points; CGAL found a mesh of " + grouped(mesh.triangles.size()) + " triangles in " +
                   duration_text(mesh.seconds);
    result.task = bending_task(path.stem().string(), std::move(mesh.cloud), bend_degrees);
    result.triangles = std::move(mesh.triangles);
    return result;
}

MeshTask task_named(const std::string& name) {
    const std::vector<std::string> shapes = survey_names();
    const bool of_survey = std::ranges::find(shapes, name) != shapes.end();
    const DataFolders folders = of_survey ? survey_folders("") : scan_folders("");
    const std::string file = name + (of_survey ? ".off" : ".ply");
    const auto path = find_data_file(folders, file);
    if (!path) throw Error(Trouble::input, "", missing_words(folders, file));
    return of_survey ? survey_task(path->parent_path(), name) : scan_task(*path);
}

// The end of a descent that did not come to rest is on its way still, so that its numbers are lower bounds.
void add_arrival(const std::optional<Arrival>& arrival, bool at_rest, std::vector<std::string>& line) {
    const std::string bound = at_rest ? "" : "≥ ";
    line.push_back(arrival ? bound + grouped(arrival->iterations) : "not reached");
    line.push_back(arrival ? bound + duration_text(arrival->seconds) : unknown_text);
}

void add_descent(const Descent& descent, double diagonal, TextTable& table) {
    if (!descent.trouble.empty()) {
        table.push_back({descent.name + ": " + descent.trouble});
        return;
    }
    const Arrivals arrivals = arrivals_of(descent, bar, diagonal);
    std::vector<std::string> line{descent.name, grouped(descent.samples), duration_text(descent.preparation),
                                  duration_text(descent.iteration)};
    add_arrival(arrivals.rms, descent.at_rest, line);
    add_arrival(arrivals.largest, descent.at_rest, line);
    line.push_back(grouped(descent.stops.back().iterations));
    line.push_back(percent_text(arrivals.last_tenth));
    table.push_back(line);
}

void compare(const std::string& name, const Arguments& arguments, Workers& workers, Upsampler& upsampler,
             TextTable& table) {
    const MeshTask meshed = task_named(name);
    const DeformationTask& task = meshed.task;
    const double diagonal = bounds_of(task.cloud).diagonal();
    table.push_back({""});
    table.push_back({meshed.words});
    for (const CgalEnergy energy : {CgalEnergy::spokes_and_rims, CgalEnergy::smooth_rotations})
        add_descent(
            descend_with_cgal(task, meshed.triangles, energy, arguments.most_iterations, arguments.repeats),
            diagonal, table);
    const std::optional<std::uint64_t> counts[] = {std::nullopt, 5000U, 1000U};
    for (const std::optional<std::uint64_t>& samples : counts) {
        if (samples && 2 * *samples > task.cloud.size()) continue;
        add_descent(descend_with_knead(task, samples, arguments.most_iterations, arguments.repeats, workers,
                                       upsampler),
                    diagonal, table);
    }
}

void run(const Arguments& arguments) {
    const Machine machine = this_machine();
    Workers workers(arguments.threads);
    const UpsamplerChoice choice = make_upsampler("", workers, arguments.threads);
    TextTable table{
        {machine_text(machine)},
        {"knead: " + std::to_string(workers.threads()) + (workers.threads() == 1 ? " thread" : " threads") +
         " and " + choice.upsampler->device() + "; CGAL " PEER_VERSION ": 1 thread"},
        {"Both from rest, the handle's whole motion at once, until nothing moves or the iterations run out."},
        {"rms, largest: from which iteration on all points, in the rms and at the farthest, are within 1 % "
         "of D of the own last pose;"},
        {"≥ where the iterations ran out on the way to it. Time: of the iterations to there, without the "
         "preparation (and without"},
        {"the search for a mesh, which knead does not need). Last tenth: how far, in % of D, the farthest "
         "point went in the last"},
        {"tenth of the iterations."},
        {""},
        {"", "samples", "preparation", "iteration", "rms", "time", "largest", "time", "iterations",
         "last tenth"}};
    for (const std::string& name : arguments.shapes) {
        std::cerr << name << " ...\n";
        compare(name, arguments, workers, *choice.upsampler, table);
    }
    std::cout << format_table(table);
}

} // namespace

int main(int argc, char** argv) {
    Arguments arguments{survey_names()};
    arguments.shapes.emplace_back("armadillo_86k");
    CLI::App app{"CGAL's mesh deformation and knead's, side by side.", "peer_cgal"};
    app.add_option("shapes", arguments.shapes,
                   "bar, cactus, cylinder, plane (of KNEAD_SURVEY), or scans without .ply (of KNEAD_SCANS); "
                   "default: the survey's and armadillo_86k");
    app.add_option("--iterations", arguments.most_iterations, "How many at most (default: 2000)")
        ->check(CLI::Range(10, 1'000'000));
    app.add_option("--repeats", arguments.repeats, "Of the preparation (default: 3)")
        ->check(CLI::Range(1, 1000));
    app.add_option("--threads", arguments.threads, "Of knead (default: all cores)");
    CLI11_PARSE(app, argc, argv);
    try {
        run(arguments);
    } catch (const Error& error) {
        std::cerr << "peer_cgal: " << error.what() << "\n";
        return static_cast<int>(error.trouble());
    }
    return 0;
}
