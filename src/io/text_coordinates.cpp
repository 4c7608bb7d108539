#include "io/text_coordinates.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <vector>

namespace knead {

namespace {

constexpr int digits_of_float = 7;
constexpr double farthest_diagonals = 8; // a float there lies within a millionth of the diagonal of the next

// Significant digits: neither zeros in front nor zeros behind count.
int significant_digits(std::string_view word) {
    int digits = 0;
    int zeros = 0; // since the last other digit
    for (const char letter : word) {
        if (letter == 'e' || letter == 'E') break;
        if (letter == '0' && digits > 0) ++zeros;
        if (letter < '1' || letter > '9') continue;
        digits += zeros + 1;
        zeros = 0;
    }
    return digits;
}

// Whether the float next to a number is next to no other number of as many digits, seven at most. Floats lie
// closer together than numbers of six digits wherever they have their full precision, and mostly closer than
// those of seven; not so from a power of two just below a power of ten up to that, as from 2^-10 to 0.001.
bool float_tells(double value, std::string_view word) {
    using Limits = std::numeric_limits<float>;
    const double magnitude = std::abs(value);
    if (magnitude == 0) return true;
    if (magnitude < static_cast<double>(Limits::min()) || magnitude > static_cast<double>(Limits::max()))
        return false;
    if (word.size() < digits_of_float) return true; // as most are
    const int digits = significant_digits(word);
    if (digits != digits_of_float) return digits < digits_of_float;
    const double step = std::ldexp(1.0, std::ilogb(magnitude) - (Limits::digits - 1));
    const double last_digit = std::pow(10.0, std::floor(std::log10(magnitude)) - (digits_of_float - 1));
    return step <= last_digit;
}

void narrow(Attribute& column) {
    std::vector<std::byte> floats(column.values.size() / 2);
    for (std::size_t i = 0; i < floats.size() / sizeof(float); ++i) {
        const float value = static_cast<float>(value_at(column, i));
        std::memcpy(floats.data() + i * sizeof value, &value, sizeof value);
    }
    column.values = std::move(floats);
    column.type = ScalarType::float32;
}

} // namespace

TextCoordinates::TextCoordinates() {
    constexpr std::array<const char*, 3> names = {"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; ++axis)
        columns_[axis] = {names[axis], ScalarType::float64, {}, {}, ScalarType::uint8};
    lowest_.fill(std::numeric_limits<double>::infinity());
    highest_.fill(-std::numeric_limits<double>::infinity());
}

void TextCoordinates::add(std::size_t axis, double value, std::string_view word) {
    std::vector<std::byte>& values = columns_[axis].values;
    values.resize(values.size() + sizeof value);
    std::memcpy(values.data() + values.size() - sizeof value, &value, sizeof value);
    if (!std::isfinite(value)) return;
    floats_tell_apart_ = floats_tell_apart_ && float_tells(value, word);
    lowest_[axis] = std::min(lowest_[axis], value);
    highest_[axis] = std::max(highest_[axis], value);
    farthest_ = std::max(farthest_, std::abs(value));
}

bool TextCoordinates::float_is_enough() const {
    double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double side = highest_[axis] - lowest_[axis];
        if (side > 0) squared += side * side;
    }
    // Points that all lie in one place have no diagonal, and are taken as doubles.
    return floats_tell_apart_ && farthest_ <= farthest_diagonals * std::sqrt(squared);
}

void TextCoordinates::finish(PointCloud& cloud) {
    if (float_is_enough())
        for (Attribute& column : columns_) narrow(column);
    cloud.attributes.insert(cloud.attributes.begin(), std::make_move_iterator(columns_.begin()),
                            std::make_move_iterator(columns_.end()));
    cloud.coordinate_columns = {0, 1, 2};
    set_positions_from_columns(cloud);
}

} // namespace knead
