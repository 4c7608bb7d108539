#include "edit/session_cloud.h"

#include "base/error.h"
#include "io/cloud_file.h"
#include "io/digest.h"

namespace knead {

PointCloud read_named_cloud(const std::filesystem::path& path, const std::string& place,
                            const std::string& key, Progress& progress) {
    try {
        return read_cloud(path, progress);
    } catch (const Error& error) {
        throw Error(error.trouble(), place, key + ": " + error.what(), error.cure());
    }
}

PointCloud read_session_cloud(const Session& session, const std::optional<std::filesystem::path>& instead,
                              Progress& progress) {
    const std::filesystem::path path = instead ? *instead : session.resolve(session.cloud);
    std::error_code ignored;
    if (!instead && !std::filesystem::exists(path, ignored))
        throw Error(Trouble::input, session.place(session.header_line),
                    "\"cloud.path\": there is no file " + path.string(), Cure::give_cloud);
    PointCloud cloud =
        instead ? read_cloud(path, progress)
                : read_named_cloud(path, session.place(session.header_line), "\"cloud.path\"", progress);
    if (session.points && *session.points != cloud.size())
        throw Error(Trouble::input, session.place(session.header_line),
                    "\"cloud.points\": the session was recorded on a cloud of " +
                        std::to_string(*session.points) + " points, but " + path.string() + " has " +
                        std::to_string(cloud.size()));
    if (session.sha256 && !instead && *session.sha256 != sha256_of_file(path))
        throw Error(Trouble::input, session.place(session.header_line),
                    "\"cloud.sha256\": " + path.string() +
                        " is another file than the session was recorded on",
                    Cure::give_cloud);
    refuse_empty_cloud(cloud, path);
    return cloud;
}

void refuse_empty_cloud(const PointCloud& cloud, const std::filesystem::path& path) {
    if (bounds_of(cloud).finite_points == 0)
        throw Error(Trouble::input, path.string(),
                    "holds no point with finite coordinates, so there is nothing to edit");
}

} // namespace knead
