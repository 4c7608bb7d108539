#pragma once
// What a new file of a mesh format (OBJ, OFF) holds of a cloud: coordinates, colours and normals.

#include "io/new_columns.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace knead {

using ThreeColumns = std::array<NewColumn, 3>;

// They point into what the columns that they were chosen from do.
struct MeshColumns {
    ThreeColumns coordinates;
    std::optional<ThreeColumns> normals; // where find_normals() finds them
    std::optional<ThreeColumns> colours; // where find_colors() finds them
    double brightest = 1;                // what full brightness is in these

    bool colours_are_bytes() const; // all three of type uint8
};

// `all` is columns_to_write(cloud, shape).columns.
MeshColumns mesh_columns(const PointCloud& cloud, const std::vector<NewColumn>& all);

// Appends the values of point i, a blank before each, in the shortest text that reads back as their type; or,
// over `brightest`, as fractions from 0 to 1. `shown` names the target in errors.
void append_values(std::string& line, const ThreeColumns& columns, std::size_t i, const std::string& shown);
void append_fractions(std::string& line, const ThreeColumns& columns, double brightest, std::size_t i,
                      const std::string& shown);

// What write_cloud() returns of the columns that such a file has no place for; `format` is "OBJ".
std::vector<std::string> words_about_left_out(const PointCloud& cloud, const MeshColumns& columns,
                                              const PosedShape& shape, const std::string& format);
std::vector<std::string> words_about_added(const PosedShape& shape, const std::string& format);

} // namespace knead
