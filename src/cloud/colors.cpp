#include "cloud/colors.h"

#include <algorithm>
#include <cmath>

namespace knead {

std::optional<std::array<std::size_t, 3>> find_colors(const PointCloud& cloud) {
    constexpr const char* names[][3] = {
        {"red", "green", "blue"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}, {"r", "g", "b"}};
    for (const auto& triple : names) {
        std::array<std::size_t, 3> columns{};
        bool found = true;
        for (std::size_t c = 0; c < 3 && found; ++c) {
            const std::optional<std::size_t> column = find_attribute(cloud, triple[c]);
            found = column && !cloud.attributes[*column].is_list();
            if (found) columns[c] = *column;
        }
        if (found) return columns;
    }
    return std::nullopt;
}

std::optional<std::size_t> find_intensity(const PointCloud& cloud) {
    for (const char* name : {"intensity", "Intensity", "scalar_Intensity", "reflectance"})
        if (const auto column = find_attribute(cloud, name); column && !cloud.attributes[*column].is_list())
            return column;
    return std::nullopt;
}

double brightest_value(const PointCloud& cloud, const std::array<std::size_t, 3>& columns) {
    double most = 0;
    bool fractions = true;
    for (const std::size_t column : columns) {
        const Attribute& attribute = cloud.attributes[column];
        if (attribute.type == ScalarType::uint8) return 255;
        fractions =
            fractions && (attribute.type == ScalarType::float32 || attribute.type == ScalarType::float64);
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            const double value = value_at(attribute, i);
            if (std::isfinite(value)) most = std::max(most, value);
        }
    }
    return fractions && most <= 1 ? 1 : most <= 255 ? 255 : 65535;
}

} // namespace knead
