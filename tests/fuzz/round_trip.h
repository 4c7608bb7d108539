#pragma once
// What must hold of every file that a reader takes, whatever its format.

#include "cloud/point_cloud.h"

#include <cstddef>
#include <span>
#include <string_view>

namespace knead::fuzz {

// What a format does not promise.
struct Looseness {
    // The step between the values that a column of this cloud can hold in its file, where that is coarser
    // than the column's type; 0 where it is not. Null: it never is.
    double (*step)(const PointCloud& cloud, std::size_t column) = nullptr;
    // Names and types of columns are guessed from their values, and an edit may change the guess.
    bool guesses_columns = false;
};

// Reads the bytes as a file of the format of this name; returns whether they were accepted. A refusal is an
// Error of input that names the file. An accepted cloud
// - saves to the same bytes, unedited and in a pose that is its rest;
// - moved, turned and with a column added, reads back at the file's own coordinates plus the displacement,
//   rounded to the column's type or step, with the turned normals, the column, and all else as it was; a
//   format that cannot hold the column says so;
// - without its image, so as a new file, reads back with as many points, and from PLY to PLY with the same
//   columns.
// A file whose types cannot hold what is asked for may refuse to be saved by an Error of output.
// Throws BrokenInvariant where one of these does not hold.
bool check_round_trip(std::string_view format, std::span<const std::byte> bytes,
                      const Looseness& looseness = {});

} // namespace knead::fuzz
