#include "base/error.h"
#include "base/require.h"
#include "io/new_columns.h"
#include "io/patched_copy.h"
#include "io/ply.h"
#include "io/scalar_bytes.h"
#include "io/text_numbers.h"

#include <algorithm>

namespace knead {

namespace {

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
    patching.copy.replace(place.at, 0, lines);
}

void add_binary_values(Patching& patching, std::size_t point, std::size_t at, bool swap) {
    for (const AddedColumn& column : patching.added) {
        const StoredScalar scalar =
            stored_scalar(static_cast<double>(column.values[point]), ScalarType::float32, swap);
        patching.copy.replace(at, 0, scalar.span());
    }
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
                patch_scalar(patching.copy, at, swap, *column, point, patching.shown);
            at += size_of(property.type);
        }
        add_binary_values(patching, point, at, swap);
    }
    require(at == patching.image.rows_end, "rows lie where they were read");
}

void add_words(Patching& patching, std::size_t point, const TextCursor& text) {
    std::string words;
    for (const AddedColumn& column : patching.added) {
        words += ' ';
        append_number(words, static_cast<double>(column.values[point]), ScalarType::float32);
    }
    patching.copy.replace(patching.copy.place_of(text.at), 0, words);
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
                if (const PosedColumn* column = patching.posed[p])
                    patch_word(patching.copy, word_at(text), *column, point, patching.shown);
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

} // namespace

std::vector<std::string> write_ply(FileInTheMaking& file, const PointCloud& cloud, const PosedShape& shape,
                                   const std::string& shown, Progress& progress) {
    const auto* image = dynamic_cast<const PlyImage*>(cloud.image.get());
    if (image == nullptr) return write_new_ply(file, cloud, shape, shown, progress);
    write_patched(file, *image, cloud, shape, shown, progress);
    return {};
}

} // namespace knead
