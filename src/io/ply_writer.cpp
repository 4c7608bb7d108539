#include "base/require.h"
#include "base/whole_file.h"
#include "io/ascii_rows.h"
#include "io/ply.h"
#include "io/posed_values.h"
#include "io/scalar_bytes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>

namespace knead {

namespace {

constexpr std::size_t block_size = std::size_t{4} << 20;

// Collects small pieces into blocks, and says how much of the whole is written.
class BlockWriter {
public:
    BlockWriter(FileInTheMaking& file, std::size_t total, Progress& progress)
        : file_(file), progress_(progress), total_(static_cast<double>(std::max<std::size_t>(total, 1))) {
        buffer_.reserve(std::min(total, block_size) + 64);
        progress.step("writing", 0);
    }

    void append(std::span<const std::byte> bytes) {
        if (buffer_.size() + bytes.size() > block_size) flush();
        for (; bytes.size() > block_size; bytes = bytes.subspan(block_size)) put(bytes.first(block_size));
        buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    }

    void finish() {
        flush();
        progress_.step("writing", 1);
    }

private:
    void flush() {
        put(buffer_);
        buffer_.clear();
    }

    void put(std::span<const std::byte> bytes) {
        file_.write(bytes);
        written_ += bytes.size();
        progress_.step("writing", std::min(1.0, static_cast<double>(written_) / total_));
    }

    FileInTheMaking& file_;
    Progress& progress_;
    double total_;
    std::vector<std::byte> buffer_;
    std::size_t written_ = 0;
};

// Copies a file's bytes, with other bytes at some places, told in ascending order.
class PatchedCopy {
public:
    PatchedCopy(std::span<const std::byte> source, BlockWriter& out) : source_(source), out_(out) {}

    void replace(std::size_t at, std::size_t size, std::span<const std::byte> by) {
        out_.append(source_.subspan(copied_, at - copied_));
        out_.append(by);
        copied_ = at + size;
    }

    void finish() { out_.append(source_.subspan(copied_)); }

private:
    std::span<const std::byte> source_;
    BlockWriter& out_;
    std::size_t copied_ = 0;
};

// The added columns under names that the cloud does not have.
std::vector<AddedColumn> with_free_names(const PointCloud& cloud, std::vector<AddedColumn> added) {
    for (std::size_t a = 0; a < added.size(); ++a) {
        require(added[a].values.size() == cloud.size(), "an added column has a value a point");
        const std::string name = added[a].name;
        const auto is_taken = [&](const std::string& candidate) {
            return find_attribute(cloud, candidate).has_value() ||
                   std::any_of(added.begin(), added.begin() + static_cast<std::ptrdiff_t>(a),
                               [&](const AddedColumn& other) { return other.name == candidate; });
        };
        for (unsigned number = 2; is_taken(added[a].name); ++number)
            added[a].name = name + "_" + std::to_string(number);
    }
    return added;
}

// The place in a header behind the last property of its vertices, and how its lines end.
struct HeaderPlace {
    std::size_t at = 0;
    std::string line_end;
};
HeaderPlace behind_the_properties(const PlyImage& image) {
    const std::string_view text(reinterpret_cast<const char*>(image.bytes.data()), image.header.body);
    HeaderPlace place;
    const std::size_t first_end = text.find_first_of("\r\n");
    place.line_end = text.substr(first_end, text.substr(first_end, 2) == "\r\n" ? 2 : 1);
    std::size_t line = 1;
    for (std::size_t begin = 0; begin < text.size(); ++line) {
        // As the reader splits it, which takes \r\n and \n mixed.
        const std::size_t end = std::min(text.find(place.line_end.back(), begin), text.size());
        std::string_view words = text.substr(begin, end - begin);
        words.remove_prefix(std::min(words.find_first_not_of(" \t\v\f\r"), words.size()));
        begin = std::min(end + 1, text.size());
        if (line < image.vertices().line) continue;
        if (line > image.vertices().line && (words.starts_with("element") || words.starts_with("end_header")))
            break;
        if (line == image.vertices().line || words.starts_with("property")) place.at = begin;
    }
    return place;
}

// What the functions below share: where the rows come from, where they go, and what changes.
struct Patching {
    const PlyImage& image;
    std::vector<const PosedColumn*> posed; // one a vertex property; null where nothing changes
    std::string shown;
    std::vector<AddedColumn> added;
    PatchedCopy copy;
};

void add_properties(Patching& patching) {
    const HeaderPlace place = behind_the_properties(patching.image);
    std::string lines;
    for (const AddedColumn& column : patching.added)
        lines += "property float " + column.name + place.line_end;
    patching.copy.replace(place.at, 0, std::as_bytes(std::span(lines)));
}

void add_binary_values(Patching& patching, std::size_t point, std::size_t at, bool swap) {
    for (const AddedColumn& column : patching.added) {
        std::array<std::byte, 4> stored{};
        copy_scalar(reinterpret_cast<const std::byte*>(&column.values[point]), 4, swap, stored.data());
        patching.copy.replace(at, 0, stored);
    }
}

void patch_binary(Patching& patching, const PosedColumn& column, std::size_t point, std::size_t at,
                  bool swap) {
    const auto value = posed_value(column, point, patching.shown);
    if (!value) return;
    const std::size_t size = size_of(column.attribute->type);
    std::array<std::byte, 8> native{};
    std::array<std::byte, 8> stored{};
    store_scalar(*value, column.attribute->type, native.data());
    copy_scalar(native.data(), size, swap, stored.data());
    patching.copy.replace(at, size, std::span(stored).first(size));
}

void patch_binary_rows(Patching& patching) {
    const PlyElement& vertices = patching.image.vertices();
    const bool swap = is_swapped(patching.image.header.encoding);
    std::size_t at = patching.image.rows_begin;
    for (std::size_t point = 0; point < vertices.count; ++point) {
        for (std::size_t p = 0; p < vertices.properties.size(); ++p) {
            const PlyProperty& property = vertices.properties[p];
            if (property.is_list) {
                const std::byte* const count = patching.image.bytes.data() + at;
                const auto values = static_cast<std::size_t>(load_integer(count, property.count_type, swap));
                at += size_of(property.count_type) + values * size_of(property.type);
                continue;
            }
            if (const PosedColumn* column = patching.posed[p])
                patch_binary(patching, *column, point, at, swap);
            at += size_of(property.type);
        }
        add_binary_values(patching, point, at, swap);
    }
    require(at == patching.image.rows_end, "rows lie where they were read");
}

// The shortest text that reads back as this value of this type.
std::size_t print_scalar(double value, ScalarType type, std::span<char> to) {
    const auto print = [to](auto typed) {
        const auto [end, trouble] = std::to_chars(to.data(), to.data() + to.size(), typed);
        require(trouble == std::errc{}, "a number fits its buffer");
        return static_cast<std::size_t>(end - to.data());
    };
    if (type == ScalarType::float64) return print(value);
    if (type == ScalarType::float32) return print(static_cast<float>(value));
    return print(static_cast<std::int64_t>(value));
}

void patch_word(Patching& patching, const PosedColumn& column, std::size_t point, const TextCursor& text) {
    const auto value = posed_value(column, point, patching.shown);
    if (!value) return;
    std::array<char, 64> buffer{};
    const std::size_t length = print_scalar(*value, column.attribute->type, buffer);
    const char* const begin = reinterpret_cast<const char*>(patching.image.bytes.data());
    patching.copy.replace(static_cast<std::size_t>(text.at - begin),
                          static_cast<std::size_t>(word_end(text) - text.at),
                          std::as_bytes(std::span(buffer).first(length)));
}

void add_words(Patching& patching, std::size_t point, const TextCursor& text) {
    std::string words;
    for (const AddedColumn& column : patching.added) {
        std::array<char, 64> buffer{};
        const std::size_t length =
            print_scalar(static_cast<double>(column.values[point]), ScalarType::float32, buffer);
        (words += ' ').append(buffer.data(), length);
    }
    const char* const begin = reinterpret_cast<const char*>(patching.image.bytes.data());
    patching.copy.replace(static_cast<std::size_t>(text.at - begin), 0, std::as_bytes(std::span(words)));
}

void patch_ascii_rows(Patching& patching, const PointCloud& cloud) {
    const PlyElement& vertices = patching.image.vertices();
    const char* const begin = reinterpret_cast<const char*>(patching.image.bytes.data());
    TextCursor text{begin + patching.image.rows_begin, begin + patching.image.rows_end};
    for (std::size_t point = 0; point < vertices.count; ++point) {
        require(find_row(text), "rows lie where they were read");
        for (std::size_t p = 0; p < vertices.properties.size(); ++p) {
            // A list is its length and that many words; one at the end of a row may have been left out.
            const std::vector<std::uint64_t>& first = cloud.attributes[p].first;
            std::uint64_t words = first.empty() ? 1 : 1 + first[point + 1] - first[point];
            for (; words > 0; --words) {
                const bool found = find_word(text);
                if (!found && p + 1 == vertices.properties.size() && words == 1) {
                    if (patching.added.empty()) break;
                    throw Error(Trouble::output, patching.shown,
                                "columns cannot be added, since point " + std::to_string(point) +
                                    " has no word for its last list in the file that it came from");
                }
                require(found, "rows lie where they were read");
                if (const PosedColumn* column = patching.posed[p]) patch_word(patching, *column, point, text);
                text.at = word_end(text);
            }
        }
        if (!patching.added.empty()) add_words(patching, point, text);
    }
}

void write_patched(FileInTheMaking& file, const PlyImage& image, const PointCloud& cloud,
                   const PosedShape& shape, const std::string& shown, Progress& progress) {
    require(image.vertices().count == cloud.size() &&
                image.vertices().properties.size() == cloud.attributes.size(),
            "a cloud has the points and attributes of its image");
    BlockWriter out(file, image.bytes.size(), progress);
    const auto columns = posed_columns(cloud, shape);
    Patching patching{image, {}, shown, with_free_names(cloud, shape.added), PatchedCopy(image.bytes, out)};
    patching.posed.resize(cloud.attributes.size(), nullptr);
    for (const PosedColumn& column : columns) patching.posed[column.column] = &column;
    if (!patching.added.empty()) add_properties(patching);
    if (!columns.empty() || !patching.added.empty()) {
        if (image.header.encoding == PlyEncoding::ascii)
            patch_ascii_rows(patching, cloud);
        else
            patch_binary_rows(patching);
    }
    patching.copy.finish();
    out.finish();
}

std::string new_header(const PointCloud& cloud, const std::vector<AddedColumn>& added) {
    std::string header =
        "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(cloud.size()) + "\n";
    for (const Attribute& attribute : cloud.attributes) {
        require(!attribute.name.empty() && attribute.name.find_first_of(" \t\r\n\v\f") == std::string::npos,
                "an attribute's name is one word");
        header += "property ";
        if (attribute.is_list()) header.append("list ").append(ply_name_of(attribute.count_type)) += ' ';
        header.append(ply_name_of(attribute.type)).append(" ").append(attribute.name) += '\n';
    }
    for (const AddedColumn& column : added) header += "property float " + column.name + '\n';
    return header + "end_header\n";
}

// Appends `count` native scalars as little endian.
void append_scalars(BlockWriter& out, const std::byte* from, std::size_t count, std::size_t size) {
    if constexpr (std::endian::native == std::endian::little) {
        out.append({from, count * size});
    } else {
        std::array<std::byte, 8> turned{};
        for (; count > 0; --count, from += size) {
            copy_scalar(from, size, true, turned.data());
            out.append(std::span(turned).first(size));
        }
    }
}

void append_list(BlockWriter& out, const Attribute& list, std::size_t point, const std::string& shown) {
    const std::uint64_t length = list.first[point + 1] - list.first[point];
    std::array<std::byte, 8> count{};
    store_scalar(static_cast<double>(length), list.count_type, count.data());
    const std::int64_t stored = load_integer(count.data(), list.count_type, false);
    if (stored < 0 || static_cast<std::uint64_t>(stored) != length)
        throw Error(Trouble::output, shown,
                    "the list " + list.name + " of point " + std::to_string(point) + " has " +
                        std::to_string(length) + " values, more than its length's type can count");
    append_scalars(out, count.data(), 1, size_of(list.count_type));
    const std::size_t size = size_of(list.type);
    append_scalars(out, list.values.data() + list.first[point] * size, length, size);
}

void write_new(FileInTheMaking& file, const PointCloud& cloud, const PosedShape& shape,
               const std::string& shown, Progress& progress) {
    const std::vector<AddedColumn> added = with_free_names(cloud, shape.added);
    const std::string header = new_header(cloud, added);
    std::size_t total = header.size() + 4 * added.size() * cloud.size();
    for (const Attribute& attribute : cloud.attributes)
        total += attribute.values.size() +
                 (attribute.is_list() ? cloud.size() * size_of(attribute.count_type) : 0);
    BlockWriter out(file, total, progress);
    out.append(std::as_bytes(std::span(header)));

    const auto columns = posed_columns(cloud, shape);
    std::vector<const PosedColumn*> posed(cloud.attributes.size(), nullptr);
    for (const PosedColumn& column : columns) posed[column.column] = &column;
    for (std::size_t point = 0; point < cloud.size(); ++point) {
        for (std::size_t a = 0; a < cloud.attributes.size(); ++a) {
            const Attribute& attribute = cloud.attributes[a];
            if (attribute.is_list()) {
                append_list(out, attribute, point, shown);
                continue;
            }
            const std::size_t size = size_of(attribute.type);
            std::array<std::byte, 8> moved{};
            const std::byte* from = attribute.values.data() + point * size;
            if (const auto value = posed[a] ? posed_value(*posed[a], point, shown) : std::nullopt) {
                store_scalar(*value, attribute.type, moved.data());
                from = moved.data();
            }
            append_scalars(out, from, 1, size);
        }
        for (const AddedColumn& column : added)
            append_scalars(out, reinterpret_cast<const std::byte*>(&column.values[point]), 1, 4);
    }
    out.finish();
}

} // namespace

void write_ply(const std::filesystem::path& path, const PointCloud& cloud, const PosedShape& shape,
               Progress& progress) {
    FileInTheMaking file(path);
    if (const auto* image = dynamic_cast<const PlyImage*>(cloud.image.get()))
        write_patched(file, *image, cloud, shape, path.string(), progress);
    else
        write_new(file, cloud, shape, path.string(), progress);
    progress.stop_if_cancelled();
    file.commit();
}

} // namespace knead
