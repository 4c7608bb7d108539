#include "io/las_header.h"

#include "base/error.h"
#include "base/types.h"
#include "io/las_dimensions.h"
#include "io/scalar_bytes.h"

#include <cmath>
#include <string_view>

namespace knead {

namespace {

constexpr const char* get_again = "the file is cut off or damaged, get it again from its source";

[[noreturn]] void fail(const std::string& shown, std::size_t at, const std::string& words) {
    throw Error(Trouble::input, shown + ": byte " + std::to_string(at), words);
}

template<typename T>
std::string counted(T number, const char* noun) {
    return std::to_string(number) + " " + noun;
}

[[noreturn]] void refuse_compressed(const std::string& shown) {
    throw Error(Trouble::input, shown,
                "is LAZ, that is compressed LAS, which knead does not read; unpack it first, with "
                "'laszip -i cloud.laz -o cloud.las' or 'pdal translate cloud.laz cloud.las'");
}

std::string_view text_at(std::span<const std::byte> bytes, std::size_t at, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()) + at, size);
    return text.substr(0, text.find('\0'));
}

// Versions differ in the length of their headers; returns the header's own word for it.
std::size_t check_version(std::span<const std::byte> bytes, const std::string& shown) {
    if (bytes.size() < las_header_size_1_2)
        fail(shown, bytes.size(), std::string("the file ends within its header of 227 bytes: ") + get_again);
    const auto major = load_little<std::uint8_t>(bytes, las_at::version_major);
    const auto minor = load_little<std::uint8_t>(bytes, las_at::version_minor);
    if (major != 1 || minor > 4)
        fail(shown, las_at::version_major,
             "is LAS " + std::to_string(major) + "." + std::to_string(minor) +
                 "; knead reads 1.0 to 1.4, convert it to one of them");
    const std::size_t least = minor == 4   ? las_header_size_1_4
                              : minor == 3 ? las_header_size_1_3
                                           : las_header_size_1_2;
    const auto size = load_little<std::uint16_t>(bytes, las_at::header_size);
    if (size < least)
        fail(shown, las_at::header_size,
             "the header says that it is " + counted(size, "bytes long, but a header of version 1.") +
                 std::to_string(minor) + " has " + std::to_string(least) + "; " + get_again);
    if (size > bytes.size())
        fail(shown, las_at::header_size, std::string("the file ends within its header: ") + get_again);
    return size;
}

// The record whose header is at `at`, all of which must lie before `end`.
LasRecord record_at(std::span<const std::byte> bytes, std::size_t at, std::size_t end, bool extended,
                    const std::string& shown) {
    const std::size_t header = extended ? las_extended_record_header : las_record_header;
    const char* const limit = extended ? "end of the file" : "first point";
    if (end - at < header)
        fail(shown, at,
             std::string("a variable length record begins where none fits before the ") + limit +
                 ": the header promises too many; " + get_again);
    LasRecord record{at, at + header, 0, extended, false};
    const std::uint64_t size =
        extended ? load_little<std::uint64_t>(bytes, at + 20) : load_little<std::uint16_t>(bytes, at + 20);
    if (size > end - record.begin)
        fail(shown, at,
             "a variable length record of " + counted(size, "bytes reaches beyond the ") + limit + "; " +
                 get_again);
    record.size = static_cast<std::size_t>(size);
    const std::string_view user = text_at(bytes, at + 2, 16);
    const auto id = load_little<std::uint16_t>(bytes, at + 18);
    if (user == "laszip encoded" && id == 22204) refuse_compressed(shown);
    record.describes_extra_bytes = user == "LASF_Spec" && id == 4;
    return record;
}

void find_records(std::span<const std::byte> bytes, std::size_t header_size, const std::string& shown,
                  LasHeader& header) {
    const auto count = load_little<std::uint32_t>(bytes, las_at::record_count);
    if (count > (header.points_begin - header_size) / las_record_header)
        fail(shown, las_at::record_count,
             "the header promises " + counted(count, "variable length records, more than fit before the ") +
                 "first point at byte " + std::to_string(header.points_begin) + "; " + get_again);
    std::size_t at = header_size;
    for (std::uint32_t i = 0; i < count; ++i) {
        header.records.push_back(record_at(bytes, at, header.points_begin, false, shown));
        at = header.records.back().begin + header.records.back().size;
    }
}

void find_extended_records(std::span<const std::byte> bytes, const std::string& shown, LasHeader& header) {
    if (header.minor < 4) return;
    const auto begin = load_little<std::uint64_t>(bytes, las_at::extended_begin);
    const auto count = load_little<std::uint32_t>(bytes, las_at::extended_count);
    if (count == 0) return;
    if (begin < header.points_end() || begin > bytes.size() ||
        count > (bytes.size() - begin) / las_extended_record_header)
        fail(shown, las_at::extended_begin,
             "the header promises " + counted(count, "extended records from byte ") + std::to_string(begin) +
                 " on, where they do not fit between the last point and the end of the file; " + get_again);
    auto at = static_cast<std::size_t>(begin);
    for (std::uint32_t i = 0; i < count; ++i) {
        header.records.push_back(record_at(bytes, at, bytes.size(), true, shown));
        at = header.records.back().begin + header.records.back().size;
    }
}

void check_point_format(std::span<const std::byte> bytes, const std::string& shown, LasHeader& header) {
    const auto format = load_little<std::uint8_t>(bytes, las_at::point_format);
    if ((format & 0xC0U) != 0) refuse_compressed(shown); // how LASzip marks its files
    if (format > 10)
        fail(shown, las_at::point_format,
             "its points are of format " + std::to_string(format) +
                 ", but LAS has formats 0 to 10; convert it to one of them");
    header.point_format = format;
    header.point_length = load_little<std::uint16_t>(bytes, las_at::point_length);
    const std::size_t least = las_point_size(format);
    if (header.point_length < least)
        fail(shown, las_at::point_length,
             "a point is said to be " + counted(header.point_length, "bytes long, but one of format ") +
                 std::to_string(format) + " has at least " + std::to_string(least) + "; " + get_again);
}

// Version 1.4 counts in 8 bytes; some writers leave those at 0 and use the old place.
void count_points(std::span<const std::byte> bytes, const std::string& shown, LasHeader& header) {
    std::uint64_t points = load_little<std::uint32_t>(bytes, las_at::legacy_points);
    std::size_t at = las_at::legacy_points;
    if (header.minor == 4)
        if (const auto wide = load_little<std::uint64_t>(bytes, las_at::points); wide != 0) {
            points = wide;
            at = las_at::points;
        }
    const std::size_t held = (bytes.size() - header.points_begin) / header.point_length;
    if (points > held)
        fail(shown, at,
             "the header promises " + counted(points, "points of ") + std::to_string(header.point_length) +
                 " bytes, but only " + std::to_string(held) + " are in the file; " + get_again);
    if (points >= no_index)
        fail(shown, at,
             "the header promises " + std::to_string(points) +
                 " points; knead takes up to 4294967294, cut the cloud into pieces");
    header.points = static_cast<std::size_t>(points);
}

void read_axes(std::span<const std::byte> bytes, const std::string& shown, LasHeader& header) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double scale = load_little<double>(bytes, las_at::scale + 8 * axis);
        const double offset = load_little<double>(bytes, las_at::offset + 8 * axis);
        header.axes[axis] = {scale, offset};
        if (header.points == 0) continue; // nothing is computed with them
        if (!std::isfinite(scale) || scale == 0)
            fail(shown, las_at::scale + 8 * axis,
                 std::string("the scale of ") + "xyz"[axis] +
                     " is 0 or not finite, so that its coordinates say nothing; " + get_again);
        if (!std::isfinite(offset))
            fail(shown, las_at::offset + 8 * axis,
                 std::string("the offset of ") + "xyz"[axis] + " is not finite; " + get_again);
    }
}

} // namespace

LasHeader parse_las_header(std::span<const std::byte> bytes, const std::string& shown) {
    const std::size_t header_size = check_version(bytes, shown);
    LasHeader header;
    header.minor = load_little<std::uint8_t>(bytes, las_at::version_minor);
    header.points_begin = load_little<std::uint32_t>(bytes, las_at::points_begin);
    if (header.points_begin < header_size || header.points_begin > bytes.size())
        fail(shown, las_at::points_begin,
             "the header puts the first point at byte " + std::to_string(header.points_begin) +
                 ", which is not between itself and the end of the file; " + get_again);
    check_point_format(bytes, shown, header);
    find_records(bytes, header_size, shown, header);
    count_points(bytes, shown, header);
    find_extended_records(bytes, shown, header);
    read_axes(bytes, shown, header);
    return header;
}

} // namespace knead
