#include "base/error.h"
#include "base/require.h"
#include "io/lzf.h"
#include "io/new_columns.h"
#include "io/patched_copy.h"
#include "io/pcd.h"
#include "io/scalar_bytes.h"
#include "io/text_numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace knead {

namespace {

constexpr bool swapped = std::endian::native == std::endian::big; // PCD is little endian

// A field of COUNT 1 that the pose may change.
struct PosedField {
    std::size_t field = 0;
    std::size_t offset = 0; // of its number within a point's bytes
    std::size_t word = 0;   // within a point's words
    const PosedColumn* column = nullptr;
};

// What the functions below share.
struct Patching {
    const PcdImage& image;
    std::vector<PosedField> posed; // in the order of the fields
    std::vector<AddedColumn> added;
    std::string shown;

    bool is_empty() const { return posed.empty() && added.empty(); }
};

std::vector<PosedField> posed_fields(const PcdImage& image, const std::vector<PosedColumn>& columns) {
    std::vector<PosedField> posed;
    std::size_t offset = 0;
    std::size_t word = 0;
    for (std::size_t f = 0; f < image.header.fields.size(); ++f) {
        for (const PosedColumn& column : columns)
            if (image.columns[f] == column.column) posed.push_back({f, offset, word, &column});
        offset += image.header.fields[f].bytes();
        word += image.header.fields[f].count;
    }
    return posed;
}

StoredScalar stored_added(const AddedColumn& column, std::size_t point) {
    return stored_scalar(static_cast<double>(column.values[point]), ScalarType::float32, swapped);
}

// Names the added columns in the lines that have a word for each field. Lines that the header does without
// say of every field what is true of these.
void add_fields(const Patching& patching, PatchedCopy& copy) {
    constexpr std::array<std::string_view, 4> words = {"", " 4", " F", " 1"};
    std::vector<std::pair<std::size_t, std::string>> insertions;
    for (std::size_t line = 0; line < words.size(); ++line) {
        const auto end = patching.image.header.line_ends[line];
        if (!end) continue;
        std::string text;
        for (const AddedColumn& column : patching.added)
            text += line == 0 ? " " + column.name : std::string(words[line]);
        insertions.emplace_back(*end, std::move(text));
    }
    std::sort(insertions.begin(), insertions.end());
    for (const auto& [at, text] : insertions) copy.replace(at, 0, text);
}

void patch_binary(const Patching& patching, PatchedCopy& copy) {
    const PcdHeader& header = patching.image.header;
    std::size_t at = header.body;
    for (std::size_t point = 0; point < header.points; ++point, at += header.bytes_a_point) {
        for (const PosedField& posed : patching.posed)
            patch_scalar(copy, at + posed.offset, swapped, *posed.column, point, patching.shown);
        for (const AddedColumn& column : patching.added)
            copy.replace(at + header.bytes_a_point, 0, stored_added(column, point).span());
    }
}

void patch_ascii(const Patching& patching, PatchedCopy& copy) {
    const PcdHeader& header = patching.image.header;
    const char* const begin = reinterpret_cast<const char*>(patching.image.bytes.data());
    TextCursor text{begin + header.body, begin + patching.image.body_end};
    for (std::size_t point = 0; point < header.points; ++point) {
        require(find_row(text), "points lie where they were read");
        auto posed = patching.posed.begin();
        for (std::size_t word = 0; word < header.words_a_point; ++word) {
            require(find_word(text), "points lie where they were read");
            if (posed != patching.posed.end() && posed->word == word) {
                patch_word(copy, word_at(text), *posed->column, point, patching.shown);
                ++posed;
            }
            text.at = word_end(text);
        }
        std::string words;
        for (const AddedColumn& column : patching.added) {
            words += ' ';
            append_number(words, static_cast<double>(column.values[point]), ScalarType::float32);
        }
        copy.replace(copy.place_of(text.at), 0, words);
    }
}

// --- binary_compressed -------------------------------------------------------------------------------------

// Puts the posed numbers of a point into an unpacked body; whether any differs.
bool patch_point(const Patching& patching, std::size_t point, std::span<std::byte> body) {
    const PcdHeader& header = patching.image.header;
    bool changed = false;
    for (const PosedField& posed : patching.posed) {
        const auto value = posed_value(*posed.column, point, patching.shown);
        if (!value) continue;
        // The numbers of this field follow all those of the fields before it.
        const StoredScalar scalar = stored_scalar(*value, header.fields[posed.field].type, swapped);
        const std::size_t at = posed.offset * header.points + point * scalar.size;
        std::ranges::copy(scalar.span(), body.data() + at);
        changed = true;
    }
    return changed;
}

// Puts the posed numbers and the added ones into an unpacked body; whether it differs. It goes point by
// point, since a splat's columns are turned together.
bool patch_unpacked(const Patching& patching, std::vector<std::byte>& body, Progress& progress) {
    constexpr std::size_t points_between_reports = std::size_t{1} << 16;
    const std::size_t points = patching.image.header.points;
    bool changed = false;
    for (std::size_t point = 0; !patching.posed.empty() && point < points; ++point) {
        if (point % points_between_reports == 0)
            progress.step("patching", static_cast<double>(point) / static_cast<double>(points));
        changed = patch_point(patching, point, body) || changed;
    }
    for (const AddedColumn& column : patching.added)
        for (std::size_t point = 0; point < points; ++point) {
            const StoredScalar scalar = stored_added(column, point);
            body.insert(body.end(), scalar.span().begin(), scalar.span().end());
        }
    return changed || !patching.added.empty();
}

void patch_compressed(const Patching& patching, PatchedCopy& copy, Progress& progress) {
    const PcdImage& image = patching.image;
    std::vector<std::byte> body = unpack_pcd_body(image.bytes, image.header, patching.shown);
    if (!patch_unpacked(patching, body, progress)) return;
    progress.step("packing", 0);
    const std::vector<std::byte> packed = pack_lzf(body);
    if (std::max(packed.size(), body.size()) > std::numeric_limits<std::uint32_t>::max())
        throw Error(Trouble::output, patching.shown,
                    "the points take more than 4 GiB, which a binary_compressed PCD file cannot hold; save "
                    "them as .ply or .las");
    std::vector<std::byte> lengths;
    for (const std::size_t length : {packed.size(), body.size()}) {
        const StoredScalar scalar = stored_scalar(static_cast<double>(length), ScalarType::uint32, swapped);
        lengths.insert(lengths.end(), scalar.span().begin(), scalar.span().end());
    }
    copy.replace(image.header.body, 0, lengths);
    copy.replace(image.header.body, image.body_end - image.header.body, packed);
}

void write_patched(FileInTheMaking& file, const PcdImage& image, const PointCloud& cloud,
                   const PosedShape& shape, const std::string& shown, Progress& progress) {
    require(image.header.points == cloud.size(), "a cloud has the points of its image");
    const std::vector<PosedColumn> columns = posed_columns(cloud, shape);
    const Patching patching{image, posed_fields(image, columns), with_free_names(cloud, shape.added), shown};
    if (!patching.added.empty() && image.header.fields.size() + patching.added.size() > most_pcd_fields)
        throw Error(Trouble::output, shown,
                    "columns cannot be added, since a PCD file has at most " +
                        std::to_string(most_pcd_fields) + " fields; save it as .ply, or without them");
    BlockWriter out(file, image.bytes.size(), progress);
    PatchedCopy copy(image.bytes, out);
    if (!patching.added.empty()) add_fields(patching, copy);
    if (!patching.is_empty()) {
        if (image.header.encoding == PcdEncoding::ascii)
            patch_ascii(patching, copy);
        else if (image.header.encoding == PcdEncoding::binary)
            patch_binary(patching, copy);
        else
            patch_compressed(patching, copy, progress);
    }
    copy.finish();
    out.finish();
}

} // namespace

std::vector<std::string> write_pcd(FileInTheMaking& file, const PointCloud& cloud, const PosedShape& shape,
                                   const std::string& shown, Progress& progress) {
    const auto* image = dynamic_cast<const PcdImage*>(cloud.image.get());
    if (image == nullptr) return write_new_pcd(file, cloud, shape, shown, progress);
    write_patched(file, *image, cloud, shape, shown, progress);
    return {};
}

} // namespace knead
