#pragma once
// What a posed shape changes in the columns of a cloud, for the writers of all formats.

#include "io/cloud_file.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace knead {

class TurnedSplats;

// One column that a pose may change: a coordinate, a normal's component, or one that turns with a splat.
struct PosedColumn {
    std::size_t column = 0; // in the cloud's attributes
    const Attribute* attribute = nullptr;
    ScalarType type = ScalarType::float32; // that its values are rounded to: the attribute's, or in a new
                                           // file another one that holds more
    const float* rest = nullptr;  // a coordinate's value at rest for point i is rest[3 * i]; else null
    const float* posed = nullptr; // and posed[3 * i] the posed value; null for one of a splat

    // Whose column number `slot` this is, shared by all of them; null for what is no splat's.
    std::shared_ptr<TurnedSplats> splats;
    std::size_t slot = 0;
};

// The columns to look at, in the order of the cloud's attributes; none for an empty shape. They point into
// the cloud and the shape.
std::vector<PosedColumn> posed_columns(const PointCloud& cloud, const PosedShape& shape);

// The value to save for point i, already rounded to the column's `type`; nothing where it keeps its own.
// The columns of splats are told one thread at a time, and quickly only if those of a point are asked for one
// after the other. `shown` names the target in errors. Throws Error (output) when the value does not fit.
std::optional<double> posed_value(const PosedColumn& column, std::size_t i, const std::string& shown);

// The nearest value that the type holds; nothing where it holds none near.
std::optional<double> rounded_to(ScalarType type, double value);

} // namespace knead
