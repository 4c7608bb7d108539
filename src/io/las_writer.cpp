#include "base/error.h"
#include "base/require.h"
#include "io/las.h"
#include "io/las_growth.h"
#include "io/new_columns.h"
#include "io/patched_copy.h"
#include "io/scalar_bytes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace knead {

namespace {

// How the numbers of an axis are to be saved.
struct AxisFrame {
    const PosedColumn* column = nullptr; // null where nothing is posed
    LasAxis own;                         // of the file
    LasAxis axis;                        // to save with
    bool moves = false;                  // whether any number changes
    double lowest = 0, highest = 0;      // of all numbers to save

    bool is_new() const { return axis.scale != own.scale || axis.offset != own.offset; }

    // A number by `own`, for a value that keeps its place, as a number to save.
    double converted(std::int32_t number) const {
        return is_new() ? std::nearbyint((own.value(number) - axis.offset) / axis.scale) : number;
    }

    // The number to save for point i, whose number in the file is `own_number`.
    double number(std::size_t i, std::int32_t own_number, const std::string& shown) const {
        const auto value = column != nullptr ? posed_value(*column, i, shown) : std::nullopt;
        if (!value) return converted(own_number);
        return std::nearbyint((*value - axis.offset) / axis.scale);
    }
};

struct Patching {
    const LasImage& image;
    const std::string& shown;
    std::array<AxisFrame, 3> frames;
    std::vector<PosedColumn> turned; // normals and what else turns (turned_splats.h): no coordinates
    std::vector<AddedColumn> added;
};

std::span<const std::byte> rows_of(const LasImage& image) {
    return std::span(image.bytes)
        .subspan(image.header.points_begin, image.header.points * image.header.point_length);
}

std::int32_t own_number(const LasImage& image, std::size_t point, std::size_t axis) {
    return load_little<std::int32_t>(rows_of(image), point * image.header.point_length + 4 * axis);
}

// Finds out what a pose does to the numbers of an axis.
void measure(const LasImage& image, std::size_t axis, const std::string& shown, AxisFrame& frame) {
    frame.lowest = std::numeric_limits<double>::infinity();
    frame.highest = -frame.lowest;
    for (std::size_t i = 0; i < image.header.points; ++i) {
        const std::int32_t own = own_number(image, i, axis);
        const double number = frame.number(i, own, shown);
        frame.moves = frame.moves || number != own;
        frame.lowest = std::min(frame.lowest, number);
        frame.highest = std::max(frame.highest, number);
    }
}

bool fits_int32(double number) {
    return number >= std::numeric_limits<std::int32_t>::min() &&
           number <= std::numeric_limits<std::int32_t>::max();
}

[[noreturn]] void refuse_extent(const std::string& shown) {
    throw Error(
        Trouble::output, shown,
        "the pose spreads the points so far that LAS coordinates in the file's steps do not hold them; "
        "move them less, or save it as .ply");
}

// The file's own steps about another middle, so that points which rest keep their very place; coarser steps
// only where there are too many of them.
LasAxis axis_that_holds(const AxisFrame& frame, const std::string& shown) {
    constexpr double most_steps = 4e9; // a little less than there are numbers
    const double span = frame.highest - frame.lowest;
    if (!std::isfinite(span) || !std::isfinite(span * frame.own.scale)) refuse_extent(shown);
    double factor = 1;
    while (span / factor > most_steps) factor *= 10;
    const double middle = std::nearbyint(0.5 * frame.lowest + 0.5 * frame.highest);
    return {frame.own.scale * factor, frame.own.value(middle)};
}

// What a new frame is told as.
std::string words_about(const AxisFrame& frame, char axis) {
    std::ostringstream words;
    words.precision(12);
    words << "the pose leaves the range of the file's whole numbers along " << axis
          << ", so its offset there becomes " << frame.axis.offset;
    if (frame.axis.scale != frame.own.scale)
        words << " and its scale " << frame.axis.scale << ": all points are rounded to that";
    return words.str();
}

std::vector<std::string> choose_frames(Patching& patching) {
    std::vector<std::string> heard;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        AxisFrame& frame = patching.frames[axis];
        if (frame.column == nullptr || patching.image.header.points == 0) continue;
        measure(patching.image, axis, patching.shown, frame);
        if (!fits_int32(frame.lowest) || !fits_int32(frame.highest)) {
            frame.axis = axis_that_holds(frame, patching.shown);
            measure(patching.image, axis, patching.shown, frame);
            heard.push_back(words_about(frame, "xyz"[axis]));
        }
    }
    return heard;
}

// The scales, offsets and bounds of the axes along which something moved.
void patch_header(const Patching& patching, std::span<std::byte> head) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const AxisFrame& frame = patching.frames[axis];
        if (!frame.moves) continue;
        if (frame.is_new()) {
            store_little(frame.axis.scale, head, las_at::scale + 8 * axis);
            store_little(frame.axis.offset, head, las_at::offset + 8 * axis);
        }
        double low = frame.axis.value(frame.lowest);
        double high = frame.axis.value(frame.highest);
        if (low > high) std::swap(low, high); // of a negative scale
        store_little(high, head, las_at::bounds + 16 * axis);
        store_little(low, head, las_at::bounds + 16 * axis + 8);
    }
}

// A component of what turns, by the type that it has in the file.
void patch_turned(const Patching& patching, const PosedColumn& column, std::size_t point,
                  std::span<std::byte> row) {
    auto value = posed_value(column, point, patching.shown);
    if (!value) return;
    const LasDimension& dimension = patching.image.dimensions[column.column];
    if (dimension.scaled) {
        const double number = (*value - dimension.axis.offset) / dimension.axis.scale;
        value = is_whole(dimension.type) ? rounded_to(dimension.type, number) : std::optional(number);
        if (!value) return; // no direction leaves its file's range by a turn; what does was none
    }
    const StoredScalar scalar =
        stored_scalar(*value, dimension.type, std::endian::native == std::endian::big);
    std::ranges::copy(scalar.span(), row.data() + dimension.at);
}

void patch_row(const Patching& patching, std::size_t point, std::span<std::byte> row) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const AxisFrame& frame = patching.frames[axis];
        if (!frame.moves) continue;
        const double number = frame.number(point, load_little<std::int32_t>(row, 4 * axis), patching.shown);
        // The steps of an odd header may be lost in the rounding of its offset.
        if (!fits_int32(number)) refuse_extent(patching.shown);
        store_little(static_cast<std::int32_t>(number), row, 4 * axis);
    }
    for (const PosedColumn& column : patching.turned) patch_turned(patching, column, point, row);
    std::size_t at = patching.image.header.point_length;
    for (const AddedColumn& column : patching.added) {
        store_little(column.values[point], row, at);
        at += sizeof(float);
    }
}

void write_rows(const Patching& patching, BlockWriter& out) {
    const std::size_t length = patching.image.header.point_length;
    std::vector<std::byte> row(length + sizeof(float) * patching.added.size());
    const std::span<const std::byte> rows = rows_of(patching.image);
    for (std::size_t point = 0; point < patching.image.header.points; ++point) {
        std::memcpy(row.data(), rows.data() + point * length, length);
        patch_row(patching, point, row);
        out.append(row);
    }
}

std::vector<std::string> write_patched(FileInTheMaking& file, const LasImage& image, const PointCloud& cloud,
                                       const PosedShape& shape, const std::string& shown,
                                       Progress& progress) {
    require(image.header.points == cloud.size() && image.dimensions.size() == cloud.attributes.size(),
            "a cloud has the points and attributes of its image");
    Patching patching{image, shown, {}, {}, with_free_names(cloud, shape.added)};
    for (std::size_t axis = 0; axis < 3; ++axis)
        patching.frames[axis].own = patching.frames[axis].axis = image.header.axes[axis];
    const std::vector<PosedColumn> columns = posed_columns(cloud, shape);
    for (const PosedColumn& column : columns)
        if (column.column < 3)
            patching.frames[column.column].column = &column;
        else
            patching.turned.push_back(column);
    std::vector<std::string> heard = choose_frames(patching);

    const std::span<const std::byte> bytes = image.bytes;
    std::vector<std::byte> head(bytes.begin(),
                                bytes.begin() + static_cast<std::ptrdiff_t>(image.header.points_begin));
    patch_header(patching, head);
    grow_las_head(head, image.header, patching.added, shown);
    BlockWriter out(file, bytes.size() + sizeof(float) * patching.added.size() * cloud.size(), progress);
    out.append(head);
    const bool some_move = std::any_of(patching.frames.begin(), patching.frames.end(),
                                       [](const AxisFrame& frame) { return frame.moves; });
    if (some_move || !patching.turned.empty() || !patching.added.empty())
        write_rows(patching, out);
    else
        out.append(rows_of(image));
    out.append(bytes.subspan(image.header.points_end()));
    out.finish();
    return heard;
}

} // namespace

std::vector<std::string> write_las(FileInTheMaking& file, const PointCloud& cloud, const PosedShape& shape,
                                   const std::string& shown, Progress& progress) {
    const auto* image = dynamic_cast<const LasImage*>(cloud.image.get());
    return image != nullptr ? write_patched(file, *image, cloud, shape, shown, progress)
                            : write_new_las(file, cloud, shape, shown, progress);
}

} // namespace knead
