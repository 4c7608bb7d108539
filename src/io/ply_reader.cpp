#include "base/error.h"
#include "io/named_coordinates.h"
#include "io/ply.h"
#include "io/ply_rows.h"
#include "io/text_numbers.h"

#include <bit>
#include <cstring>

namespace knead {

namespace {

// Finds the points among the elements, or says why there are none.
std::size_t find_vertices(const PlyHeader& header, const std::string& shown) {
    for (std::size_t e = 0; e < header.elements.size(); ++e) {
        const PlyElement& element = header.elements[e];
        if (element.name != "vertex") continue;
        const std::string place = shown + ":" + std::to_string(element.line);
        for (const char* const axis : {"x", "y", "z"}) {
            const PlyProperty* found = nullptr;
            for (const PlyProperty& property : element.properties)
                if (property.name == axis) found = &property;
            if (found == nullptr)
                throw Error(Trouble::input, place,
                            std::string("the element vertex has no property ") + axis +
                                "; a point needs x, y and z, in small letters");
            if (found->is_list)
                throw Error(Trouble::input, place,
                            std::string("the property ") + axis + " is a list; a coordinate is one number");
        }
        if (element.count >= no_index)
            throw Error(Trouble::input, place,
                        "the header promises " + std::to_string(element.count) +
                            " points; knead takes up to 4294967294, cut the cloud into pieces");
        return e;
    }
    throw Error(Trouble::input, shown, "its header has no element vertex, so there are no points in it");
}

std::vector<Attribute> empty_columns(const PlyElement& element) {
    std::vector<Attribute> columns;
    for (const PlyProperty& property : element.properties) {
        Attribute column;
        column.name = property.name;
        column.type = property.type;
        column.count_type = property.count_type;
        if (property.is_list) column.first.push_back(0);
        columns.push_back(std::move(column));
    }
    return columns;
}

// Bytes behind the last element; those of a text count only if they are more than line ends.
std::size_t bytes_left_over(const PlyBody& body, PlyEncoding encoding) {
    if (encoding != PlyEncoding::ascii) return body.left();
    const char* const text = reinterpret_cast<const char*>(body.bytes.data());
    TextCursor rest{text + body.at, text + body.bytes.size()};
    return find_row(rest) ? static_cast<std::size_t>(rest.end - rest.at) : 0;
}

void read_body(PlyImage& image, const std::string& shown, PointCloud& cloud, Progress& progress) {
    const PlyEncoding encoding = image.header.encoding;
    const bool ascii = encoding == PlyEncoding::ascii;
    const bool swap = is_swapped(encoding);
    PlyBody body{image.bytes, image.header.body, shown};
    for (std::size_t e = 0; e < image.header.elements.size(); ++e) {
        const PlyElement& element = image.header.elements[e];
        refuse_lying_count(body, element, encoding);
        if (e == image.vertex_element) {
            image.rows_begin = body.at;
            cloud.attributes = empty_columns(element);
            if (ascii)
                read_ascii_rows(body, element, cloud.attributes, progress);
            else
                read_binary_rows(body, element, swap, cloud.attributes, progress);
            image.rows_end = body.at;
        } else if (ascii) {
            skip_ascii_rows(body, element, progress);
        } else {
            skip_binary_rows(body, element, swap, progress);
        }
    }
    if (const std::size_t left_over = bytes_left_over(body, encoding); left_over > 0)
        cloud.remarks.push_back(std::to_string(left_over) +
                                " bytes follow the last element; they are kept as they are");
}

} // namespace

bool looks_like_ply(std::span<const std::byte> first_bytes) {
    if (first_bytes.size() < 3 || std::memcmp(first_bytes.data(), "ply", 3) != 0) return false;
    if (first_bytes.size() == 3) return true;
    const char next = static_cast<char>(first_bytes[3]);
    return is_blank(next) || is_line_end(next);
}

bool is_swapped(PlyEncoding encoding) {
    if (encoding == PlyEncoding::ascii) return false;
    return (encoding == PlyEncoding::binary_big_endian) != (std::endian::native == std::endian::big);
}

std::vector<std::string> PlyImage::besides_points() const {
    std::vector<std::string> rows;
    for (const PlyElement& element : header.elements)
        if (element.name != "vertex" && element.count > 0)
            rows.push_back(std::to_string(element.count) + " rows of the element " + in_quotes(element.name));
    return rows;
}

PointCloud read_ply(std::vector<std::byte> bytes, const std::string& shown, Progress& progress) {
    auto image = std::make_shared<PlyImage>();
    image->bytes = std::move(bytes);
    image->header = parse_ply_header(image->bytes, shown);
    image->vertex_element = find_vertices(image->header, shown);
    PointCloud cloud;
    read_body(*image, shown, cloud, progress);
    set_positions_from_named_columns(cloud);
    cloud.image = std::move(image);
    return cloud;
}

} // namespace knead
