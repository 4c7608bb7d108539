#include "base/error.h"
#include "io/las.h"
#include "io/scalar_bytes.h"

#include <algorithm>
#include <cstring>

namespace knead {

namespace {

constexpr bool swap = std::endian::native == std::endian::big;

// Points are taken apart a block at a time, so that a block stays in the cache while its columns are
// gathered.
constexpr std::size_t block = 4096;

void gather_bits(const LasDimension& dimension, const std::byte* from, std::size_t stride, std::size_t points,
                 std::byte* to) {
    const auto mask = static_cast<std::byte>((1U << dimension.bits) - 1U);
    for (std::size_t i = 0; i < points; ++i, from += stride) to[i] = (*from >> dimension.shift) & mask;
}

// Numbers times the scale, plus the offset. A block of the numbers is gathered first, as a column of its own.
void gather_scaled(const LasDimension& dimension, const std::byte* from, std::size_t stride,
                   std::size_t points, std::byte* to) {
    Attribute numbers;
    numbers.type = dimension.type;
    numbers.values.resize(points * size_of(dimension.type));
    gather_scalars(from, stride, points, size_of(dimension.type), swap, numbers.values.data());
    for (std::size_t i = 0; i < points; ++i) {
        const double value = dimension.axis.value(value_at(numbers, i));
        std::memcpy(to + i * sizeof value, &value, sizeof value);
    }
}

void read_points(const LasImage& image, PointCloud& cloud, Progress& progress) {
    const std::size_t points = image.header.points;
    for (const LasDimension& dimension : image.dimensions) {
        Attribute column;
        column.name = dimension.name;
        column.type = dimension.column_type();
        column.values.resize(points * size_of(column.type));
        cloud.attributes.push_back(std::move(column));
    }
    const std::size_t stride = image.header.point_length;
    for (std::size_t first = 0; first < points; first += block) {
        if (first % (64 * block) == 0)
            progress.step("parsing", static_cast<double>(first) / static_cast<double>(points));
        const std::size_t count = std::min(block, points - first);
        const std::byte* const rows = image.bytes.data() + image.header.points_begin + first * stride;
        for (std::size_t d = 0; d < image.dimensions.size(); ++d) {
            const LasDimension& dimension = image.dimensions[d];
            const std::size_t size = size_of(dimension.column_type());
            std::byte* const to = cloud.attributes[d].values.data() + first * size;
            if (dimension.bits > 0)
                gather_bits(dimension, rows + dimension.at, stride, count, to);
            else if (dimension.scaled)
                gather_scaled(dimension, rows + dimension.at, stride, count, to);
            else
                gather_scalars(rows + dimension.at, stride, count, size, swap, to);
        }
    }
}

// What nobody asked for but should know.
void add_las_remarks(const LasImage& image, PointCloud& cloud) {
    if (const std::size_t undescribed = image.header.undescribed; undescribed > 0)
        cloud.remarks.push_back("each point ends in " + std::to_string(undescribed) +
                                " bytes that the file does not describe; they are kept as they are");
    const auto legacy = load_little<std::uint32_t>(image.bytes, las_at::legacy_points);
    if (legacy != 0 && legacy != cloud.size())
        cloud.remarks.push_back(
            "its header tells of " + std::to_string(legacy) + " points in the old place and of " +
            std::to_string(cloud.size()) +
            " in that of version 1.4, which counts; other programs may read fewer or none");
    std::size_t end = image.header.points_end();
    for (const LasRecord& record : image.header.records) end = std::max(end, record.begin + record.size);
    if (image.header.minor < 3 && end < image.bytes.size())
        cloud.remarks.push_back(std::to_string(image.bytes.size() - end) +
                                " bytes follow the last point; they are kept as they are");
}

} // namespace

bool looks_like_las(std::span<const std::byte> first_bytes) {
    return first_bytes.size() >= 4 && std::memcmp(first_bytes.data(), "LASF", 4) == 0;
}

std::vector<std::string> LasImage::besides_points() const {
    const auto records = std::count_if(header.records.begin(), header.records.end(),
                                       [](const LasRecord& record) { return !record.describes_extra_bytes; });
    if (records == 0) return {};
    return {std::to_string(records) +
            (records == 1 ? " variable length record" : " variable length records") +
            " (coordinate system and the like)"};
}

PointCloud read_las(std::vector<std::byte> bytes, const std::string& shown, Progress& progress) {
    auto image = std::make_shared<LasImage>();
    image->bytes = std::move(bytes);
    image->header = parse_las_header(image->bytes, shown);
    image->version = "1." + std::to_string(image->header.minor) + ", point format " +
                     std::to_string(image->header.point_format);
    image->dimensions = dimensions_of(image->bytes, image->header, shown);
    PointCloud cloud;
    read_points(*image, cloud, progress);
    cloud.coordinate_columns = {0, 1, 2};
    set_positions_from_columns(cloud);
    add_las_remarks(*image, cloud);
    cloud.image = std::move(image);
    return cloud;
}

} // namespace knead
