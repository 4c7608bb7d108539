// The growth of the stages as a picture: a diagram for points and one for samples, side by side.

#include "base/counts.h"
#include "bench/growth.h"
#include "bench/report.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace knead {

namespace {

constexpr double side = 360, margin_left = 64, margin_top = 40, margin_bottom = 48, legend = 96;
constexpr double panel = margin_left + side + legend;
constexpr std::array<const char*, 8> colors{"#0072b2", "#e69f00", "#009e73", "#cc79a7",
                                            "#000000", "#d55e00", "#56b4e9", "#8c6d00"};

// From a value to a place along an axis, over whole decades.
struct LogAxis {
    int first = 0, last = 1; // powers of ten

    double operator()(double value) const { return side * (std::log10(value) - first) / (last - first); }
};

struct Range {
    double least = std::numeric_limits<double>::infinity(), most = 0;

    void take(double value) {
        if (!(value > 0)) return;
        least = std::min(least, value);
        most = std::max(most, value);
    }
    LogAxis axis() const {
        if (!(most > 0)) return {};
        const int first = static_cast<int>(std::floor(std::log10(least)));
        return {first, std::max(first + 1, static_cast<int>(std::ceil(std::log10(most) - 1e-9)))};
    }
};

std::string number(double value) {
    return digits_text(value, 1);
}

std::string text_at(double x, double y, const char* anchor, const std::string& words,
                    const char* color = "#444") {
    return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\" fill=\"" +
           color + "\">" + words + "</text>\n";
}

std::string grid(const LogAxis& across, const LogAxis& up, const std::string& title) {
    std::string svg = "<path fill=\"none\" stroke=\"#ddd\" d=\"";
    for (int power = across.first; power <= across.last; ++power)
        svg += "M" + number(across(std::pow(10, power))) + " 0v" + number(side);
    for (int power = up.first; power <= up.last; ++power)
        svg += "M0 " + number(side - up(std::pow(10, power))) + "h" + number(side);
    svg += "\"/>\n";
    for (int power = across.first; power <= across.last; ++power)
        svg += text_at(across(std::pow(10, power)), side + 18, "middle",
                       grouped(static_cast<std::size_t>(std::llround(std::pow(10, power)))));
    for (int power = up.first; power <= up.last; ++power)
        svg += text_at(-8, side - up(std::pow(10, power)) + 4, "end", duration_text(std::pow(10, power)));
    return svg + text_at(side / 2, -14, "middle", title, "#000");
}

std::string curves(std::span<const RowFigures> rows, std::size_t RowFigures::*size, const LogAxis& across,
                   const LogAxis& up) {
    std::string svg;
    std::vector<std::pair<double, std::size_t>> ends; // height of each stage's last point, for its name
    for (std::size_t s = 0; s < growth_stages().size(); ++s) {
        const Stage& stage = growth_stages()[s];
        std::string path;
        double last = 0;
        for (const RowFigures& row : rows) {
            const double seconds = (row.*stage.seconds).median;
            if (!(seconds > 0)) continue;
            last = side - up(seconds);
            path += (path.empty() ? "M" : "L") + number(across(static_cast<double>(row.*size))) + " " +
                    number(last);
        }
        if (path.empty()) continue;
        svg += "<path fill=\"none\" stroke-width=\"2\" stroke=\"" + std::string(colors[s]) + "\" d=\"" +
               path + "\"/>\n";
        ends.emplace_back(last, s);
    }
    std::ranges::sort(ends);
    double free = 0; // names stand below each other, none on another
    for (auto& [height, s] : ends) {
        free = std::max(free, height + 4);
        svg += text_at(side + 8, free, "start", growth_stages()[s].name, colors[s]);
        free += 14;
    }
    return svg;
}

std::string diagram(std::span<const RowFigures> rows, std::size_t RowFigures::*size, const std::string& title,
                    double left) {
    Range sizes, seconds;
    for (const RowFigures& row : rows) {
        sizes.take(static_cast<double>(row.*size));
        for (const Stage& stage : growth_stages()) seconds.take((row.*stage.seconds).median);
    }
    const LogAxis across = sizes.axis(), up = seconds.axis();
    return "<g transform=\"translate(" + number(left + margin_left) + " " + number(margin_top) + ")\">\n" +
           grid(across, up, title) + curves(rows, size, across, up) + "</g>\n";
}

} // namespace

std::string growth_picture(const Growth& growth) {
    const double width = 2 * panel, height = margin_top + side + margin_bottom;
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(width) + "\" height=\"" +
           number(height) +
           "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
           "fill=\"#fff\"/>\n" +
           diagram(growth.by_points, &RowFigures::points, "seconds over points, about 1000 samples", 0) +
           diagram(growth.by_samples, &RowFigures::samples,
                   "seconds over samples, " +
                       grouped(growth.by_samples.empty() ? 0 : growth.by_samples.front().points) + " points",
                   panel) +
           "</svg>\n";
}

} // namespace knead
