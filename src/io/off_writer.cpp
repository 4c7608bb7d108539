#include "base/require.h"
#include "io/mesh_columns.h"
#include "io/off.h"
#include "io/patched_copy.h"
#include "io/text_statements.h"

#include <optional>

namespace knead {

namespace {

void write_patched(FileInTheMaking& file, const OffImage& image, const PointCloud& cloud,
                   const PosedShape& shape, const std::string& shown, Progress& progress) {
    require(image.points == cloud.size(), "a cloud has the points of its image");
    BlockWriter out(file, image.bytes.size(), progress);
    PatchedCopy copy(image.bytes, out);
    const auto columns = posed_columns(cloud, shape);
    TextStatements rows(std::span(image.bytes).subspan(image.rows_begin));
    for (std::size_t point = 0; !columns.empty() && point < image.points; ++point) {
        require(rows.next(), "rows lie where they were read");
        std::optional<std::string_view> word = rows.keyword();
        std::size_t place = 0; // of the word in its row, which is that of its column
        for (const PosedColumn& column : columns) {
            for (; place < column.column; ++place) word = rows.word();
            require(word.has_value(), "rows are as they were read");
            patch_word(copy, *word, column, point, shown);
        }
    }
    copy.finish();
    out.finish();
}

void write_new(FileInTheMaking& file, const MeshColumns& columns, std::size_t points,
               const std::string& shown, Progress& progress) {
    constexpr std::size_t bytes_of_a_number = 10; // about
    const std::size_t numbers = 3 + (columns.normals ? 3 : 0) + (columns.colours ? 4 : 0);
    BlockWriter out(file, points * numbers * bytes_of_a_number, progress);
    out.append(std::string(columns.colours ? "C" : "") + (columns.normals ? "N" : "") + "OFF\n" +
               std::to_string(points) + " 0 0\n");
    std::string line;
    for (std::size_t point = 0; point < points; ++point) {
        line.clear();
        append_values(line, columns.coordinates, point, shown);
        if (columns.normals) append_values(line, *columns.normals, point, shown);
        if (columns.colours) {
            // Bytes stay bytes, which more programs read than the fractions of the manual. Nothing is
            // transparent.
            if (columns.colours_are_bytes())
                append_values(line, *columns.colours, point, shown);
            else
                append_fractions(line, *columns.colours, columns.brightest, point, shown);
            line += columns.colours_are_bytes() ? " 255" : " 1.0";
        }
        line += '\n';
        out.append(std::string_view(line).substr(1));
    }
    out.finish();
}

} // namespace

std::vector<std::string> write_off(FileInTheMaking& file, const PointCloud& cloud, const PosedShape& shape,
                                   const std::string& shown, Progress& progress) {
    if (const auto* image = dynamic_cast<const OffImage*>(cloud.image.get())) {
        write_patched(file, *image, cloud, shape, shown, progress);
        return words_about_added(shape, "OFF");
    }
    const ColumnsToWrite all = columns_to_write(cloud, shape);
    const MeshColumns columns = mesh_columns(cloud, all.columns);
    write_new(file, columns, cloud.size(), shown, progress);
    return words_about_left_out(cloud, columns, shape, "OFF");
}

} // namespace knead
