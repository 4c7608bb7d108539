#pragma once
// Coordinates from formats whose text does not say how precise its numbers are.

#include "cloud/point_cloud.h"

#include <array>
#include <cstddef>
#include <string_view>

namespace knead {

// Collects the coordinates of points and makes the columns x, y and z of them. They are of type float32 where
// that tells all numbers of the file apart, and is fine enough for edits: no more than seven significant
// digits, and six where floats lie farther apart than the seventh (from 0.0009765625 to 0.001, say); nothing
// beyond the range in which floats have their full precision, 1.2e-38 … 3.4e38, but 0 and what is not finite;
// and no point farther from the origin than eight times the diagonal of all. Else they are float64. A number
// that is saved after an edit is written in the digits of that type.
class TextCoordinates {
public:
    TextCoordinates();

    std::size_t points() const { return columns_[0].values.size() / sizeof(double); }

    // The number of the next point's coordinate on this axis (0, 1, 2), and the word that it was read from.
    void add(std::size_t axis, double value, std::string_view word);

    // Puts the columns in front of those of the cloud, and positions from them. To be called once, last.
    void finish(PointCloud& cloud);

private:
    bool float_is_enough() const;

    std::array<Attribute, 3> columns_;           // of doubles
    bool floats_tell_apart_ = true;              // the finite numbers so far
    std::array<double, 3> lowest_{}, highest_{}; // of the finite numbers
    double farthest_ = 0;
};

} // namespace knead
