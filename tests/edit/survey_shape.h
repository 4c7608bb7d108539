#pragma once
// The benchmark shapes of M. Botsch and O. Sorkine, "On linear variational surface deformation methods"
// (2008): a mesh, of which only the vertices are used, who holds each vertex, and where the moving ones go.

#include "cloud/point_cloud.h"

#include <filesystem>
#include <string>

namespace knead::test {

struct SurveyShape {
    PointCloud cloud;
    std::string handles; // the two session lines
    std::string drag;    // the third
};

// From NAME.off with NAME.sel (0 fixed, 1 free, 2 moving) and NAME.def (a matrix) beside it.
SurveyShape read_survey_shape(const std::filesystem::path& off_file);

} // namespace knead::test
