#include "base/error.h"
#include "io/new_columns.h"
#include "io/patched_copy.h"
#include "io/ply.h"
#include "io/posed_values.h"
#include "io/scalar_bytes.h"

#include <array>

namespace knead {

namespace {

// PLY has no integers of 8 bytes.
bool is_too_wide(ScalarType type) {
    return is_whole(type) && size_of(type) == 8;
}

std::string new_header(std::size_t points, const std::vector<NewColumn>& columns) {
    std::string header =
        "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points) + "\n";
    for (const NewColumn& column : columns) {
        header += "property ";
        if (column.is_list()) header.append("list ").append(ply_name_of(column.attribute->count_type)) += ' ';
        header.append(ply_name_of(column.type)).append(" ").append(column.name) += '\n';
    }
    return header + "end_header\n";
}

void append_list(BlockWriter& out, const NewColumn& column, std::size_t point, const std::string& shown) {
    const Attribute& list = *column.attribute;
    const std::uint64_t length = list.first[point + 1] - list.first[point];
    const auto as_counted = static_cast<double>(length);
    if (rounded_to(list.count_type, as_counted) != as_counted)
        throw Error(Trouble::output, shown,
                    "the list " + list.name + " of point " + std::to_string(point) + " has " +
                        std::to_string(length) + " values, more than its length's type can count");
    std::array<std::byte, 8> count{};
    store_scalar(as_counted, list.count_type, count.data());
    out.append_little(count.data(), 1, size_of(list.count_type));
    const std::size_t size = size_of(list.type);
    if (list.type == column.type)
        return out.append_little(list.values.data() + list.first[point] * size, length, size);
    std::array<std::byte, 8> scalar{};
    for (std::uint64_t k = list.first[point]; k < list.first[point + 1]; ++k) {
        store_scalar(value_at(list, k), column.type, scalar.data());
        out.append_little(scalar.data(), 1, size_of(column.type));
    }
}

// As double what PLY has no type for.
void widen(std::vector<NewColumn>& columns, std::vector<std::string>& left_out) {
    for (NewColumn& column : columns) {
        if (!is_too_wide(column.type)) continue;
        left_out.push_back("the column " + column.name + " is of type " + std::string(name_of(column.type)) +
                           ", which PLY does not have: it becomes double, exact up to 2^53");
        column.type = ScalarType::float64;
    }
}

void append_scalar(BlockWriter& out, const NewColumn& column, std::size_t point, const std::string& shown) {
    std::array<std::byte, 8> scalar{};
    if (column.attribute != nullptr && column.attribute->type != column.type)
        store_scalar(new_value(column, point, shown), column.type, scalar.data());
    else
        scalar = new_scalar(column, point, shown);
    out.append_little(scalar.data(), 1, size_of(column.type));
}

} // namespace

std::vector<std::string> write_new_ply(FileInTheMaking& file, const PointCloud& cloud,
                                       const PosedShape& shape, const std::string& shown,
                                       Progress& progress) {
    ColumnsToWrite all = columns_to_write(cloud, shape);
    std::vector<NewColumn>& columns = all.columns;
    name_standard_columns(columns, cloud, {"nx", "ny", "nz"});
    std::vector<std::string> left_out = make_names_legal(columns, is_word_letter);
    widen(columns, left_out);
    const std::string header = new_header(cloud.size(), columns);
    std::size_t total = header.size();
    for (const NewColumn& column : columns)
        total += column.is_list()
                     ? column.attribute->values.size() + cloud.size() * size_of(column.attribute->count_type)
                     : cloud.size() * size_of(column.type);
    BlockWriter out(file, total, progress);
    out.append(header);
    for (std::size_t point = 0; point < cloud.size(); ++point)
        for (const NewColumn& column : columns)
            if (column.is_list())
                append_list(out, column, point, shown);
            else
                append_scalar(out, column, point, shown);
    out.finish();
    return left_out;
}

} // namespace knead
