#include "bench/text_table.h"

#include "base/counts.h"

#include <algorithm>
#include <cstdio>

namespace knead {

namespace {

// Bytes that continue a character of UTF-8 take no room of their own.
std::size_t width_of(const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count_if(
        text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

std::vector<std::size_t> column_widths(const TextTable& table) {
    std::vector<std::size_t> widths;
    for (const auto& line : table) {
        if (line.size() < 2) continue;
        widths.resize(std::max(widths.size(), line.size()), 0);
        for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], width_of(line[c]));
    }
    return widths;
}

struct Unit {
    const char* name;
    double seconds;
};

Unit unit_for(double seconds) {
    if (seconds >= 1) return {"s", 1};
    if (seconds >= 1e-3) return {"ms", 1e-3};
    return {"µs", 1e-6};
}

std::string three_digits(double value) {
    const double size = std::abs(value);
    return digits_text(value, size >= 99.95 || size == 0 ? 0 : size >= 9.995 ? 1 : 2);
}

} // namespace

std::string format_table(const TextTable& table) {
    const std::vector<std::size_t> widths = column_widths(table);
    std::string text;
    for (const auto& line : table) {
        std::string words;
        for (std::size_t c = 0; c < line.size(); ++c) {
            const std::size_t width = line.size() < 2 ? 0 : widths[c];
            const std::string blanks(width - std::min(width, width_of(line[c])), ' ');
            if (c > 0) words += "  ";
            words += c == 0 ? line[c] + blanks : blanks + line[c];
        }
        words.erase(words.find_last_not_of(' ') + 1);
        text += words + '\n';
    }
    return text;
}

std::string duration_text(double seconds) {
    const Unit unit = unit_for(seconds);
    return three_digits(seconds / unit.seconds) + " " + unit.name;
}

std::string spread_text(const Summary& seconds) {
    const Unit unit = unit_for(seconds.lowest);
    return three_digits(seconds.lowest / unit.seconds) + "…" + three_digits(seconds.highest / unit.seconds) +
           " " + unit.name;
}

std::string factor_text(double factor) {
    const std::string number =
        factor >= 999.5 ? grouped(static_cast<std::size_t>(factor + 0.5)) : three_digits(factor);
    return number + " ×";
}

std::string digits_text(double value, int digits) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

std::string power_text(double value) {
    if (value == 0) return "0";
    char text[32];
    std::snprintf(text, sizeof text, "%.1e", value);
    return text;
}

} // namespace knead
