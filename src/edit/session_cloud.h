#pragma once
// The cloud that a session is about.

#include "base/progress.h"
#include "cloud/point_cloud.h"
#include "edit/session.h"

namespace knead {

// Reads the cloud of the session's header, or `instead` where that is given (relative to the working folder),
// and checks that it is the one that the session was recorded on: as many points, and the same digest unless
// it is given `instead`. Throws Error (input) with the session's file and line; also for a cloud without a
// finite point.
PointCloud read_session_cloud(const Session& session, const std::optional<std::filesystem::path>& instead,
                              Progress& progress);

// A cloud file that a line of the session names; an error says where and by which key.
PointCloud read_named_cloud(const std::filesystem::path& path, const std::string& place,
                            const std::string& key, Progress& progress);

// Throws Error (input) for a cloud in which there is nothing to edit.
void refuse_empty_cloud(const PointCloud& cloud, const std::filesystem::path& path);

} // namespace knead
