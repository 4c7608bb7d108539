// New LAS files: which version and point format hold the columns of a cloud, and the writing of them.

#include "base/error.h"
#include "io/las.h"
#include "io/las_growth.h"
#include "io/las_plan.h"
#include "io/patched_copy.h"
#include "io/scalar_bytes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace knead {

namespace {

// A power of ten, as its decimal text would be read.
double power_of_ten(int exponent) {
    const std::string text = "1e" + std::to_string(exponent);
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

// The finest power of ten whose steps count the extent, with half of the numbers left for later edits, and
// which doubles of that size still resolve; and an offset in the middle that is short in decimal.
// Coordinates farther apart than doubles can count are refused.
LasAxis axis_for(double lowest, double highest, const std::string& shown) {
    constexpr double most_steps = 2e9;
    constexpr double smallest_span = 1e-290; // what is smaller is one place
    constexpr double largest_span = 1e290;
    const double span = highest - lowest;
    if (!(span > smallest_span)) return {0.001, lowest};
    if (!(span < largest_span))
        throw Error(Trouble::output, shown,
                    "the points lie too far apart for the coordinates of LAS; save it as .ply");
    const double finest = std::ldexp(std::max(std::abs(lowest), std::abs(highest)), -50);
    int exponent = static_cast<int>(std::floor(std::log10(span / most_steps)));
    while (span / power_of_ten(exponent) > most_steps || power_of_ten(exponent) < finest) ++exponent;
    const double coarse = power_of_ten(exponent + 8);
    return {power_of_ten(exponent), std::nearbyint((0.5 * lowest + 0.5 * highest) / coarse) * coarse};
}

struct NewFile {
    LasPlan plan;
    std::array<LasAxis, 3> axes;
    std::array<double, 3> lowest{}, highest{}; // of the saved coordinates
    std::array<std::uint64_t, 15> by_return{}; // points with return number 1, 2, …
    std::size_t points = 0;
    const std::string& shown;
};

std::int32_t number_of(const NewFile& file, std::size_t axis, std::size_t point) {
    const double value = new_value(file.plan.coordinates[axis], point, file.shown);
    return static_cast<std::int32_t>(
        std::nearbyint((value - file.axes[axis].offset) / file.axes[axis].scale));
}

void choose_axes(NewFile& file) {
    std::array<double, 3> low{}, high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t point = 0; point < file.points; ++point) {
            const double value = new_value(file.plan.coordinates[axis], point, file.shown);
            if (!std::isfinite(value))
                throw Error(
                    Trouble::output, file.shown,
                    "point " + std::to_string(point) +
                        " has a coordinate that is not finite, which LAS cannot hold; save it as .ply");
            low[axis] = point == 0 ? value : std::min(low[axis], value);
            high[axis] = point == 0 ? value : std::max(high[axis], value);
        }
        file.axes[axis] = axis_for(low[axis], high[axis], file.shown);
    }
    if (file.points == 0) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const LasAxis& frame = file.axes[axis];
        file.lowest[axis] = frame.value(std::nearbyint((low[axis] - frame.offset) / frame.scale));
        file.highest[axis] = frame.value(std::nearbyint((high[axis] - frame.offset) / frame.scale));
    }
}

void count_returns(NewFile& file) {
    for (const LasField& field : file.plan.fields) {
        // Extra bytes of this name are such because they are no return numbers.
        if (field.dimension.name != "return_number" || field.is_extra) continue;
        for (std::size_t point = 0; point < file.points; ++point) {
            const double number = new_value(field.column, point, file.shown);
            if (number >= 1 && number <= 15) ++file.by_return[static_cast<std::size_t>(number) - 1];
        }
        return;
    }
    file.by_return[0] = file.points; // one return each, where the cloud says nothing of them
}

void put_counts(const NewFile& file, std::span<std::byte> head) {
    const bool legacy = file.plan.point_format <= 5; // the others leave the old places empty
    if (legacy) {
        store_little(static_cast<std::uint32_t>(file.points), head, las_at::legacy_points);
        for (std::size_t i = 0; i < 5; ++i)
            store_little(static_cast<std::uint32_t>(file.by_return[i]), head,
                         las_at::legacy_points_by_return + 4 * i);
        return;
    }
    store_little(std::uint64_t{file.points}, head, las_at::points);
    for (std::size_t i = 0; i < file.by_return.size(); ++i)
        store_little(file.by_return[i], head, las_at::points_by_return + 8 * i);
}

std::vector<std::byte> head_of(const NewFile& file) {
    const LasPlan& plan = file.plan;
    const std::size_t header_size = plan.minor == 4 ? las_header_size_1_4 : las_header_size_1_2;
    std::vector<std::byte> head(header_size);
    store_text("LASF", head, 0);
    // Points of the formats from 6 on ask for the bit that coordinate systems are told as WKT.
    if (plan.point_format >= 6) store_little<std::uint16_t>(16, head, las_at::global_encoding);
    store_little<std::uint8_t>(1, head, las_at::version_major);
    store_little(static_cast<std::uint8_t>(plan.minor), head, las_at::version_minor);
    store_text("OTHER", head, las_at::system);
    store_text("knead", head, las_at::software);
    store_little(static_cast<std::uint16_t>(header_size), head, las_at::header_size);
    store_little(static_cast<std::uint8_t>(plan.point_format), head, las_at::point_format);
    store_little(static_cast<std::uint16_t>(plan.point_length), head, las_at::point_length);
    put_counts(file, head);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        store_little(file.axes[axis].scale, head, las_at::scale + 8 * axis);
        store_little(file.axes[axis].offset, head, las_at::offset + 8 * axis);
        store_little(file.highest[axis], head, las_at::bounds + 16 * axis);
        store_little(file.lowest[axis], head, las_at::bounds + 16 * axis + 8);
    }
    if (plan.extra_columns > 0) {
        const std::size_t size = las_descriptor_size * plan.extra_columns;
        store_little<std::uint32_t>(1, head, las_at::record_count);
        const std::vector<std::byte> record = las_extra_bytes_record(size);
        head.insert(head.end(), record.begin(), record.end());
        for (const LasField& field : plan.fields) {
            if (!field.is_extra) continue;
            const std::vector<std::byte> entry = las_descriptor(field.column.name, field.column.type);
            head.insert(head.end(), entry.begin(), entry.end());
        }
    }
    store_little(static_cast<std::uint32_t>(head.size()), head, las_at::points_begin);
    return head;
}

void put_value(const LasField& field, std::size_t point, const std::string& shown, std::span<std::byte> row) {
    const LasDimension& dimension = field.dimension;
    std::array<std::byte, 8> native{};
    if (field.is_extra)
        native = new_scalar(field.column, point, shown);
    else
        store_scalar(field.factor * new_value(field.column, point, shown), dimension.type, native.data());
    if (dimension.bits > 0)
        row[dimension.at] |= native[0] << dimension.shift;
    else
        copy_scalar(native.data(), size_of(dimension.type), std::endian::native == std::endian::big,
                    row.data() + dimension.at);
}

void write_rows(const NewFile& file, BlockWriter& out) {
    std::vector<std::byte> row(file.plan.point_length);
    for (std::size_t point = 0; point < file.points; ++point) {
        std::fill(row.begin(), row.end(), std::byte{0});
        for (std::size_t axis = 0; axis < 3; ++axis)
            store_little(number_of(file, axis, point), row, 4 * axis);
        for (const LasDimension& one : file.plan.ones) row[one.at] |= std::byte{1} << one.shift;
        for (const LasField& field : file.plan.fields) put_value(field, point, file.shown, row);
        out.append(row);
    }
}

std::string words_about_steps(const NewFile& file) {
    std::ostringstream words;
    words << "LAS keeps coordinates as whole numbers: they are rounded to steps of " << file.axes[0].scale
          << ", " << file.axes[1].scale << " and " << file.axes[2].scale << " along x, y and z";
    return words.str();
}

} // namespace

std::vector<std::string> write_new_las(FileInTheMaking& file, const PointCloud& cloud,
                                       const PosedShape& shape, const std::string& shown,
                                       Progress& progress) {
    const ColumnsToWrite all = columns_to_write(cloud, shape);
    std::vector<std::string> heard;
    NewFile made{plan_las(cloud, all.columns, heard), {}, {}, {}, {}, cloud.size(), shown};
    choose_axes(made);
    count_returns(made);
    if (made.points > 0) heard.push_back(words_about_steps(made));
    const std::vector<std::byte> head = head_of(made);
    BlockWriter out(file, head.size() + made.points * made.plan.point_length, progress);
    out.append(head);
    write_rows(made, out);
    out.finish();
    return heard;
}

} // namespace knead
