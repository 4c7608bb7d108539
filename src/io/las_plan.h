#pragma once
// Which LAS points hold the columns of a cloud.

#include "io/las_dimensions.h"
#include "io/new_columns.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace knead {

// A column and where it goes.
struct LasField {
    NewColumn column;
    LasDimension dimension; // where in a point
    double factor = 1;      // of the values: colours fill 16 bits, as LAS asks for
    bool is_extra = false;  // extra bytes, of the column's own type
};

struct LasPlan {
    unsigned minor = 2; // of version 1.minor
    unsigned point_format = 0;
    std::size_t point_length = 0;
    std::array<NewColumn, 3> coordinates;
    std::vector<LasField> fields;
    std::vector<LasDimension>
        ones; // to be filled with 1: each point is one return of one, unless columns say so
    std::size_t extra_columns = 0;
};

// LAS 1.2 with point format 0 to 3 where all columns, lists aside, have a place there; else 1.4 with format
// 6, 7 or 8, and extra bytes of its own type for each column without a place. A column goes to the place that
// has its name, letter case aside: the first of that name, if all its values are whole numbers that fit; to
// gps_time, if it is of floats; to red, green and blue, if there are all three. What cannot be held, which
// are lists and more columns of extra bytes than one record describes, is told in `heard`, and so are names
// that change.
LasPlan plan_las(const PointCloud& cloud, std::vector<NewColumn> columns, std::vector<std::string>& heard);

} // namespace knead
