// `knead diff A B`: how far apart two clouds of the same points are, and which attributes differ, and by how
// much.

#include "base/error.h"
#include "cli/commands.h"
#include "edit/json_text.h"
#include "io/cloud_file.h"
#include "io/compare.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <iomanip>
#include <memory>

namespace knead {

namespace {

struct Difference {
    std::size_t points = 0;
    double diagonal = 0; // of A
    Distances distances; // over the diagonal, or in the file's units where that is 0
    AttributeDifferences attributes;

    bool is_relative() const { return diagonal > 0; }
};

Difference difference_of(const PointCloud& a, const PointCloud& b) {
    Difference difference;
    difference.points = a.size();
    difference.diagonal = bounds_of(a).diagonal();
    difference.distances = distances_between(a, b);
    if (difference.is_relative()) {
        difference.distances.rms /= difference.diagonal;
        difference.distances.p95 /= difference.diagonal;
        difference.distances.largest /= difference.diagonal;
    }
    difference.attributes = attribute_differences(a, b);
    return difference;
}

nlohmann::ordered_json json_of(const AttributeDifference& difference) {
    nlohmann::ordered_json json;
    json["name"] = difference.name;
    json["same_type"] = difference.same_type;
    json["points"] = difference.points;
    json["largest"] = difference.largest;
    json["largest_index"] = difference.farthest_point;
    return json;
}

std::string json_of(const Difference& difference) {
    nlohmann::ordered_json json;
    json["points"] = difference.points;
    json["diagonal"] = difference.diagonal;
    json["rms"] = difference.distances.rms;
    json["p95"] = difference.distances.p95;
    json["largest"] = difference.distances.largest;
    json["largest_index"] = difference.distances.largest_index;
    json["incomparable"] = difference.distances.incomparable;
    json["attributes_differ"] = nlohmann::json::array();
    json["attribute_differences"] = nlohmann::json::array();
    for (const AttributeDifference& each : difference.attributes.differ) {
        json["attributes_differ"].push_back(each.name);
        json["attribute_differences"].push_back(json_of(each));
    }
    json["attributes_only_in_a"] = difference.attributes.only_in_a;
    json["attributes_only_in_b"] = difference.attributes.only_in_b;
    return json_text(json);
}

// "12 points, by 0.25 at most, at point 7, of another type".
void print(const AttributeDifference& difference, std::ostream& out) {
    out << difference.points << (difference.points == 1 ? " point" : " points");
    if (difference.largest > 0)
        out << ", by " << difference.largest << " at most, at point " << difference.farthest_point;
    if (!difference.same_type) out << ", of another type";
    out << '\n';
}

void print(const Difference& difference, std::ostream& out) {
    const auto line = [&out](const char* name) -> std::ostream& {
        return out << std::left << std::setw(12) << name;
    };
    const auto names = [&](const char* title, const std::vector<std::string>& list) {
        if (list.empty()) return;
        line(title);
        for (const std::string& name : list) out << (&name == &list.front() ? "" : ", ") << name;
        out << '\n';
    };
    const char* const unit = difference.is_relative() ? " D" : "";
    out << std::setprecision(6);
    line("points") << difference.points << '\n';
    line("D") << difference.diagonal << "  (the diagonal of A)\n";
    line("rms") << difference.distances.rms << unit << '\n';
    line("p95") << difference.distances.p95 << unit << '\n';
    line("largest") << difference.distances.largest << unit;
    if (difference.distances.largest > 0) out << "  at point " << difference.distances.largest_index;
    out << '\n';
    if (difference.distances.incomparable > 0)
        line("incomparable")
            << ' ' << difference.distances.incomparable
            << " points, not finite in one of the clouds or otherwise in each; the first is point "
            << difference.distances.first_incomparable << '\n';
    if (difference.attributes.none()) line("attributes") << "all equal\n";
    for (const AttributeDifference& each : difference.attributes.differ)
        print(each, line("differs") << each.name << ": ");
    names("only in A", difference.attributes.only_in_a);
    names("only in B", difference.attributes.only_in_b);
}

void warn_of(const PointCloud& cloud, const std::string& file, Terminal& terminal) {
    const std::string place = file + ": ";
    for (const std::string& remark : cloud.remarks) terminal.warn(place + remark);
}

int diff(const std::string& file_a, const std::string& file_b, bool as_json, Terminal& terminal) {
    const PointCloud a = read_cloud(file_a, terminal);
    const PointCloud b = read_cloud(file_b, terminal);
    if (a.size() != b.size())
        throw Error(Trouble::input, file_b,
                    "has " + std::to_string(b.size()) + " points, but " + file_a + " has " +
                        std::to_string(a.size()) + "; diff compares the same points in the same order");
    warn_of(a, file_a, terminal);
    warn_of(b, file_b, terminal);
    const Difference difference = difference_of(a, b);
    if (!difference.is_relative())
        terminal.warn(file_a + ": its diagonal is 0, so distances are in the file's units");
    if (as_json)
        terminal.out << json_of(difference) << '\n';
    else
        print(difference, terminal.out);
    return 0;
}

} // namespace

void add_diff(CLI::App& app, Job& job) {
    struct Options {
        std::string a;
        std::string b;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "diff", "How far apart two clouds of the same points are, which attributes differ, and by how much");
    command->add_option("A", options->a, "A cloud; its diagonal is the unit of the distances")->required();
    command->add_option("B", options->b, "Another of the same points in the same order")->required();
    command->add_flag("--json", options->json, "Print one JSON object");
    command->callback([options, &job] {
        job = [options](Terminal& terminal) { return diff(options->a, options->b, options->json, terminal); };
    });
}

} // namespace knead
