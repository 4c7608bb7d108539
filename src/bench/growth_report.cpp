// The growth of the stages as text and as JSON.

#include "base/counts.h"
#include "bench/growth.h"
#include "bench/report.h"
#include "edit/json_text.h"

namespace knead {

namespace {

void add_rows(std::span<const RowFigures> rows, std::size_t RowFigures::*size, double memory_copy,
              TextTable& table) {
    for (const RowFigures& row : rows) {
        std::vector<std::string> line{grouped(row.points), grouped(row.samples)};
        for (const Stage& stage : growth_stages()) line.push_back(duration_text((row.*stage.seconds).median));
        line.push_back(share_text(share_of_copy(row.upsampling)));
        line.push_back(share_text(share_of_memory(row.upsampling, memory_copy)));
        for (const std::uint64_t memory : {row.memory_held, row.memory_peak})
            line.push_back(
                memory == 0 ? unknown_text
                            : digits_text(static_cast<double>(memory) / static_cast<double>(row.points), 0));
        table.push_back(line);
    }
    std::vector<std::string> exponents{"exponent", ""};
    for (const Stage& stage : growth_stages()) {
        const std::optional<double> exponent = fitted_exponent(rows, size, stage);
        exponents.push_back(exponent ? digits_text(*exponent, 2) : unknown_text);
    }
    table.push_back(exponents);
}

// Empty where the device has no memory of its own.
std::string own_memory_text(const Growth& growth) {
    TextTable table{{""}, {own_memory_words}, {"points", "samples"}};
    for (std::string& cell : own_memory_heading()) table.back().push_back(std::move(cell));
    const std::size_t headings = table.size();
    for (const auto* rows : {&growth.by_points, &growth.by_samples})
        for (const RowFigures& row : *rows) {
            if (!row.upsampling.own_memory) continue;
            std::vector<std::string> line{grouped(row.points), grouped(row.samples)};
            for (std::string& cell : own_memory_cells(*row.upsampling.own_memory))
                line.push_back(std::move(cell));
            table.push_back(std::move(line));
        }
    return table.size() > headings ? format_table(table) : "";
}

ReportJson json_of(std::span<const RowFigures> rows, std::size_t RowFigures::*size, double memory_copy) {
    ReportJson json{{"rows", ReportJson::array()}, {"exponents", ReportJson::object()}};
    for (const RowFigures& row : rows) {
        ReportJson seconds;
        for (const Stage& stage : growth_stages()) seconds[stage.name] = json_of(row.*stage.seconds);
        json["rows"].push_back({{"points", row.points},
                                {"samples", row.samples},
                                {"seconds", seconds},
                                {"upsampling_bytes", row.upsampling.bytes},
                                {"share_of_copy", share_of_copy(row.upsampling)},
                                {"share_of_memory", share_of_memory(row.upsampling, memory_copy)},
                                {"own_memory", own_memory_json(row.upsampling.own_memory)},
                                {"held_bytes", row.memory_held},
                                {"peak_bytes", row.memory_peak}});
    }
    for (const Stage& stage : growth_stages()) {
        const std::optional<double> exponent = fitted_exponent(rows, size, stage);
        json["exponents"][stage.name] = exponent ? ReportJson(*exponent) : ReportJson();
    }
    return json;
}

} // namespace

std::string growth_text(const Growth& growth) {
    std::vector<std::string> heading{"points", "samples"};
    for (const Stage& stage : growth_stages()) heading.emplace_back(stage.name);
    for (const char* name : {"copy", "memory", "B/pt", "at most"}) heading.emplace_back(name);
    TextTable table{
        {machine_text(growth.machine)},
        {std::to_string(growth.threads) + (growth.threads == 1 ? " thread" : " threads") + " and " +
         growth.device + "; memory copy " + digits_text(1e-9 * growth.copy_bytes_per_second, 1) + " GB/s"},
        {"Copy, memory: how fast points are moved beside a copy of as many bytes, and beside the memory copy "
         "above."},
        {"B/pt: bytes a point that set-up and frames hold, and hold at most, beyond the file's own."},
        {"Exponent: of the power law that fits best."},
        {""},
        heading};
    add_rows(growth.by_points, &RowFigures::points, growth.copy_bytes_per_second, table);
    table.push_back({""});
    add_rows(growth.by_samples, &RowFigures::samples, growth.copy_bytes_per_second, table);
    return format_table(table) + own_memory_text(growth);
}

std::string growth_json(const Growth& growth) {
    ReportJson json = machine_json(growth.machine);
    json["threads"] = growth.threads;
    json["device"] = growth.device;
    json["copy_gigabytes_per_second"] = 1e-9 * growth.copy_bytes_per_second;
    json["warnings"] = growth.warnings;
    json["by_points"] = json_of(growth.by_points, &RowFigures::points, growth.copy_bytes_per_second);
    json["by_samples"] = json_of(growth.by_samples, &RowFigures::samples, growth.copy_bytes_per_second);
    return json_text(json);
}

} // namespace knead
