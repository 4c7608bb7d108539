#include "base/error.h"
#include "io/ply_rows.h"
#include "io/scalar_bytes.h"
#include "io/text_numbers.h"

#include <algorithm>

namespace knead {

namespace {

constexpr std::size_t rows_between_reports = std::size_t{1} << 18;

std::size_t stride_of(const PlyElement& element) {
    std::size_t stride = 0;
    for (const PlyProperty& property : element.properties) stride += size_of(property.type);
    return stride;
}

void report(Progress& progress, std::uint64_t row, const PlyElement& element) {
    if (row % rows_between_reports == 0)
        progress.step("parsing", static_cast<double>(row) / static_cast<double>(element.count));
}

[[noreturn]] void fail(const PlyBody& body, const PlyElement& element, std::uint64_t row,
                       const std::string& words) {
    throw Error(Trouble::input, body.shown + ": byte " + std::to_string(body.at),
                element.name + " row " + std::to_string(row) + " " + words);
}

// Rows without lists, all equally long: taken apart a block at a time, so that a block stays in the cache
// while its columns are gathered.
void read_equal_rows(PlyBody& body, const PlyElement& element, bool swap, std::vector<Attribute>& columns,
                     Progress& progress) {
    constexpr std::size_t block = 4096;
    static_assert(rows_between_reports % block == 0);
    const std::size_t stride = stride_of(element);
    for (Attribute& column : columns) column.values.resize(element.count * size_of(column.type));
    for (std::size_t row = 0; row < element.count; row += block) {
        report(progress, row, element);
        const std::size_t rows = std::min<std::size_t>(block, element.count - row);
        const std::byte* from = body.bytes.data() + body.at + row * stride;
        for (Attribute& column : columns) {
            const std::size_t size = size_of(column.type);
            gather_scalars(from, stride, rows, size, swap, column.values.data() + row * size);
            from += size;
        }
    }
    body.at += element.count * stride;
}

void need(const PlyBody& body, const PlyElement& element, std::uint64_t row, std::size_t bytes) {
    if (body.left() < bytes)
        fail(body, element, row,
             "is cut off: the file ends within it, or its header lies; get it again from its source");
}

// The length of the list at body.at, which moves behind it; its values are known to be there.
std::size_t list_length(PlyBody& body, const PlyElement& element, const PlyProperty& property,
                        std::uint64_t row, bool swap) {
    need(body, element, row, size_of(property.count_type));
    const std::int64_t length = load_integer(body.bytes.data() + body.at, property.count_type, swap);
    const std::size_t left = body.left() - size_of(property.count_type);
    if (length < 0 || static_cast<std::uint64_t>(length) > left / size_of(property.type))
        fail(body, element, row,
             "has a list " + in_quotes(property.name) + " of the length " + std::to_string(length) +
                 ", which the file does not hold; it is cut off or damaged, get it again from its source");
    body.at += size_of(property.count_type);
    return static_cast<std::size_t>(length);
}

void read_list(PlyBody& body, std::size_t length, bool swap, Attribute& column) {
    const std::size_t size = size_of(column.type);
    const std::size_t before = column.values.size();
    column.values.resize(before + length * size);
    gather_scalars(body.bytes.data() + body.at, size, length, size, swap, column.values.data() + before);
    column.first.push_back(column.values.size() / size);
    body.at += length * size;
}

void read_scalar(PlyBody& body, const PlyElement& element, std::uint64_t row, bool swap, Attribute& column) {
    const std::size_t size = size_of(column.type);
    need(body, element, row, size);
    copy_scalar(body.bytes.data() + body.at, size, swap, column.values.data() + row * size);
    body.at += size;
}

std::uint64_t shortest_row(const PlyElement& element, PlyEncoding encoding) {
    if (encoding == PlyEncoding::ascii) {
        // A value takes a digit and what parts it from the next; a list at the end may be left out.
        const std::size_t values = element.properties.size();
        return 2 * (values > 1 && element.properties.back().is_list ? values - 1 : values);
    }
    std::uint64_t bytes = 0;
    for (const PlyProperty& property : element.properties)
        bytes += size_of(property.is_list ? property.count_type : property.type);
    return bytes;
}

} // namespace

void read_binary_rows(PlyBody& body, const PlyElement& element, bool swap, std::vector<Attribute>& columns,
                      Progress& progress) {
    if (!element.has_lists()) return read_equal_rows(body, element, swap, columns, progress);
    for (std::size_t p = 0; p < columns.size(); ++p)
        if (element.properties[p].is_list)
            columns[p].first.reserve(element.count + 1);
        else
            columns[p].values.resize(element.count * size_of(columns[p].type));

    for (std::uint64_t row = 0; row < element.count; ++row) {
        report(progress, row, element);
        for (std::size_t p = 0; p < columns.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (property.is_list)
                read_list(body, list_length(body, element, property, row, swap), swap, columns[p]);
            else
                read_scalar(body, element, row, swap, columns[p]);
        }
    }
}

void skip_binary_rows(PlyBody& body, const PlyElement& element, bool swap, Progress& progress) {
    if (!element.has_lists()) {
        body.at += element.count * stride_of(element);
        return;
    }
    for (std::uint64_t row = 0; row < element.count; ++row) {
        report(progress, row, element);
        for (const PlyProperty& property : element.properties) {
            std::size_t values = 1;
            if (property.is_list) values = list_length(body, element, property, row, swap);
            need(body, element, row, values * size_of(property.type));
            body.at += values * size_of(property.type);
        }
    }
}

void refuse_lying_count(const PlyBody& body, const PlyElement& element, PlyEncoding encoding) {
    const std::uint64_t shortest = shortest_row(element, encoding);
    // The last line of a text may lack its end.
    const std::uint64_t room = body.left() + (encoding == PlyEncoding::ascii ? 1 : 0);
    if (shortest == 0 || element.count <= room / shortest) return;
    throw Error(Trouble::input, body.shown + ": byte " + std::to_string(body.at),
                "the header promises " + std::to_string(element.count) + " rows of element " +
                    in_quotes(element.name) + ", but only " + std::to_string(body.left()) +
                    " bytes follow: the file is cut off or its header lies; get it again from its source");
}

} // namespace knead
