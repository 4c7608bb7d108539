#pragma once
// The rows of a PLY body, read into columns or passed over. Reader only.

#include "base/progress.h"
#include "io/ply_header.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace knead {

// A place in a file's bytes.
struct PlyBody {
    std::span<const std::byte> bytes; // the whole file
    std::size_t at = 0;
    std::string shown; // the file's name, for errors

    std::size_t left() const { return bytes.size() - at; }
};

// Reads the rows of `element` at body.at into `columns` (one a property, named and typed, with no values yet)
// and moves body.at behind them. The rows must be known to fit by refuse_lying_count(). Throws Error (input)
// with the place of the trouble.
void read_ascii_rows(PlyBody& body, const PlyElement& element, std::vector<Attribute>& columns,
                     Progress& progress);
void read_binary_rows(PlyBody& body, const PlyElement& element, bool swap, std::vector<Attribute>& columns,
                      Progress& progress);

// Moves body.at behind the rows of an element that is kept as it is.
void skip_ascii_rows(PlyBody& body, const PlyElement& element, Progress& progress);
void skip_binary_rows(PlyBody& body, const PlyElement& element, bool swap, Progress& progress);

// Throws Error (input) if even the shortest rows would not fit into what is left of the file, so that no
// memory is asked for on the word of a header.
void refuse_lying_count(const PlyBody& body, const PlyElement& element, PlyEncoding encoding);

} // namespace knead
