// Table 1 as text and as JSON.

#include "base/counts.h"
#include "bench/report.h"
#include "bench/table1.h"
#include "bench/text_table.h"
#include "edit/json_text.h"

#include <nlohmann/json.hpp>

namespace knead {

namespace {

using Json = nlohmann::ordered_json;

// Two spaces, so that what belongs to a row stands below its name.
constexpr const char* indent = "  ";

std::string text_of(const std::optional<double>& figure, std::string (*write)(double)) {
    return figure ? write(*figure) : unknown_text;
}

std::string verdict_text(const std::optional<double>& floor, const std::optional<double>& factor) {
    if (!floor || !factor) return "";
    return "≥ " + factor_text(*floor) + (*factor >= *floor ? " pass" : " FAIL");
}

bool any_of(const FourFigures& figures) {
    return figures.set_up || figures.factorize || figures.solve || figures.upsample;
}

void add_row(const Table1Result& result, TextTable& table) {
    const std::string name = name_of(result.row);
    if (!result.missing.empty()) {
        table.push_back({name + indent + "not run: " + result.missing});
        return;
    }
    const RowFigures& ours = result.figures;
    const auto median = [](const Summary& summary) { return duration_text(summary.median); };
    table.push_back({name, grouped(ours.points), grouped(ours.samples), median(ours.order),
                     median(ours.neighbors), median(ours.sampling), median(ours.geodesic),
                     median(ours.set_up), median(ours.factorize), median(ours.solve), median(ours.upsample)});
    table.push_back({std::string(indent) + "min…max", "", "", "", "", "", "", spread_text(ours.set_up),
                     spread_text(ours.factorize), spread_text(ours.solve), spread_text(ours.upsample)});
    const FourFigures& paper = result.row.paper;
    table.push_back({std::string(indent) + "paper", "", "", "", "", "", "",
                     text_of(paper.set_up, duration_text), text_of(paper.factorize, duration_text),
                     text_of(paper.solve, duration_text), text_of(paper.upsample, duration_text)});
    const FourFigures factors = factors_over_paper(result);
    if (any_of(factors))
        table.push_back({std::string(indent) + "faster by", "", "", "", "", "", "",
                         text_of(factors.set_up, factor_text), text_of(factors.factorize, factor_text),
                         text_of(factors.solve, factor_text), text_of(factors.upsample, factor_text)});
    const FourFigures& floors = result.row.floors;
    if (any_of(floors))
        table.push_back(
            {std::string(indent) + "floor", "", "", "", "", "", "",
             verdict_text(floors.set_up, factors.set_up), verdict_text(floors.factorize, factors.factorize),
             verdict_text(floors.solve, factors.solve), verdict_text(floors.upsample, factors.upsample)});
}

double gigabytes_per_second(std::size_t bytes, const Summary& seconds) {
    return seconds.median > 0 ? 1e-9 * static_cast<double>(bytes) / seconds.median : 0;
}

void add_upsampling(const Table1Result& result, double memory_copy, TextTable& table) {
    if (!result.missing.empty()) return;
    const UpsampleFigures& ours = result.figures.upsampling;
    const double moved = gigabytes_per_second(ours.bytes, ours.device);
    const double copied = gigabytes_per_second(ours.bytes, ours.copy);
    table.push_back({name_of(result.row), ours.with_normals ? "yes" : "no", duration_text(ours.device.median),
                     spread_text(ours.device), duration_text(ours.reference.median),
                     factor_text(ratio(ours.reference, ours.device)), power_text(ours.largest_difference),
                     digits_text(1e-6 * static_cast<double>(ours.bytes), 1), digits_text(moved, 1),
                     digits_text(copied, 1), share_text(share_of_copy(ours)),
                     share_text(share_of_memory(ours, memory_copy))});
}

void add_own_memory(const Table1Result& result, TextTable& table) {
    if (!result.missing.empty() || !result.figures.upsampling.own_memory) return;
    std::vector<std::string> line{name_of(result.row), result.figures.upsampling.with_normals ? "yes" : "no"};
    for (std::string& cell : own_memory_cells(*result.figures.upsampling.own_memory))
        line.push_back(std::move(cell));
    table.push_back(std::move(line));
}

Json json_of(const FourFigures& figures) {
    const auto value = [](const std::optional<double>& figure) { return figure ? Json(*figure) : Json(); };
    return {{"set_up", value(figures.set_up)},
            {"factorize", value(figures.factorize)},
            {"solve", value(figures.solve)},
            {"upsample", value(figures.upsample)}};
}

Json verdicts_of(const FourFigures& floors, const FourFigures& factors) {
    const auto verdict = [](const std::optional<double>& floor, const std::optional<double>& factor) {
        return floor && factor ? Json(*factor >= *floor) : Json();
    };
    return {{"set_up", verdict(floors.set_up, factors.set_up)},
            {"factorize", verdict(floors.factorize, factors.factorize)},
            {"solve", verdict(floors.solve, factors.solve)},
            {"upsample", verdict(floors.upsample, factors.upsample)}};
}

Json json_of(const UpsampleFigures& ours, double memory_copy) {
    return {{"device_seconds", json_of(ours.device)},
            {"reference_seconds", json_of(ours.reference)},
            {"device_over_reference", ratio(ours.reference, ours.device)},
            {"largest_difference", ours.largest_difference},
            {"normals", ours.with_normals},
            {"bytes", ours.bytes},
            {"gigabytes_per_second", gigabytes_per_second(ours.bytes, ours.device)},
            {"copy_seconds", json_of(ours.copy)},
            {"copy_gigabytes_per_second", gigabytes_per_second(ours.bytes, ours.copy)},
            {"share_of_copy", share_of_copy(ours)},
            {"share_of_memory", share_of_memory(ours, memory_copy)},
            {"own_memory", own_memory_json(ours.own_memory)}};
}

Json json_of(const Table1Result& result, double memory_copy) {
    Json json{
        {"row", name_of(result.row)}, {"model", result.row.model}, {"asked_samples", result.row.samples}};
    json["missing"] = result.missing.empty() ? Json() : Json(result.missing);
    json["paper_seconds"] = json_of(result.row.paper);
    if (!result.missing.empty()) return json;
    const RowFigures& ours = result.figures;
    json["points"] = ours.points;
    json["vertices"] = ours.vertices;
    json["samples"] = ours.samples;
    json["seconds"] = {{"order", json_of(ours.order)},       {"neighbors", json_of(ours.neighbors)},
                       {"sampling", json_of(ours.sampling)}, {"geodesic", json_of(ours.geodesic)},
                       {"set_up", json_of(ours.set_up)},     {"factorize", json_of(ours.factorize)},
                       {"solve", json_of(ours.solve)},       {"upsample", json_of(ours.upsample)}};
    const FourFigures factors = factors_over_paper(result);
    json["factor_over_paper"] = json_of(factors);
    json["floor"] = json_of(result.row.floors);
    json["holds"] = verdicts_of(result.row.floors, factors);
    json["upsampling"] = json_of(ours.upsampling, memory_copy);
    return json;
}

} // namespace

std::string table1_text(const Table1& table) {
    TextTable lines{{machine_text(table.machine)},
                    {std::to_string(table.threads) + (table.threads == 1 ? " thread" : " threads") + " and " +
                     table.device + "; memory copy " + digits_text(1e-9 * table.copy_bytes_per_second, 1) +
                     " GB/s"},
                    {"Medians of " + std::to_string(table.repeats) +
                     " set-ups, each from nothing, and of 30 frames of 3 iterations; the paper: 2.4 GHz, "
                     "GeForce 8800 GTX"},
                    {""},
                    {"model/samples", "points", "samples", "order", "neighbors", "sampling", "geodesic",
                     "set-up", "factorize", "solve", "upsample"}};
    for (const Table1Result& result : table.results) add_row(result, lines);
    TextTable upsampling{{"Moving all points, on the device and in plain C++; beside a copy of as many "
                          "bytes, and beside the memory copy"},
                         {"model/samples", "normals", "device", "min…max", "reference", "device faster by",
                          "difference", "MB", "GB/s", "copy GB/s", "of copy", "of memory"}};
    for (const Table1Result& result : table.results)
        add_upsampling(result, table.copy_bytes_per_second, upsampling);
    TextTable own_memory{{own_memory_words}, {"model/samples", "normals"}};
    for (std::string& cell : own_memory_heading()) own_memory.back().push_back(std::move(cell));
    for (const Table1Result& result : table.results) add_own_memory(result, own_memory);
    return format_table(lines) + (upsampling.size() > 2 ? "\n" + format_table(upsampling) : "") +
           (own_memory.size() > 2 ? "\n" + format_table(own_memory) : "");
}

std::string table1_json(const Table1& table) {
    Json json = machine_json(table.machine);
    json["threads"] = table.threads;
    json["device"] = table.device;
    json["repeats"] = table.repeats;
    json["copy_gigabytes_per_second"] = 1e-9 * table.copy_bytes_per_second;
    json["warnings"] = table.warnings;
    json["rows"] = Json::array();
    for (const Table1Result& result : table.results)
        json["rows"].push_back(json_of(result, table.copy_bytes_per_second));
    return json_text(json);
}

} // namespace knead
