#pragma once
// Handles that somebody else has drawn already: by a label for every point in the file, or in another
// session.

#include "edit/editor.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace knead {

// A column of the file that looks like a label of every point.
struct LabelColumn {
    struct Value {
        std::int64_t value = 0;
        std::size_t points = 0; // that have it
    };
    std::string name;
    std::vector<Value> values; // that occur, ascending
    std::size_t commonest = 0; // among them: what was not labelled, most likely
};

inline constexpr std::size_t most_labels = 64;

// The columns of whole numbers, other than coordinates, with 2 … most_labels different values.
std::vector<LabelColumn> label_columns(const PointCloud& cloud);

// What becomes of the points with a value.
struct LabelChoice {
    std::int64_t value = 0;
    HandleRole role = HandleRole::moving;
};

// Makes a handle "COLUMN VALUE" of the points of each of these values, all in one step of undo. One that has
// the name already is replaced, which is said. Values without points are passed over; points that are not
// finite are left out.
void handles_from_labels(Editor& editor, const std::string& column, std::span<const LabelChoice> choices);

// Makes the handles that a session has at its end, on the shape as it is now, in one step of undo; one whose
// name is taken gets another, "arm (2)", which is said. Its poses are not taken. A session that cannot be
// read, that has no handles, or whose handles name points by number and are of a cloud with other points, is
// refused with words, and nothing is made.
void handles_from_session(Editor& editor, const std::filesystem::path& session);

} // namespace knead
