#pragma once
// The public header of a LAS file and the records that follow it (LAS 1.4 - R15, sections 2.4 to 2.7).

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace knead {

// Bytes from the start of the file.
namespace las_at {
constexpr std::size_t global_encoding = 6, version_major = 24, version_minor = 25, system = 26, software = 58;
constexpr std::size_t header_size = 94, points_begin = 96;
constexpr std::size_t record_count = 100, point_format = 104, point_length = 105, legacy_points = 107;
constexpr std::size_t legacy_points_by_return = 111, points_by_return = 255;
constexpr std::size_t scale = 131, offset = 155, bounds = 179; // bounds: highest, lowest of x, then of y, z
constexpr std::size_t waveforms = 227;                         // from version 1.3 on
constexpr std::size_t extended_begin = 235, extended_count = 243, points = 247; // from version 1.4 on
} // namespace las_at

// Sizes in bytes: the headers of versions 1.0 to 1.2, 1.3 and 1.4, and of a variable length record.
constexpr std::size_t las_header_size_1_2 = 227, las_header_size_1_3 = 235, las_header_size_1_4 = 375;
constexpr std::size_t las_record_header = 54, las_extended_record_header = 60;

// Where a variable length record lies.
struct LasRecord {
    std::size_t at = 0;    // its header
    std::size_t begin = 0; // its content
    std::size_t size = 0;  // of the content
    bool extended = false; // behind the points, with the longer header
    bool describes_extra_bytes = false;
};

// How whole numbers become one coordinate: value = scale · number + offset.
struct LasAxis {
    double scale = 1;
    double offset = 0;

    double value(double number) const { return number * scale + offset; }
};

struct LasHeader {
    unsigned minor = 0; // of version 1.minor
    unsigned point_format = 0;
    std::size_t point_length = 0; // bytes
    std::size_t points_begin = 0;
    std::size_t points = 0; // all of them are in the file
    std::array<LasAxis, 3> axes;
    std::vector<LasRecord> records; // in the order of the file
    std::size_t undescribed = 0;    // bytes at the end of a point that no record describes

    std::size_t points_end() const { return points_begin + points * point_length; }
};

// Reads a file's header and finds its records. Whatever it promises of offsets and counts is checked against
// the file's size. Throws Error (input) with file, place and cure.
LasHeader parse_las_header(std::span<const std::byte> bytes, const std::string& shown);

} // namespace knead
