#pragma once
// What lies where in the points of a LAS file (LAS 1.4 - R15, section 2.6 and tables 7 to 16 and 24).

#include "cloud/point_cloud.h"
#include "io/las_header.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace knead {

// One value of every point: a scalar, or some bits of a byte.
struct LasDimension {
    std::string name;
    ScalarType type = ScalarType::uint8; // as it lies in the file
    std::size_t at = 0;                  // from the start of a point
    unsigned shift = 0;                  // of its lowest bit; with `bits` only
    unsigned bits = 0;                   // how many; 0: whole scalars
    bool scaled = false; // its values are numbers · axis.scale + axis.offset: float64 columns
    LasAxis axis;

    ScalarType column_type() const { return scaled ? ScalarType::float64 : type; }
};

// The bytes of a point of a format, 0 to 10, without extra bytes.
std::size_t las_point_size(unsigned format);

// The dimensions of a point of a format, in the order of its bytes; x, y and z are the first, with scale 1
// and offset 0. Names are those of laspy and PDAL in lower case: "return_number", "gps_time".
std::vector<LasDimension> las_dimensions(unsigned format);

// One entry of the record that describes extra bytes, 192 bytes.
constexpr std::size_t las_descriptor_size = 192;

// The type codes of scalars in such entries.
std::uint8_t las_type_code(ScalarType type);

// All dimensions of a file's points, extra bytes among them under names of their own; fills
// header.undescribed. Throws Error (input) where the description does not fit the points.
std::vector<LasDimension> dimensions_of(std::span<const std::byte> bytes, LasHeader& header,
                                        const std::string& shown);

} // namespace knead
