#include "io/compare.h"

#include "base/require.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <unordered_map>

namespace knead {

namespace {

bool same(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

// The distance of two points, or nothing where they cannot be compared.
std::optional<double> distance(const Vec3d& a, const Vec3d& b) {
    if (a.allFinite() && b.allFinite()) return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    Vec3d way = a - b;
    for (int axis = 0; axis < 3; ++axis)
        if (same(a[axis], b[axis])) way[axis] = 0; // neither is there, or both are as far
    if (!way.allFinite()) return std::nullopt;
    return std::hypot(way[0], way[1], way[2]);
}

template<typename Position>
Distances distances(std::size_t points, const Position& position, const PointCloud& other) {
    require(points == other.size(), "distances are between the same points");
    Distances result;
    std::vector<double> all;
    all.reserve(points);
    double sum = 0;
    for (std::size_t i = 0; i < points; ++i) {
        const auto d = distance(position(i), other.file_position(i));
        if (!d) {
            if (result.incomparable++ == 0) result.first_incomparable = i;
            continue;
        }
        all.push_back(*d);
        sum += *d * *d;
        if (*d > result.largest) {
            result.largest = *d;
            result.largest_index = i;
        }
    }
    result.compared = all.size();
    if (all.empty()) return result;
    result.rms = std::sqrt(sum / static_cast<double>(all.size()));
    // The nearest rank: the smallest distance that at least 95 % do not exceed.
    const std::size_t rank = (95 * all.size() + 99) / 100 - 1;
    const auto at = all.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(all.begin(), at, all.end());
    result.p95 = *at;
    return result;
}

// Where the columns of each name are, so that many columns are found in no more time than few.
using Places = std::unordered_map<std::string_view, std::size_t>;

Places places_of(const PointCloud& cloud) {
    Places places;
    for (std::size_t a = 0; a < cloud.attributes.size(); ++a) places.try_emplace(cloud.attributes[a].name, a);
    return places;
}

bool is_coordinate(const PointCloud& cloud, std::size_t column) {
    const auto& columns = cloud.coordinate_columns;
    return std::find(columns.begin(), columns.end(), column) != columns.end();
}

bool are_of_one_type(const Attribute& a, const Attribute& b) {
    return a.type == b.type && a.is_list() == b.is_list() && (!a.is_list() || a.count_type == b.count_type);
}

bool are_equal(const Attribute& a, const Attribute& b) {
    return are_of_one_type(a, b) && a.first == b.first && a.values == b.values;
}

// The numbers of one point in a column.
struct Row {
    std::size_t begin, count;
};

Row row_of(const Attribute& attribute, std::size_t point) {
    if (!attribute.is_list()) return {point, 1};
    const std::uint64_t begin = attribute.first[point];
    return {begin, attribute.first[point + 1] - begin};
}

// The same bits where they can be; so 0 and -0 are two, as they are in the file.
bool are_equal(const Attribute& a, std::size_t at, const Attribute& b, std::size_t other) {
    if (a.type != b.type) return same(value_at(a, at), value_at(b, other));
    const std::size_t bytes = size_of(a.type);
    return std::memcmp(&a.values[bytes * at], &b.values[bytes * other], bytes) == 0;
}

AttributeDifference difference_of(const Attribute& a, const Attribute& b, std::size_t points) {
    AttributeDifference difference;
    difference.name = a.name;
    difference.same_type = are_of_one_type(a, b);
    for (std::size_t i = 0; i < points; ++i) {
        const Row own = row_of(a, i), other = row_of(b, i);
        bool differs = own.count != other.count;
        for (std::size_t k = 0; k < std::min(own.count, other.count); ++k) {
            if (are_equal(a, own.begin + k, b, other.begin + k)) continue;
            differs = true;
            const double distance = std::abs(value_at(a, own.begin + k) - value_at(b, other.begin + k));
            if (!std::isfinite(distance) || distance <= difference.largest) continue;
            difference.largest = distance;
            difference.farthest_point = i;
        }
        if (differs) ++difference.points;
    }
    return difference;
}

// How far from a value of that type one can be that was rounded to it, and a little more for sums of both.
double most_rounded(ScalarType type, double value) {
    constexpr double a_little_more = 1 + 1e-6;
    if (is_whole(type)) return 0.5 * a_little_more;
    if (type != ScalarType::float32 || !std::isfinite(value)) return 0;
    const float size = std::abs(static_cast<float>(value));
    const float next = std::nextafter(size, std::numeric_limits<float>::infinity());
    return 0.5 * a_little_more * (static_cast<double>(next) - static_cast<double>(size));
}

} // namespace

Distances distances_between(const PointCloud& a, const PointCloud& b) {
    return distances(
        a.size(), [&](std::size_t i) { return a.file_position(i); }, b);
}

Distances distances_between(const PointCloud& cloud, std::span<const float> positions,
                            const PointCloud& other) {
    require(positions.size() == cloud.positions.size(), "a pose has a position for each point");
    const auto posed = [&](std::size_t i) {
        Vec3d p = cloud.file_position(i);
        const Vec3d there = other.file_position(i);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double now = positions[3 * i + axis];
            const double rest = cloud.positions[3 * i + axis];
            double& coordinate = p[static_cast<Eigen::Index>(axis)];
            // What is not finite at rest keeps its own value, as it does when it is saved.
            if (std::isfinite(rest)) coordinate += now - rest;
            const ScalarType type = other.attributes[other.coordinate_columns[axis]].type;
            const double saved = there[static_cast<Eigen::Index>(axis)];
            if (std::abs(coordinate - saved) <= most_rounded(type, saved)) coordinate = saved;
        }
        return p;
    };
    return distances(cloud.size(), posed, other);
}

AttributeDifferences attribute_differences(const PointCloud& a, const PointCloud& b) {
    require(a.size() == b.size(), "attributes are of the same points");
    AttributeDifferences differences;
    const Places in_a = places_of(a), in_b = places_of(b);
    for (std::size_t column = 0; column < a.attributes.size(); ++column) {
        if (is_coordinate(a, column)) continue;
        const Attribute& own = a.attributes[column];
        const auto other = in_b.find(own.name);
        if (other == in_b.end())
            differences.only_in_a.push_back(own.name);
        else if (!are_equal(own, b.attributes[other->second]))
            differences.differ.push_back(difference_of(own, b.attributes[other->second], a.size()));
    }
    for (std::size_t column = 0; column < b.attributes.size(); ++column)
        if (!is_coordinate(b, column) && !in_a.contains(b.attributes[column].name))
            differences.only_in_b.push_back(b.attributes[column].name);
    return differences;
}

} // namespace knead
