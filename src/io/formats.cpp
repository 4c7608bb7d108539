#include "io/format.h"

#include "base/lower_case.h"
#include "io/las.h"
#include "io/obj.h"
#include "io/off.h"
#include "io/pcd.h"
#include "io/ply.h"
#include "io/table.h"

#include <algorithm>
#include <array>

namespace knead {

namespace {

constexpr std::array<std::string_view, 1> ply_extensions = {".ply"};

constexpr std::array<std::string_view, 1> las_extensions = {".las"};
constexpr std::array<std::string_view, 1> obj_extensions = {".obj"};
constexpr std::array<std::string_view, 1> off_extensions = {".off"};

constexpr std::array<std::string_view, 1> pcd_extensions = {".pcd"};

constexpr std::array<std::string_view, 1> xyz_extensions = {".xyz"};
constexpr std::array<std::string_view, 2> txt_extensions = {".txt", ".asc"};
constexpr std::array<std::string_view, 1> csv_extensions = {".csv"};
constexpr std::array<std::string_view, 1> pts_extensions = {".pts"};

// The kinds of tables look alike; the reader tells them by the file's name.
bool looks_like_none(std::span<const std::byte> /*first_bytes*/) {
    return false;
}

template<TableKind kind>
std::vector<std::string> write_table_as(FileInTheMaking& file, const PointCloud& cloud,
                                        const PosedShape& shape, const std::string& shown,
                                        Progress& progress) {
    return write_table(kind, file, cloud, shape, shown, progress);
}

constexpr std::array<Format, 9> formats = {{
    {"ply", ply_extensions, "any attributes", looks_like_ply, read_ply, write_ply},
    {"las", las_extensions, "for surveying programs", looks_like_las, read_las, write_las},
    {"pcd", pcd_extensions, "for the Point Cloud Library", looks_like_pcd, read_pcd, write_pcd},
    {"obj", obj_extensions, "normals and colours", looks_like_obj, read_obj, write_obj},
    {"off", off_extensions, "normals and colours", looks_like_off, read_off, write_off, looks_like_bare_off},
    // Behind all others, since any row of numbers is a table.
    {"txt", txt_extensions, "numbers in columns", looks_like_table, read_table,
     write_table_as<TableKind::txt>},
    {"xyz", xyz_extensions, "numbers in columns", looks_like_none, read_table,
     write_table_as<TableKind::xyz>},
    {"csv", csv_extensions, "numbers between commas", looks_like_none, read_table,
     write_table_as<TableKind::csv>},
    {"pts", pts_extensions, "intensity and colours alone", looks_like_none, read_table,
     write_table_as<TableKind::pts>},
}};

} // namespace

std::span<const Format> known_formats() {
    return formats;
}

const Format* format_with_extension(const std::filesystem::path& path) {
    const std::string extension = lower_case(path.extension().string());
    for (const Format& format : formats)
        if (std::find(format.extensions.begin(), format.extensions.end(), extension) !=
            format.extensions.end())
            return &format;
    return nullptr;
}

std::string known_extensions() {
    std::string all;
    for (const Format& format : formats)
        for (const std::string_view extension : format.extensions)
            all.append(all.empty() ? "" : ", ").append(extension);
    return all;
}

} // namespace knead
