#pragma once
// The faces, lines and point elements of an OBJ file: checked, and asked for whose normals are whose. Reader
// only.

#include "io/obj.h"

namespace knead {

// Reads all elements of a file whose statements are counted (`image.counts`). Throws Error (input) with file
// and line for a number that is none or that names what is not in the file. Fills image.point_of_normal and
// has_normals.
void read_obj_elements(ObjImage& image, const std::string& shown, Progress& progress);

} // namespace knead
