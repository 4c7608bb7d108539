#include "cloud/point_cloud.h"

#include "base/require.h"
#include "cloud/main_part.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace knead {

namespace {

template<typename T>
T load(const std::byte* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
}

template<typename T>
void append_column(PointCloud& cloud, std::string name, ScalarType type, std::span<const T> values) {
    Attribute attribute{std::move(name), type, {}, {}, ScalarType::uint8};
    const auto bytes = std::as_bytes(values);
    attribute.values.assign(bytes.begin(), bytes.end());
    cloud.attributes.push_back(std::move(attribute));
}

template<typename T>
void load_all(const std::byte* from, std::span<double> to) {
    for (double& value : to) {
        value = static_cast<double>(load<T>(from));
        from += sizeof(T);
    }
}

// Scalars begin … begin + to.size() of a column, as value_at() would give them, without a choice for each.
void load_values(const Attribute& attribute, std::size_t begin, std::span<double> to) {
    const std::byte* from = attribute.values.data() + begin * size_of(attribute.type);
    switch (attribute.type) {
    case ScalarType::int8:
        return load_all<std::int8_t>(from, to);
    case ScalarType::uint8:
        return load_all<std::uint8_t>(from, to);
    case ScalarType::int16:
        return load_all<std::int16_t>(from, to);
    case ScalarType::uint16:
        return load_all<std::uint16_t>(from, to);
    case ScalarType::int32:
        return load_all<std::int32_t>(from, to);
    case ScalarType::uint32:
        return load_all<std::uint32_t>(from, to);
    case ScalarType::int64:
        return load_all<std::int64_t>(from, to);
    case ScalarType::uint64:
        return load_all<std::uint64_t>(from, to);
    case ScalarType::float32:
        return load_all<float>(from, to);
    case ScalarType::float64:
        return load_all<double>(from, to);
    }
}

constexpr double largest_float = std::numeric_limits<float>::max();

// Some points in the file's coordinates.
struct PositionBlock {
    static constexpr std::size_t capacity = 1024;
    std::size_t size = 0;
    std::array<std::array<double, capacity>, 3> values;

    Vec3d point(std::size_t i) const { return {values[0][i], values[1][i], values[2][i]}; }
};

// Calls work(number of the block's first point, block) for all points in turn.
template<typename Work>
void for_blocks(const PointCloud& cloud, std::size_t points, Work&& work) {
    PositionBlock block;
    for (std::size_t begin = 0; begin < points; begin += PositionBlock::capacity) {
        block.size = std::min(PositionBlock::capacity, points - begin);
        for (std::size_t axis = 0; axis < 3; ++axis)
            load_values(cloud.attributes[cloud.coordinate_columns[axis]], begin,
                        std::span(block.values[axis]).first(block.size));
        work(begin, block);
    }
}

// The number of points that the coordinate columns hold.
std::size_t check_coordinates(const PointCloud& cloud) {
    std::size_t points = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Attribute& column = cloud.attributes.at(cloud.coordinate_columns[axis]);
        const std::size_t values = column.values.size() / size_of(column.type);
        require(!column.is_list(), "a coordinate is one number");
        require(axis == 0 || values == points, "the coordinate columns are equally long");
        points = values;
    }
    return points;
}

using NormalColumns = std::array<std::size_t, 3>;

// Whole numbers with a sign are directions whatever their unit; without one, nobody knows where their zero
// is.
bool holds_directions(ScalarType type) {
    return !is_whole(type) || type == ScalarType::int8 || type == ScalarType::int16 ||
           type == ScalarType::int32;
}

// Whether three columns are of one unit, and say where it points.
bool are_directions(const PointCloud& cloud, const NormalColumns& columns) {
    const ScalarType first = cloud.attributes[columns[0]].type;
    return std::ranges::all_of(columns, [&](std::size_t column) {
        const ScalarType type = cloud.attributes[column].type;
        return holds_directions(type) && (type == first || !(is_whole(type) || is_whole(first)));
    });
}

// The first columns that are called as normals are, of one number a point, and of which is_right(columns).
template<typename IsRight>
std::optional<NormalColumns> first_normals(const PointCloud& cloud, IsRight&& is_right) {
    constexpr std::array<std::string_view, 3> spellings[] = {{"nx", "ny", "nz"},
                                                             {"normal_x", "normal_y", "normal_z"},
                                                             {"NormalX", "NormalY", "NormalZ"},
                                                             {"Nx", "Ny", "Nz"}};
    for (const auto& names : spellings) {
        NormalColumns columns{};
        std::size_t found = 0;
        for (const std::string_view name : names) {
            const auto column = find_attribute(cloud, name);
            if (!column || cloud.attributes[*column].is_list()) break;
            columns[found++] = *column;
        }
        if (found == 3 && is_right(columns)) return columns;
    }
    return std::nullopt;
}

} // namespace

std::size_t size_of(ScalarType type) {
    switch (type) {
    case ScalarType::int8:
    case ScalarType::uint8:
        return 1;
    case ScalarType::int16:
    case ScalarType::uint16:
        return 2;
    case ScalarType::int32:
    case ScalarType::uint32:
    case ScalarType::float32:
        return 4;
    case ScalarType::int64:
    case ScalarType::uint64:
    case ScalarType::float64:
        return 8;
    }
    require(false, "a scalar type without a size");
    return 0;
}

std::string_view name_of(ScalarType type) {
    constexpr std::string_view names[] = {"int8",   "uint8", "int16",  "uint16",  "int32",
                                          "uint32", "int64", "uint64", "float32", "float64"};
    return names[static_cast<std::size_t>(type)];
}

bool is_whole(ScalarType type) {
    return type != ScalarType::float32 && type != ScalarType::float64;
}

double value_at(const Attribute& attribute, std::size_t at) {
    const std::byte* from = attribute.values.data() + at * size_of(attribute.type);
    switch (attribute.type) {
    case ScalarType::int8:
        return load<std::int8_t>(from);
    case ScalarType::uint8:
        return load<std::uint8_t>(from);
    case ScalarType::int16:
        return load<std::int16_t>(from);
    case ScalarType::uint16:
        return load<std::uint16_t>(from);
    case ScalarType::int32:
        return load<std::int32_t>(from);
    case ScalarType::uint32:
        return load<std::uint32_t>(from);
    case ScalarType::int64:
        return static_cast<double>(load<std::int64_t>(from));
    case ScalarType::uint64:
        return static_cast<double>(load<std::uint64_t>(from));
    case ScalarType::float32:
        return static_cast<double>(load<float>(from));
    case ScalarType::float64:
        return load<double>(from);
    }
    require(false, "a scalar type without a value");
    return 0;
}

Vec3d PointCloud::file_position(std::size_t i) const {
    return {value_at(attributes[coordinate_columns[0]], i), value_at(attributes[coordinate_columns[1]], i),
            value_at(attributes[coordinate_columns[2]], i)};
}

std::optional<std::size_t> find_attribute(const PointCloud& cloud, std::string_view name) {
    for (std::size_t a = 0; a < cloud.attributes.size(); ++a)
        if (cloud.attributes[a].name == name) return a;
    return std::nullopt;
}

std::optional<std::array<std::size_t, 3>> find_normal_names(const PointCloud& cloud) {
    return first_normals(cloud, [](const NormalColumns&) { return true; });
}

std::optional<std::array<std::size_t, 3>> find_normals(const PointCloud& cloud) {
    return first_normals(cloud, [&](const NormalColumns& columns) { return are_directions(cloud, columns); });
}

std::vector<float> read_normals(const PointCloud& cloud) {
    const auto columns = find_normals(cloud);
    if (!columns) return {};
    std::vector<float> normals(3 * cloud.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Attribute& column = cloud.attributes[(*columns)[axis]];
        for (std::size_t i = 0; i < cloud.size(); ++i)
            normals[3 * i + axis] = static_cast<float>(value_at(column, i));
    }
    return normals;
}

bool is_finite(const PointCloud& cloud, std::size_t i) {
    const float* p = cloud.positions.data() + 3 * i;
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

void set_positions_from_columns(PointCloud& cloud) {
    const std::size_t points = check_coordinates(cloud);
    const MainPart main = main_part_of(cloud, points);
    Vec3d lowest = Vec3d::Constant(std::numeric_limits<double>::infinity());
    Vec3d highest = -lowest;
    for_blocks(cloud, points, [&](std::size_t /*begin*/, const PositionBlock& block) {
        for (std::size_t i = 0; i < block.size; ++i) {
            const Vec3d p = block.point(i);
            // What no float can hold would push all other points out of reach as well. False for NaN, too.
            if (!(p.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= largest_float) || main.is_far(p)) continue;
            lowest = lowest.cwiseMin(p);
            highest = highest.cwiseMax(p);
        }
    });
    const bool is_lost = main.is_lost_in((highest - lowest).norm());
    const Vec3d middle = is_lost ? main.middle : Vec3d(0.5 * lowest + 0.5 * highest);
    cloud.origin = middle.allFinite() ? middle : Vec3d::Zero();
    cloud.positions.resize(3 * points);
    for_blocks(cloud, points, [&](std::size_t begin, const PositionBlock& block) {
        float* to = cloud.positions.data() + 3 * begin;
        for (std::size_t i = 0; i < block.size; ++i) {
            const bool is_far = main.is_far(block.point(i));
            for (std::size_t axis = 0; axis < 3; ++axis)
                *to++ =
                    is_far ? std::numeric_limits<float>::quiet_NaN()
                           : static_cast<float>(block.values[axis][i] - cloud.origin[static_cast<int>(axis)]);
        }
    });
}

PointCloud make_cloud(std::span<const float> positions) {
    require(positions.size() % 3 == 0, "three coordinates a point");
    PointCloud cloud;
    std::vector<float> column(positions.size() / 3);
    const char* const names[] = {"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < column.size(); ++i) column[i] = positions[3 * i + axis];
        cloud.coordinate_columns[axis] = axis;
        add_attribute(cloud, names[axis], column);
    }
    set_positions_from_columns(cloud);
    return cloud;
}

void add_attribute(PointCloud& cloud, std::string name, std::span<const float> values) {
    append_column(cloud, std::move(name), ScalarType::float32, values);
}

void add_attribute(PointCloud& cloud, std::string name, std::span<const std::uint8_t> values) {
    append_column(cloud, std::move(name), ScalarType::uint8, values);
}

Bounds bounds_of(const PointCloud& cloud) {
    Bounds bounds;
    for_blocks(cloud, cloud.size(), [&](std::size_t begin, const PositionBlock& block) {
        for (std::size_t i = 0; i < block.size; ++i) {
            if (!is_finite(cloud, begin + i)) continue;
            const Vec3d p = block.point(i);
            bounds.lowest = bounds.finite_points == 0 ? p : Vec3d(bounds.lowest.cwiseMin(p));
            bounds.highest = bounds.finite_points == 0 ? p : Vec3d(bounds.highest.cwiseMax(p));
            ++bounds.finite_points;
        }
    });
    return bounds;
}

} // namespace knead
