#include "base/error.h"
#include "base/require.h"
#include "io/mesh_columns.h"
#include "io/obj.h"
#include "io/patched_copy.h"
#include "io/text_statements.h"

#include <array>

namespace knead {

namespace {

// What changes in a file, and where it goes.
struct Patching {
    const ObjImage& image;
    std::array<const PosedColumn*, 3> coordinates{}; // null where nothing changes
    std::array<const PosedColumn*, 3> normals{};
    std::string shown;
    PatchedCopy copy;
};

// The words of the statement that stand for x, y and z of this point.
void patch_words(Patching& patching, TextStatements& statements,
                 const std::array<const PosedColumn*, 3>& columns, std::size_t point) {
    for (const PosedColumn* column : columns) {
        const auto word = statements.word();
        require(word.has_value(), "statements are as they were read");
        if (column != nullptr) patch_word(patching.copy, *word, *column, point, patching.shown);
    }
}

void patch_statements(Patching& patching) {
    TextStatements statements(patching.image.bytes);
    std::size_t points = 0, normals = 0;
    while (statements.next()) {
        if (statements.keyword() == "v") {
            patch_words(patching, statements, patching.coordinates, points++);
        } else if (statements.keyword() == "vn" && patching.image.has_normals) {
            const Index point = patching.image.point_of_normal[normals++];
            if (point != no_index) patch_words(patching, statements, patching.normals, point);
        }
    }
    require(points == patching.image.counts.points, "statements are as they were read");
}

void write_patched(FileInTheMaking& file, const ObjImage& image, const PointCloud& cloud,
                   const PosedShape& shape, const std::string& shown, Progress& progress) {
    require(image.counts.points == cloud.size(), "a cloud has the points of its image");
    BlockWriter out(file, image.bytes.size(), progress);
    const auto columns = posed_columns(cloud, shape);
    Patching patching{image, {}, {}, shown, PatchedCopy(image.bytes, out)};
    const auto normals = find_normals(cloud);
    for (const PosedColumn& column : columns)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (column.column == cloud.coordinate_columns[axis]) patching.coordinates[axis] = &column;
            if (normals && column.column == (*normals)[axis]) patching.normals[axis] = &column;
        }
    if (!columns.empty()) patch_statements(patching);
    patching.copy.finish();
    out.finish();
}

void write_new(FileInTheMaking& file, const MeshColumns& columns, std::size_t points,
               const std::string& shown, Progress& progress) {
    constexpr std::size_t bytes_of_a_number = 10; // about
    BlockWriter out(file,
                    points * bytes_of_a_number * (3 + (columns.colours ? 3 : 0) + (columns.normals ? 3 : 0)),
                    progress);
    std::string line;
    for (std::size_t point = 0; point < points; ++point) {
        line = "v";
        append_values(line, columns.coordinates, point, shown);
        if (columns.colours) append_fractions(line, *columns.colours, columns.brightest, point, shown);
        out.append(line += '\n');
    }
    for (std::size_t point = 0; columns.normals && point < points; ++point) {
        line = "vn";
        append_values(line, *columns.normals, point, shown);
        out.append(line += '\n');
    }
    out.finish();
}

} // namespace

std::vector<std::string> write_obj(FileInTheMaking& file, const PointCloud& cloud, const PosedShape& shape,
                                   const std::string& shown, Progress& progress) {
    if (const auto* image = dynamic_cast<const ObjImage*>(cloud.image.get())) {
        write_patched(file, *image, cloud, shape, shown, progress);
        return words_about_added(shape, "OBJ");
    }
    if (cloud.size() == 0)
        throw Error(Trouble::output, shown,
                    "the cloud has no points, and OBJ no way to say so; save it as .ply");
    const ColumnsToWrite all = columns_to_write(cloud, shape);
    const MeshColumns columns = mesh_columns(cloud, all.columns);
    write_new(file, columns, cloud.size(), shown, progress);
    return words_about_left_out(cloud, columns, shape, "OBJ");
}

} // namespace knead
