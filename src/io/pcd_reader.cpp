#include "base/error.h"
#include "io/lzf.h"
#include "io/named_coordinates.h"
#include "io/pcd.h"
#include "io/scalar_bytes.h"
#include "io/text_rows.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace knead {

namespace {

constexpr std::size_t rows_between_reports = std::size_t{1} << 16;
constexpr bool swapped = std::endian::native == std::endian::big; // PCD is little endian

void report(Progress& progress, std::uint64_t point, const PcdHeader& header) {
    if (point % rows_between_reports == 0)
        progress.step("parsing", static_cast<double>(point) / static_cast<double>(header.points));
}

void check_coordinates(const PcdHeader& header, const std::string& shown) {
    for (const char* const axis : {"x", "y", "z"}) {
        const auto field = std::find_if(header.fields.begin(), header.fields.end(),
                                        [&](const PcdField& other) { return other.name == axis; });
        if (field == header.fields.end())
            throw Error(Trouble::input, shown,
                        std::string("has no field ") + axis +
                            " in its FIELDS line; a point needs x, y and z");
        if (field->count != 1)
            throw Error(Trouble::input, shown,
                        std::string("the field ") + axis + " has COUNT " + std::to_string(field->count) +
                            "; a coordinate is one number");
    }
}

// No memory is asked for on the word of a header: even the shortest rows must fit into what is left.
void refuse_lying_count(const PcdImage& image, const std::string& shown) {
    const PcdHeader& header = image.header;
    const bool ascii = header.encoding == PcdEncoding::ascii;
    const std::size_t left = image.bytes.size() - header.body;
    // A number takes a digit and what parts it from the next; the last line may lack its end.
    const std::size_t shortest = ascii ? 2 * header.words_a_point : header.bytes_a_point;
    if (header.points <= (ascii ? left + 1 : left) / shortest) return;
    throw Error(Trouble::input, shown + ": byte " + std::to_string(header.body),
                "the header promises " + std::to_string(header.points) + " points, but only " +
                    std::to_string(left) +
                    " bytes follow: the file is cut off or its header lies; get it again from its source");
}

// --- The columns -------------------------------------------------------------------------------------------

// One a field, padding included, with room for all points.
std::vector<Attribute> empty_columns(const PcdHeader& header) {
    std::vector<Attribute> columns;
    for (const PcdField& field : header.fields) {
        Attribute column;
        column.name = field.name;
        column.type = field.type;
        if (!field.is_padding()) {
            column.values.resize(header.points * field.bytes());
            if (field.count > 1) {
                column.count_type = field.count < 256 ? ScalarType::uint8 : ScalarType::uint32;
                column.first.resize(header.points + 1);
                for (std::size_t i = 0; i <= header.points; ++i) column.first[i] = i * field.count;
            }
        }
        columns.push_back(std::move(column));
    }
    return columns;
}

bool is_packed_color(const PcdField& field) {
    return (field.name == "rgb" || field.name == "rgba") && field.count == 1 && size_of(field.type) == 4;
}

// The bytes red, green, blue and alpha of 0xAARRGGBB as columns of their own.
void add_colors(const Attribute& packed, PointCloud& cloud) {
    constexpr std::array<std::string_view, 4> names = {"red", "green", "blue", "alpha"};
    constexpr std::array<unsigned, 4> shifts = {16, 8, 0, 24};
    const std::size_t points = packed.values.size() / 4;
    std::vector<std::uint8_t> values(points);
    for (std::size_t c = 0; c < (packed.name == "rgba" ? 4U : 3U); ++c) {
        for (std::size_t i = 0; i < points; ++i) {
            std::uint32_t color = 0;
            std::memcpy(&color, packed.values.data() + 4 * i, 4);
            values[i] = static_cast<std::uint8_t>(color >> shifts[c]);
        }
        add_attribute(cloud, std::string(names[c]), values);
    }
}

// Makes the cloud's columns of the fields'.
void adopt(std::vector<Attribute> columns, PcdImage& image, PointCloud& cloud) {
    const auto has = [&](std::string_view name) {
        return std::any_of(columns.begin(), columns.end(),
                           [&](const Attribute& column) { return column.name == name; });
    };
    const bool renames_normals = !has("nx") && !has("ny") && !has("nz");
    // Only one source of colours; the field keeps its own name where there is another.
    bool takes_colors = !has("red") && !has("green") && !has("blue") && !has("alpha");
    for (std::size_t f = 0; f < columns.size(); ++f) {
        const PcdField& field = image.header.fields[f];
        image.columns.emplace_back();
        if (field.is_padding()) continue;
        if (takes_colors && is_packed_color(field)) {
            add_colors(columns[f], cloud);
            takes_colors = false;
            continue;
        }
        for (const char axis : {'x', 'y', 'z'})
            if (renames_normals && field.name == std::string("normal_") + axis)
                columns[f].name = std::string("n") + axis;
        image.columns.back() = cloud.attributes.size();
        cloud.attributes.push_back(std::move(columns[f]));
    }
}

// --- Bodies ------------------------------------------------------------------------------------------------

// The numbers of one field, for some points whose own lie `stride` bytes apart.
void take_field(const PcdField& field, const std::byte* from, std::size_t stride, std::size_t points,
                std::byte* to) {
    const std::size_t size = size_of(field.type);
    if (field.count == 1) return gather_scalars(from, stride, points, size, swapped, to);
    for (; points > 0; --points, from += stride, to += field.bytes())
        gather_scalars(from, size, field.count, size, swapped, to);
}

// Taken apart a block at a time, so that a block stays in the cache while its columns are gathered.
void read_binary(PcdImage& image, std::vector<Attribute>& columns, Progress& progress) {
    constexpr std::size_t block = 4096;
    static_assert(rows_between_reports % block == 0);
    const PcdHeader& header = image.header;
    for (std::size_t point = 0; point < header.points; point += block) {
        report(progress, point, header);
        const std::size_t points = std::min<std::size_t>(block, header.points - point);
        const std::byte* from = image.bytes.data() + header.body + point * header.bytes_a_point;
        for (std::size_t f = 0; f < columns.size(); ++f) {
            const PcdField& field = header.fields[f];
            if (!field.is_padding())
                take_field(field, from, header.bytes_a_point, points,
                           columns[f].values.data() + point * field.bytes());
            from += field.bytes();
        }
    }
    image.body_end = header.body + header.points * header.bytes_a_point;
}

void read_compressed(PcdImage& image, const std::string& shown, std::vector<Attribute>& columns,
                     Progress& progress) {
    const PcdHeader& header = image.header;
    progress.step("unpacking", 0);
    const std::vector<std::byte> body = unpack_pcd_body(image.bytes, header, shown);
    const std::byte* from = body.data();
    for (std::size_t f = 0; f < columns.size(); ++f) {
        progress.step("parsing", static_cast<double>(f) / static_cast<double>(columns.size()));
        const PcdField& field = header.fields[f];
        if (!field.is_padding())
            take_field(field, from, field.bytes(), header.points, columns[f].values.data());
        from += header.points * field.bytes();
    }
    const std::span<const std::byte> stream = find_pcd_stream(image.bytes, header, shown).stream;
    image.body_end = static_cast<std::size_t>(stream.data() + stream.size() - image.bytes.data());
}

void read_ascii(PcdImage& image, const std::string& shown, std::vector<Attribute>& columns,
                Progress& progress) {
    const PcdHeader& header = image.header;
    TextRows rows(image.bytes, header.body, shown, {"point", "points", "field", "fields"});
    for (std::uint64_t point = 0; point < header.points; ++point) {
        report(progress, point, header);
        rows.begin(point, header.points);
        for (std::size_t f = 0; f < columns.size(); ++f) {
            const PcdField& field = header.fields[f];
            const std::size_t size = size_of(field.type);
            for (std::uint32_t k = 0; k < field.count; ++k)
                if (field.is_padding())
                    rows.pass_over(field.name);
                else
                    rows.number(field.name, field.type,
                                columns[f].values.data() + point * field.bytes() + k * size);
        }
        rows.end();
    }
    image.body_end = rows.at();
}

void remark_on_rest(const PcdImage& image, PointCloud& cloud) {
    std::size_t left = image.bytes.size() - image.body_end;
    if (image.header.encoding == PcdEncoding::ascii) {
        const char* const text = reinterpret_cast<const char*>(image.bytes.data());
        TextCursor rest{text + image.body_end, text + image.bytes.size()};
        left = find_row(rest) ? static_cast<std::size_t>(rest.end - rest.at) : 0;
    }
    if (left > 0)
        cloud.remarks.push_back(std::to_string(left) +
                                " bytes follow the last point; they are kept as they are");
}

} // namespace

std::vector<std::string> PcdImage::besides_points() const {
    std::vector<std::string> things;
    if (header.is_organised())
        things.push_back("the arrangement of the points as " + std::to_string(header.width) + " × " +
                         std::to_string(header.height));
    if (!header.viewpoint.empty() && header.viewpoint != "0 0 0 1 0 0 0") things.push_back("the viewpoint");
    return things;
}

PcdCompressed find_pcd_stream(std::span<const std::byte> bytes, const PcdHeader& header,
                              const std::string& shown) {
    const auto fail = [&](const std::string& words) {
        throw Error(Trouble::input, shown + ": byte " + std::to_string(header.body),
                    words + "; the file is cut off or damaged, get it again from its source");
    };
    const std::span<const std::byte> body = bytes.subspan(header.body);
    if (header.points == 0 && body.size() < 8) return {body.first(0), 0};
    if (body.size() < 8) fail("the two lengths of the compressed points are missing");
    const auto length = [&](std::size_t at) {
        return static_cast<std::size_t>(load_integer(body.data() + at, ScalarType::uint32, swapped));
    };
    const std::size_t packed = length(0);
    const std::size_t unpacked = length(4);
    if (packed > body.size() - 8)
        fail("the compressed points should take " + std::to_string(packed) + " bytes, but only " +
             std::to_string(body.size() - 8) + " follow");
    if (unpacked / header.bytes_a_point != header.points || unpacked % header.bytes_a_point != 0)
        fail("the compressed points should unpack to " + std::to_string(unpacked) +
             " bytes, which are not the " + std::to_string(header.points) + " points of " +
             std::to_string(header.bytes_a_point) + " bytes that the header promises");
    if (unpacked > packed * largest_lzf_expansion)
        fail(std::to_string(packed) + " compressed bytes cannot unpack to " + std::to_string(unpacked));
    return {body.subspan(8, packed), unpacked};
}

std::vector<std::byte> unpack_pcd_body(std::span<const std::byte> bytes, const PcdHeader& header,
                                       const std::string& shown) {
    const PcdCompressed compressed = find_pcd_stream(bytes, header, shown);
    std::vector<std::byte> body(compressed.unpacked_size);
    if (!unpack_lzf(compressed.stream, body))
        throw Error(Trouble::input, shown + ": byte " + std::to_string(header.body + 8),
                    "the compressed points do not unpack; the file is damaged, get it again from its source");
    return body;
}

bool looks_like_pcd(std::span<const std::byte> first_bytes) {
    std::string_view text(reinterpret_cast<const char*>(first_bytes.data()), first_bytes.size());
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
        std::string_view line = text.substr(0, end);
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.starts_with("# .PCD")) return true;
        if (line.empty() || line.starts_with('#')) continue;
        for (const std::string_view begin : {"VERSION .", "VERSION 0", "FIELDS ", "COLUMNS "})
            if (line.starts_with(begin)) return true;
        return false;
    }
    return false;
}

PointCloud read_pcd(std::vector<std::byte> bytes, const std::string& shown, Progress& progress) {
    auto image = std::make_shared<PcdImage>();
    image->bytes = std::move(bytes);
    image->header = parse_pcd_header(image->bytes, shown);
    check_coordinates(image->header, shown);
    if (image->header.encoding == PcdEncoding::binary_compressed)
        (void)find_pcd_stream(image->bytes, image->header, shown);
    else
        refuse_lying_count(*image, shown);
    PointCloud cloud;
    std::vector<Attribute> columns = empty_columns(image->header);
    if (image->header.encoding == PcdEncoding::ascii)
        read_ascii(*image, shown, columns, progress);
    else if (image->header.encoding == PcdEncoding::binary)
        read_binary(*image, columns, progress);
    else
        read_compressed(*image, shown, columns, progress);
    adopt(std::move(columns), *image, cloud);
    remark_on_rest(*image, cloud);
    set_positions_from_named_columns(cloud);
    cloud.image = std::move(image);
    return cloud;
}

} // namespace knead
