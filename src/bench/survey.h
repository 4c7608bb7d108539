#pragma once
// Deformation tasks with a known motion: the four shapes of the Botsch–Sorkine survey, and likenesses of
// three of them for where the survey's files are not at hand.

#include "base/progress.h"
#include "bench/data_files.h"
#include "cloud/point_cloud.h"
#include "edit/session.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace knead {

class Workers;
struct ShapeOptions;

// One handle stays, the other takes `pose` about `pivot` (the file's coordinates), in one frame.
struct DeformationTask {
    std::string name;
    PointCloud cloud;
    std::vector<Index> fixed, handle; // ascending, neither empty
    Vec3d pivot = Vec3d::Zero();
    HandlePose pose;
};

// Reads NAME.off (the vertices; faces are not looked at), NAME.sel (a line a vertex: 0 fixed, 1 free, 2
// handle) and NAME.def (the handle's rigid motion, 4×4, row by row); in all of them what follows a # is a
// remark. Throws Error (input) with file and line.
DeformationTask read_survey_task(const std::filesystem::path& folder, std::string_view name);

// The names of the survey's shapes, in the order of the table: bar, cactus, cylinder, plane.
std::vector<std::string> survey_names();

// The first of the folders that has a survey shape, or nothing.
std::optional<std::filesystem::path> survey_folder(const DataFolders& folders);

// Likenesses: "made-bar" twisted by 135°, "made-cylinder" bent by 120°, "made-plane" pulled
// aside and up, each of some thousand points.
std::vector<std::string> generated_names();
// Those; "made-solid-bar", bent by 120°; and "made-long-bar", twice as long as the first and twisted by 180°:
// its ends lie at ±long_bar_half along z, its free part between ±long_bar_free.
inline constexpr double long_bar_half = 5, long_bar_free = 4.5;
DeformationTask generated_task(std::string_view name, Workers& workers, Progress& progress);
// The same with other points; strays among them are held where they lie in a handle's reach.
DeformationTask generated_task(std::string_view name, const ShapeOptions& sampling, Workers& workers,
                               Progress& progress);

} // namespace knead
