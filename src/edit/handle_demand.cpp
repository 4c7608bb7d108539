#include "edit/handle_demand.h"

#include "base/types.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace knead {

namespace {

constexpr double longest_plausible = 2.5;
constexpr double shortest_plausible = 1.0 / 3;
constexpr double most_rounded = 1e-5;

std::string with_digits(const char* format, double value) {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

} // namespace

Parting parting_of(const Graph& graph, const HandleLabels& labels, const Numbering& point,
                   std::span<const float> rest, std::span<const float> posed) {
    const std::vector<Index>& handle = labels.vertex;
    const auto length_of = [&](std::span<const float> positions, Index v, Index w) {
        return (point_at(positions, point[w]) - point_at(positions, point[v])).norm();
    };
    std::map<std::pair<Index, Index>, std::vector<double>> factors;
    for (Index v = 0; v < graph.size(); ++v) {
        if (handle[v] == no_index) continue;
        for (const Index w : graph.row(v)) { // both directions are there: each link once
            if (handle[w] == no_index || handle[w] <= handle[v]) continue;
            const double length = length_of(rest, v, w);
            if (length > 0) factors[{handle[v], handle[w]}].push_back(length_of(posed, v, w) / length);
        }
    }
    Parting worst;
    for (auto& [pair, stretches] : factors) {
        const auto found = stretches.end() - 1 - static_cast<std::ptrdiff_t>(stretches.size() / 100);
        std::nth_element(stretches.begin(), found, stretches.end());
        if (*found > worst.factor) worst = {*found, pair.first, pair.second};
    }
    return worst;
}

double rounding_of(std::span<const float> posed, double size) {
    float farthest = 0;
    for (const float coordinate : posed) farthest = std::max(farthest, std::abs(coordinate));
    const bool has_extent = size > static_cast<double>(std::numeric_limits<float>::min());
    return has_extent
               ? static_cast<double>(farthest) * std::ldexp(1.0, -std::numeric_limits<float>::digits) / size
               : 0;
}

std::string words_about_demand(const HandleDemand& demand) {
    const bool pulled = demand.strain.longest > longest_plausible;
    const bool pressed = demand.strain.shortest < shortest_plausible;
    std::string words;
    if (pulled || pressed) {
        words = "the handles ";
        if (pulled)
            words += "pull the cloud to " + with_digits("%.1f", demand.strain.longest) + " times its length";
        if (pulled && pressed) words += " and ";
        if (pressed)
            words += "press the cloud together to " + with_digits("%.0f", 100 * demand.strain.shortest) +
                     " % of its length";
        words += "; what lies between them is shared out as evenly as can be";
    }
    if (demand.parted > longest_plausible) {
        if (!words.empty()) words += "; ";
        words += "the cloud tears between " + demand.one + " and " + demand.other +
                 ", which touch and are moved apart; leave some of it free between them";
    }
    for (const LostTurn& turn : demand.lost) {
        if (!words.empty()) words += "; ";
        words += "the cloud does not keep the " + with_digits("%.0f", turn.asked) + "° by which " +
                 turn.handle + " is turned: it has slipped back by whole turns, to about " +
                 with_digits("%.0f", turn.kept) +
                 "°; a slimmer part, or one that is twisted in several edits (Enter), keeps more";
    }
    if (demand.rounded > most_rounded) {
        if (!words.empty()) words += "; ";
        words += "the handles send the cloud so far away that its points there are rounded to " +
                 with_digits("%.2g", 100 * demand.rounded) +
                 " % of its size; leave it near where it was opened, and move the finished file";
    }
    return words;
}

} // namespace knead
