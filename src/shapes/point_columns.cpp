#include "shapes/point_columns.h"

#include <cstring>
#include <utility>

namespace knead {

namespace {

void append_columns(PointCloud& cloud, std::array<const char*, 3> names, ScalarType type,
                    std::size_t points) {
    for (const char* name : names) {
        Attribute attribute{name, type, {}, {}, ScalarType::uint8};
        attribute.values.resize(points * size_of(type));
        cloud.attributes.push_back(std::move(attribute));
    }
}

void put_vector(PointCloud& cloud, std::size_t first_column, std::size_t i, const Vec3d& vector) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float value = static_cast<float>(vector[static_cast<Eigen::Index>(axis)]);
        std::memcpy(cloud.attributes[first_column + axis].values.data() + i * sizeof value, &value,
                    sizeof value);
    }
}

} // namespace

PointColumns make_columns(std::size_t points, WithNormals normals, WithColours colours) {
    PointColumns columns;
    columns.normals = normals == WithNormals::yes;
    columns.colours = colours == WithColours::yes;
    append_columns(columns.cloud, {"x", "y", "z"}, ScalarType::float32, points);
    if (columns.normals) append_columns(columns.cloud, {"nx", "ny", "nz"}, ScalarType::float32, points);
    if (columns.colours) append_columns(columns.cloud, {"red", "green", "blue"}, ScalarType::uint8, points);
    columns.cloud.coordinate_columns = {0, 1, 2};
    return columns;
}

void put_point(PointColumns& columns, std::size_t i, const Vec3d& position, const Vec3d& normal,
               Colour colour) {
    put_vector(columns.cloud, 0, i, position);
    if (columns.normals) put_vector(columns.cloud, 3, i, normal);
    if (!columns.colours) return;
    const std::size_t red = columns.normals ? 6 : 3;
    for (std::size_t channel = 0; channel < 3; ++channel)
        columns.cloud.attributes[red + channel].values[i] = std::byte{colour[channel]};
}

PointCloud finish(PointColumns&& columns) {
    set_positions_from_columns(columns.cloud);
    return std::move(columns.cloud);
}

} // namespace knead
