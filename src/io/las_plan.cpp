#include "io/las_plan.h"

#include "base/lower_case.h"
#include "cloud/colors.h"
#include "io/text_numbers.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace knead {

namespace {

bool is_colour(std::string_view name) {
    return name == "red" || name == "green" || name == "blue";
}

double most_that(const LasDimension& dimension) {
    const unsigned bits =
        dimension.bits > 0 ? dimension.bits : static_cast<unsigned>(8 * size_of(dimension.type));
    const bool is_signed = dimension.type == ScalarType::int8 || dimension.type == ScalarType::int16;
    return std::ldexp(1.0, static_cast<int>(bits - (is_signed ? 1 : 0))) - 1;
}

// Whether all values are such that the place holds them exactly. Normals and the like never go to such
// places, so the cloud's own values are those that are saved.
bool fits(const NewColumn& column, std::size_t points, const LasDimension& dimension) {
    if (dimension.type == ScalarType::float64) return !is_whole(column.type);
    const double most = most_that(dimension);
    const bool is_signed = dimension.type == ScalarType::int8 || dimension.type == ScalarType::int16;
    for (std::size_t i = 0; i < points; ++i) {
        const double value = new_value(column, i, "");
        if (!(value >= (is_signed ? -most - 1 : 0) && value <= most) || value != std::floor(value))
            return false;
    }
    return true;
}

// The columns' places among the dimensions of a point; nothing for a column without one.
using Places = std::vector<std::optional<LasDimension>>;

// The dimension of this name, letter case aside; null for none.
const LasDimension* named(const std::vector<LasDimension>& dimensions, const std::string& name) {
    const std::string wanted = lower_case(name);
    const auto found = std::find_if(dimensions.begin(), dimensions.end(),
                                    [&](const LasDimension& d) { return d.name == wanted; });
    return found != dimensions.end() ? &*found : nullptr;
}

Places places_in(unsigned format, const std::vector<NewColumn>& columns, std::size_t points) {
    std::vector<LasDimension> dimensions = las_dimensions(format);
    dimensions.erase(dimensions.begin(), dimensions.begin() + 3); // the coordinates
    Places places;
    for (const NewColumn& column : columns) {
        const LasDimension* const found = named(dimensions, column.name);
        const bool fitting = found != nullptr && fits(column, points, *found);
        places.push_back(fitting ? std::optional(*found) : std::nullopt);
        // A place is for one column only.
        if (fitting) dimensions.erase(dimensions.begin() + (found - dimensions.data()));
    }
    // Colours are three or none.
    std::size_t colours = 0;
    for (const auto& place : places) colours += place && is_colour(place->name) ? 1U : 0U;
    if (colours < 3)
        for (auto& place : places)
            if (place && is_colour(place->name)) place.reset();
    return places;
}

bool has_place(const Places& places, std::string_view name) {
    return std::any_of(places.begin(), places.end(),
                       [&](const auto& place) { return place && place->name == name; });
}

// What makes a colour of this column fill 16 bits. Columns of 16 bits and more stay as they are, also where
// they hold bytes.
double colour_factor(const PointCloud& cloud, const NewColumn& column) {
    if (column.type == ScalarType::uint8) return 256;
    const auto colours = find_colors(cloud);
    if (is_whole(column.type) || !colours) return 1;
    const double brightest = brightest_value(cloud, *colours);
    return brightest == 1 ? 65535 : brightest == 255 ? 256 : 1;
}

// Chooses the format: the largest of a family offers all places, and those that are taken tell which it is.
void choose_format(const std::vector<NewColumn>& columns, std::size_t points, LasPlan& plan) {
    const Places legacy = places_in(3, columns, points);
    if (std::all_of(legacy.begin(), legacy.end(), [](const auto& place) { return place.has_value(); })) {
        plan.minor = 2;
        plan.point_format = (has_place(legacy, "gps_time") ? 1U : 0U) + (has_place(legacy, "red") ? 2U : 0U);
        return;
    }
    const Places wide = places_in(8, columns, points);
    plan.minor = 4;
    plan.point_format = !has_place(wide, "red") ? 6 : has_place(wide, "nir") ? 8 : 7;
}

// Takes the coordinates and what LAS cannot hold out of the columns.
void set_aside(const PointCloud& cloud, std::vector<NewColumn>& columns, LasPlan& plan,
               std::vector<std::string>& heard) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        plan.coordinates[axis] = columns[cloud.coordinate_columns[axis]];
    std::vector<NewColumn> others;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        if (std::find(cloud.coordinate_columns.begin(), cloud.coordinate_columns.end(), c) !=
            cloud.coordinate_columns.end())
            continue;
        if (columns[c].is_list())
            heard.push_back("the list " + in_quotes(columns[c].name) + " is left out: LAS holds none");
        else
            others.push_back(std::move(columns[c]));
    }
    columns = std::move(others);
}

} // namespace

LasPlan plan_las(const PointCloud& cloud, std::vector<NewColumn> columns, std::vector<std::string>& heard) {
    constexpr std::size_t longest_name = 32;
    constexpr std::size_t most_extra = 65535 / las_descriptor_size; // of one record
    LasPlan plan;
    set_aside(cloud, columns, plan, heard);
    choose_format(columns, cloud.size(), plan);
    const auto is_legal = [](char letter) { return static_cast<unsigned char>(letter) >= ' '; };
    for (std::string& words : make_names_legal(columns, is_legal, longest_name))
        heard.push_back(std::move(words));
    plan.point_length = las_point_size(plan.point_format);
    const Places places = places_in(plan.point_format, columns, cloud.size());
    const std::vector<LasDimension> dimensions = las_dimensions(plan.point_format);
    for (std::size_t c = 0; c < columns.size(); ++c) {
        NewColumn& column = columns[c];
        if (places[c]) {
            const double factor = is_colour(places[c]->name) ? colour_factor(cloud, column) : 1;
            plan.fields.push_back({column, *places[c], factor, false});
        } else if (plan.extra_columns == most_extra) {
            heard.push_back("the column " + in_quotes(column.name) +
                            " is left out: LAS describes no more than " + std::to_string(most_extra));
        } else {
            plan.fields.push_back(
                {column, {column.name, column.type, plan.point_length, 0, 0, false, {}}, 1, true});
            plan.point_length += size_of(column.type);
            ++plan.extra_columns;
            if (named(dimensions, column.name))
                heard.push_back("the column " + in_quotes(column.name) +
                                " becomes extra bytes, since its values do not fit LAS's own");
        }
    }
    for (const LasDimension& dimension : dimensions)
        if (dimension.name == "return_number" || dimension.name == "number_of_returns")
            if (!has_place(places, dimension.name)) plan.ones.push_back(dimension);
    return plan;
}

} // namespace knead
