#include "view/coloring.h"

#include "base/error.h"
#include "base/quoted.h"
#include "base/require.h"
#include "cloud/colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace knead {

namespace {

constexpr std::size_t grain = 16384;
constexpr std::uint32_t not_a_value = 0xff484848;

// Of what is not negative. std::lround() is a call, and this is done for every point.
std::uint32_t rounded(double value) {
    return static_cast<std::uint32_t>(value + 0.5); // NOLINT(bugprone-incorrect-roundings)
}

constexpr std::uint32_t white = 0xffffffffU;

std::uint32_t packed(double r, double g, double b) {
    const auto byte = [](double c) { return rounded(std::clamp(c, 0.0, 1.0) * 255); };
    return byte(r) | byte(g) << 8U | byte(b) << 16U | 0xff000000U;
}

std::uint32_t packed(const glm::vec3& color) {
    return packed(color.r, color.g, color.b);
}

// --- The file's colours ---

void color_as_in_file(const PointsToColor& points, const std::array<std::size_t, 3>& columns,
                      std::span<std::uint32_t> colors, Workers& workers) {
    const PointCloud& cloud = *points.cloud;
    const double brightest = brightest_value(cloud, columns);
    workers.for_each(colors.size(), grain, [&](std::size_t i) {
        const auto part = [&](std::size_t c) {
            const double value = value_at(cloud.attributes[columns[c]], points.file_index[i]) / brightest;
            return std::isfinite(value) ? value : 0.0;
        };
        colors[i] = packed(part(0), part(1), part(2));
    });
}

// --- Values by colour ---

// Of intensities: not from black to white, which no light could change.
constexpr double darkest_grey = 0.35, lightest_grey = 0.97;

// Tenths of the scale, from the authors' table (BIDS/colormap, CC0).
constexpr std::array<std::array<double, 3>, 11> viridis_tenths = {{{0.267004, 0.004874, 0.329415},
                                                                   {0.282623, 0.140926, 0.457517},
                                                                   {0.253935, 0.265254, 0.529983},
                                                                   {0.206756, 0.371758, 0.553117},
                                                                   {0.163625, 0.471133, 0.558148},
                                                                   {0.127568, 0.566949, 0.550556},
                                                                   {0.134692, 0.658636, 0.517649},
                                                                   {0.266941, 0.748751, 0.440573},
                                                                   {0.477504, 0.821444, 0.318195},
                                                                   {0.741388, 0.873449, 0.149561},
                                                                   {0.993248, 0.906157, 0.143936}}};

// An even spread of those that are finite, large enough to tell percentiles.
std::vector<float> some_of(std::span<const float> values) {
    constexpr std::size_t looked_at = 200'000;
    const std::size_t step = (values.size() + looked_at - 1) / looked_at;
    std::vector<float> some;
    for (std::size_t i = 0; i < values.size(); i += step)
        if (std::isfinite(values[i])) some.push_back(values[i]);
    return some;
}

// Of at least one value, whose order it changes.
double percentile(std::span<float> values, std::size_t hundredths) {
    const auto place = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * hundredths / 100);
    std::ranges::nth_element(values, place);
    return static_cast<double>(*place);
}

ValueRange usual_range(std::span<float> values) {
    if (values.empty()) return {};
    return {percentile(values, 1), percentile(values, 99)};
}

// The colour at `at`, 0 … 1, of a scale, in fine steps.
template<typename ColorAt>
std::array<std::uint32_t, 1024> scale_of(ColorAt&& color_at) {
    std::array<std::uint32_t, 1024> scale{};
    for (std::size_t i = 0; i < scale.size(); ++i)
        scale[i] = packed(color_at(static_cast<double>(i) / static_cast<double>(scale.size() - 1)));
    return scale;
}

// Where all values are equal, `middle` of the scale, 0 … 1.
void color_values(std::span<const float> values, const ValueRange& range, double middle,
                  const std::array<std::uint32_t, 1024>& scale, std::span<std::uint32_t> colors,
                  Workers& workers) {
    const double width = range.high - range.low;
    const double factor = width != 0 ? 1 / width : 0, offset = width != 0 ? 0 : middle;
    workers.for_each(colors.size(), grain, [&](std::size_t i) {
        const double value = values[i];
        const double at = std::clamp((value - range.low) * factor + offset, 0.0, 1.0);
        colors[i] = std::isfinite(value) ? scale[rounded(at * 1023)] : not_a_value;
    });
}

ValueRange color_values(std::span<const float> values, const std::optional<ValueRange>& given,
                        std::span<std::uint32_t> colors, Workers& workers) {
    ValueRange range;
    if (given) {
        range = *given;
    } else {
        std::vector<float> some = some_of(values);
        range = usual_range(some);
    }
    color_values(values, range, 0.5, scale_of(viridis), colors, workers);
    return range;
}

std::vector<float> heights(const PointsToColor& points, const Upward& up) {
    std::vector<float> values(points.positions.size() / 3);
    const auto axis = static_cast<std::size_t>(up.axis);
    const auto sign = static_cast<float>(up.sign);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = sign * points.positions[3 * i + axis];
    return values;
}

std::size_t column_called(const PointCloud& cloud, const std::string& name) {
    const std::optional<std::size_t> column = find_attribute(cloud, name);
    if (column && !cloud.attributes[*column].is_list()) return *column;
    std::string others;
    for (const std::string& other : scalar_columns(cloud)) others += (others.empty() ? "" : ", ") + other;
    throw Error(Trouble::usage, "",
                "the cloud has no column of numbers called " + quoted(name) +
                    (others.empty() ? "" : "; it has " + others));
}

std::vector<float> column_values(const PointsToColor& points, std::size_t column, Workers& workers) {
    std::vector<float> values(points.file_index.size());
    workers.for_each(values.size(), grain, [&](std::size_t i) {
        values[i] = static_cast<float>(value_at(points.cloud->attributes[column], points.file_index[i]));
    });
    return values;
}

// From the 1st to the 99th percentile, half of the points darker than the middle: most are dark, and a few
// mirrors are very bright. Where all are equal, as bright as `plain`.
void color_by_intensity(const PointsToColor& points, std::size_t column, const glm::vec3& plain,
                        std::span<std::uint32_t> colors, Workers& workers) {
    const std::vector<float> values = column_values(points, column, workers);
    std::vector<float> some = some_of(values);
    const ValueRange range = usual_range(some);
    double middle = 0.5;
    if (!some.empty() && range.high > range.low)
        middle = std::clamp((percentile(some, 50) - range.low) / (range.high - range.low), 0.05, 0.95);
    const double bend = std::log(0.5) / std::log(middle);
    const auto grey = scale_of([bend](double at) {
        return glm::vec3(
            static_cast<float>(darkest_grey + (lightest_grey - darkest_grey) * std::pow(at, bend)));
    });
    const double as_plain = (static_cast<double>(plain.g) - darkest_grey) / (lightest_grey - darkest_grey);
    color_values(values, range, as_plain, grey, colors, workers);
}

void color_by_normal(const PointsToColor& points, std::span<std::uint32_t> colors, Workers& workers) {
    workers.for_each(colors.size(), grain, [&](std::size_t i) {
        const auto part = [&](std::size_t c) {
            return 0.5 + 0.5 * static_cast<double>(points.normals[3 * i + c]);
        };
        colors[i] = packed(part(0), part(1), part(2));
    });
}

Legend color_by_height(const ColorBy& by, const PointsToColor& points, std::span<std::uint32_t> colors,
                       Workers& workers) {
    // Positions are relative to the origin; the scale is told in the file's coordinates.
    const auto [axis, sign] = upward(by.up);
    const double origin = sign * points.cloud->origin[static_cast<Eigen::Index>(axis)];
    std::optional<ValueRange> given = by.range;
    if (given) given = ValueRange{given->low - origin, given->high - origin};
    const ValueRange range = color_values(heights(points, upward(by.up)), given, colors, workers);
    return {"Height", by.range ? *by.range : ValueRange{range.low + origin, range.high + origin}};
}

} // namespace

glm::vec3 viridis(double at) {
    const double place = std::clamp(at, 0.0, 1.0) * 10;
    const auto tenth = std::min<std::size_t>(static_cast<std::size_t>(place), 9);
    const double share = place - static_cast<double>(tenth);
    glm::vec3 color;
    for (std::size_t c = 0; c < 3; ++c)
        color[static_cast<int>(c)] =
            static_cast<float>(viridis_tenths[tenth][c] * (1 - share) + viridis_tenths[tenth + 1][c] * share);
    return color;
}

OwnColors own_colors(const PointCloud& cloud) {
    if (find_colors(cloud)) return OwnColors::rgb;
    return find_intensity(cloud) ? OwnColors::intensity : OwnColors::none;
}

std::vector<std::string> scalar_columns(const PointCloud& cloud) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < cloud.attributes.size(); ++i)
        if (!cloud.attributes[i].is_list() &&
            std::ranges::find(cloud.coordinate_columns, i) == cloud.coordinate_columns.end())
            names.push_back(cloud.attributes[i].name);
    return names;
}

Legend color_points(const ColorBy& by, const PointsToColor& points, std::span<std::uint32_t> colors,
                    Workers& workers) {
    require(points.cloud && points.file_index.size() == colors.size() &&
                points.positions.size() == 3 * colors.size(),
            "a place and three coordinates a colour");
    switch (by.kind) {
    case ColorBy::Kind::own:
        if (const auto columns = find_colors(*points.cloud)) {
            color_as_in_file(points, *columns, colors, workers);
            // Whoever wrote white for all had no colours, and no light would tell the points apart.
            if (std::ranges::all_of(colors, [](std::uint32_t color) { return color == white; })) break;
            return {};
        }
        if (const auto column = find_intensity(*points.cloud)) {
            color_by_intensity(points, *column, by.plain, colors, workers);
            return {};
        }
        break;
    case ColorBy::Kind::plain:
        break;
    case ColorBy::Kind::height:
        return color_by_height(by, points, colors, workers);
    case ColorBy::Kind::normal:
        if (points.normals.empty()) break;
        color_by_normal(points, colors, workers);
        return {"normal", std::nullopt};
    case ColorBy::Kind::attribute:
        return {by.attribute,
                color_values(column_values(points, column_called(*points.cloud, by.attribute), workers),
                             by.range, colors, workers)};
    case ColorBy::Kind::values:
        require(points.values.size() == colors.size(), "a value a colour");
        return {by.title, color_values(points.values, by.range, colors, workers)};
    }
    std::ranges::fill(colors, packed(by.plain));
    return {};
}

} // namespace knead
