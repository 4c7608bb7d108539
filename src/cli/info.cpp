// `knead info FILE`: what is in a cloud.

#include "base/stopwatch.h"
#include "cli/commands.h"
#include "cloud/point_cloud.h"
#include "edit/json_text.h"
#include "graph/bridges.h"
#include "graph/neighbors.h"
#include "graph/point_order.h"
#include "io/cloud_file.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <iomanip>
#include <memory>

namespace knead {

namespace {

struct Facts {
    FileKind kind;
    std::size_t points = 0;
    Bounds bounds;
    std::size_t duplicates = 0;
    std::size_t components = 0;        // of the graph of the nearest neighbours
    std::size_t largest_component = 0; // in points
    double neighbors_seconds = 0;
    struct Bridged { // what the setting strays = "bridge" makes of them
        std::size_t components = 0, largest_component = 0;
        std::size_t outliers = 0; // vertices that hang on others
        double seconds = 0;
    } bridged;
};

// As many as an edit takes, unless its session says otherwise.
constexpr std::size_t neighbors = 6;

std::uint64_t mixed(std::uint64_t value) {
    value ^= value >> 33U;
    value *= 0xff51afd7ed558ccdU;
    value ^= value >> 33U;
    value *= 0xc4ceb9fe1a85ec53U;
    return value ^ (value >> 33U);
}

std::uint64_t hash_of(const Vec3d& p) {
    std::uint64_t hash = 0;
    // Adding zero makes one zero of the two, which are equal.
    for (const double value : p) hash = mixed(hash ^ std::bit_cast<std::uint64_t>(value + 0.0));
    return hash;
}

// Finite points less distinct positions, by the file's own values.
std::size_t count_duplicates(const PointCloud& cloud, Progress& progress) {
    constexpr std::size_t points_between_reports = std::size_t{1} << 17;
    // An open hash table, at most half full.
    std::vector<Index> table(std::bit_ceil(2 * cloud.size() + 1), no_index);
    std::size_t duplicates = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        if (i % points_between_reports == 0)
            progress.step("counting duplicates", static_cast<double>(i) / static_cast<double>(cloud.size()));
        if (!is_finite(cloud, i)) continue;
        const Vec3d p = cloud.file_position(i);
        std::size_t slot = hash_of(p) & (table.size() - 1);
        while (table[slot] != no_index && cloud.file_position(table[slot]) != p)
            slot = (slot + 1) & (table.size() - 1);
        if (table[slot] == no_index)
            table[slot] = static_cast<Index>(i);
        else
            ++duplicates;
    }
    return duplicates;
}

// The parts that the cloud falls into when an edit opens it.
void count_components(const PointCloud& cloud, Progress& progress, Facts& facts) {
    if (facts.bounds.finite_points == 0) return;
    Workers workers;
    const PointOrder order = order_points(cloud.positions, workers, progress);
    std::vector<float> ordered(3 * order.points());
    gather(order, cloud.positions, 3, ordered, workers);
    const std::vector<float> positions = vertex_positions(order, ordered, workers);
    const auto largest = [&](const Components& components) {
        std::vector<std::size_t> points(components.size.size());
        for (std::size_t i = 0; i < order.points(); ++i) ++points[components.component[order.vertex[i]]];
        return *std::ranges::max_element(points);
    };
    Stopwatch clock;
    const Graph graph = neighbor_graph(positions, neighbors, workers, progress);
    const Components components = find_components(graph, workers);
    facts.neighbors_seconds = clock.lap();
    facts.components = components.size.size();
    facts.largest_component = largest(components);
    clock.lap();
    const JoinedGraph joined = bridged(graph, positions, workers, progress);
    const Components bodies = find_components(joined.graph, workers);
    facts.bridged = {bodies.size.size(), largest(bodies), joined.outliers, clock.lap()};
}

Facts facts_of(const PointCloud& cloud, Progress& progress) {
    Facts facts;
    facts.kind = file_kind(cloud);
    facts.points = cloud.size();
    facts.bounds = bounds_of(cloud);
    facts.duplicates = count_duplicates(cloud, progress);
    count_components(cloud, progress, facts);
    return facts;
}

std::string json_of(const PointCloud& cloud, const Facts& facts) {
    const auto vector = [](const Vec3d& v) { return nlohmann::ordered_json{v[0], v[1], v[2]}; };
    nlohmann::ordered_json json;
    json["points"] = facts.points;
    json["finite"] = facts.bounds.finite_points;
    json["attributes"] = nlohmann::ordered_json::array();
    for (const Attribute& attribute : cloud.attributes)
        json["attributes"].push_back(
            {{"name", attribute.name}, {"type", name_of(attribute.type)}, {"list", attribute.is_list()}});
    json["bounds"]["min"] = vector(facts.bounds.lowest);
    json["bounds"]["max"] = vector(facts.bounds.highest);
    json["diagonal"] = facts.bounds.diagonal();
    json["duplicates"] = facts.duplicates;
    json["components"] = facts.components;
    json["largest_component"] = facts.largest_component;
    json["bridged"] = {{"components", facts.bridged.components},
                       {"largest_component", facts.bridged.largest_component},
                       {"outliers", facts.bridged.outliers}};
    json["seconds"] = {{"neighbors", facts.neighbors_seconds}, {"bridging", facts.bridged.seconds}};
    json["format"] = facts.kind.format;
    json["encoding"] = facts.kind.encoding;
    json["remarks"] = cloud.remarks;
    return json_text(json);
}

void print(const PointCloud& cloud, const Facts& facts, std::ostream& out) {
    const auto line = [&out](const char* name) -> std::ostream& {
        return out << std::left << std::setw(12) << name;
    };
    const auto vector = [&out](const Vec3d& v) { out << v[0] << "  " << v[1] << "  " << v[2] << '\n'; };
    out << std::setprecision(10);
    line("format") << facts.kind.format << ", " << facts.kind.encoding << '\n';
    line("points") << facts.points << '\n';
    line("finite") << facts.bounds.finite_points << '\n';
    line("duplicates") << facts.duplicates << '\n';
    const auto components = [&](std::size_t count, std::size_t largest) {
        out << count;
        if (count > 1)
            out << ", the largest of " << largest << " points (" << 100 * largest / facts.bounds.finite_points
                << " %)";
    };
    line("components"), components(facts.components, facts.largest_component);
    out << "  (" << neighbors << " neighbours)\n";
    line("bridged"), components(facts.bridged.components, facts.bridged.largest_component);
    if (facts.bridged.outliers > 0) out << ", " << facts.bridged.outliers << " outliers hang on";
    if (facts.bridged.components > facts.components) out << "; pieces that only they tied count apart";
    out << "  (strays \"bridge\")\n";
    if (facts.bounds.finite_points > 0) {
        line("lowest"), vector(facts.bounds.lowest);
        line("highest"), vector(facts.bounds.highest);
        line("size"), vector(facts.bounds.highest - facts.bounds.lowest);
        line("diagonal") << facts.bounds.diagonal() << '\n';
    }
    std::size_t widest = 0;
    for (const Attribute& attribute : cloud.attributes) widest = std::max(widest, attribute.name.size());
    const char* title = "attributes";
    for (const Attribute& attribute : cloud.attributes) {
        line(title) << std::setw(static_cast<int>(widest) + 2) << attribute.name << name_of(attribute.type)
                    << (attribute.is_list() ? " list" : "") << '\n';
        title = "";
    }
    for (const std::string& remark : cloud.remarks) line("remark") << remark << '\n';
}

int info(const std::string& file, bool as_json, Terminal& terminal) {
    const PointCloud cloud = read_cloud(file, terminal);
    const Facts facts = facts_of(cloud, terminal);
    if (as_json)
        terminal.out << json_of(cloud, facts) << '\n';
    else
        print(cloud, facts, terminal.out);
    return 0;
}

} // namespace

void add_info(CLI::App& app, Job& job) {
    struct Options {
        std::string file;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("info", "What is in a cloud: points, attributes, bounds, duplicates, components");
    command->add_option("FILE", options->file, "The cloud: " + known_extensions())->required();
    command->add_flag("--json", options->json, "Print one JSON object");
    command->callback([options, &job] {
        job = [options](Terminal& terminal) { return info(options->file, options->json, terminal); };
    });
}

} // namespace knead
