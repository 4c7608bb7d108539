#include "io/posed_values.h"

#include "base/error.h"
#include "base/require.h"
#include "io/turned_splats.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace knead {

namespace {

template<typename Integer>
std::optional<double> rounded_to_integer(double value) {
    const double whole = std::nearbyint(value);
    // The largest is 2^digits - 1, which no double is for 8 bytes. The comparison fails for NaN.
    const bool fits = whole >= static_cast<double>(std::numeric_limits<Integer>::min()) &&
                      whole < std::ldexp(1.0, std::numeric_limits<Integer>::digits);
    return fits ? std::optional(whole) : std::nullopt;
}

// A component of a normal as its column holds it. A turn may carry one of a whole type beyond its range, as
// -128 to 128.
double nearest_in(ScalarType type, double value) {
    if (!is_whole(type)) return value;
    const double highest = std::ldexp(1.0, 8 * static_cast<int>(size_of(type)) - 1) - 1;
    return std::clamp(std::nearbyint(value), -highest - 1, highest);
}

} // namespace

std::optional<double> rounded_to(ScalarType type, double value) {
    switch (type) {
    case ScalarType::int8:
        return rounded_to_integer<std::int8_t>(value);
    case ScalarType::uint8:
        return rounded_to_integer<std::uint8_t>(value);
    case ScalarType::int16:
        return rounded_to_integer<std::int16_t>(value);
    case ScalarType::uint16:
        return rounded_to_integer<std::uint16_t>(value);
    case ScalarType::int32:
        return rounded_to_integer<std::int32_t>(value);
    case ScalarType::uint32:
        return rounded_to_integer<std::uint32_t>(value);
    case ScalarType::int64:
        return rounded_to_integer<std::int64_t>(value);
    case ScalarType::uint64:
        return rounded_to_integer<std::uint64_t>(value);
    case ScalarType::float32:
        value = static_cast<double>(static_cast<float>(value));
        break;
    case ScalarType::float64:
        break;
    }
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::vector<PosedColumn> posed_columns(const PointCloud& cloud, const PosedShape& shape) {
    std::vector<PosedColumn> columns;
    const auto add = [&](std::size_t column, const float* rest, const float* posed) {
        const Attribute& attribute = cloud.attributes[column];
        columns.push_back({column, &attribute, attribute.type, rest, posed, nullptr, 0});
    };
    if (!shape.positions.empty()) {
        require(shape.positions.size() == cloud.positions.size(), "a pose has a position for each point");
        for (std::size_t axis = 0; axis < 3; ++axis)
            add(cloud.coordinate_columns[axis], cloud.positions.data() + axis, shape.positions.data() + axis);
    }
    const auto normals = find_normals(cloud);
    if (!shape.normals.empty() && normals) {
        require(shape.normals.size() == cloud.positions.size(), "a pose has a normal for each point");
        for (std::size_t axis = 0; axis < 3; ++axis)
            add((*normals)[axis], nullptr, shape.normals.data() + axis);
    }
    if (const auto splats = find_splats(cloud); splats && !shape.rotations.empty()) {
        const auto turned = std::make_shared<TurnedSplats>(cloud, *splats, shape.rotations);
        for (std::size_t slot = 0; slot < turned->columns().size(); ++slot) {
            const std::size_t column = turned->columns()[slot];
            const Attribute& attribute = cloud.attributes[column];
            columns.push_back({column, &attribute, attribute.type, nullptr, nullptr, turned, slot});
        }
    }
    std::sort(columns.begin(), columns.end(),
              [](const PosedColumn& a, const PosedColumn& b) { return a.column < b.column; });
    return columns;
}

std::optional<double> posed_value(const PosedColumn& column, std::size_t i, const std::string& shown) {
    const double own = value_at(*column.attribute, i);
    if (column.splats) {
        const double turned = column.splats->value(i, column.slot);
        // What is not finite stays as it was.
        const auto rounded = turned == own ? std::nullopt : rounded_to(column.type, turned);
        return rounded == own ? std::nullopt : rounded;
    }
    const float posed = column.posed[3 * i];
    if (column.rest == nullptr) {
        // A normal with no direction stays as it was: normals are turned, never invented.
        if (!std::isfinite(posed) || posed == static_cast<float>(own)) return std::nullopt;
        const double turned = nearest_in(column.type, static_cast<double>(posed));
        return turned == own ? std::nullopt : std::optional(turned);
    }
    const float rest = column.rest[3 * i];
    if (posed == rest || !std::isfinite(rest)) return std::nullopt;
    const double value = own + (static_cast<double>(posed) - static_cast<double>(rest));
    const auto rounded = rounded_to(column.type, value);
    if (!rounded)
        throw Error(Trouble::output, shown,
                    "point " + std::to_string(i) + " moves to " + column.attribute->name + " = " +
                        std::to_string(value) + ", which the file's type " +
                        std::string(name_of(column.type)) + " cannot hold; move it less" +
                        (is_whole(column.type) ? ", or save in another format, where it has fractions" : ""));
    if (*rounded == own) return std::nullopt;
    return rounded;
}

} // namespace knead
