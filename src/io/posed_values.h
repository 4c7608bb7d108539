#pragma once
// What a posed shape changes in the columns of a cloud, for the writers of all formats.

#include "io/cloud_file.h"

#include <optional>
#include <string>
#include <vector>

namespace knead {

// One column that a pose may change: a coordinate, or a normal's component.
struct PosedColumn {
    std::size_t column = 0; // in the cloud's attributes
    const Attribute* attribute = nullptr;
    const float* rest = nullptr; // a coordinate's value at rest for point i is rest[3 * i]; null for a normal
    const float* posed = nullptr; // and posed[3 * i] the posed value
};

// The columns to look at, in the order of the cloud's attributes; none for an empty shape. They point into
// the cloud and the shape.
std::vector<PosedColumn> posed_columns(const PointCloud& cloud, const PosedShape& shape);

// The value to save for point i, already rounded to the column's type; nothing where it keeps its own.
// `shown` names the target in errors. Throws Error (output) when the value does not fit.
std::optional<double> posed_value(const PosedColumn& column, std::size_t i, const std::string& shown);

// The nearest value that the type holds; nothing where it holds none near.
std::optional<double> rounded_to(ScalarType type, double value);

} // namespace knead
