#pragma once
// Checks that a replay records (`--record-checks`): the shape at the end of each edit, in a cloud beside the
// session, and a line of the session that asks for it. Private to this room.

#include "base/progress.h"
#include "base/temporary_folder.h"
#include "base/whole_file.h"
#include "cloud/point_cloud.h"
#include "edit/session.h"

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace knead {

struct RecordedCheck {
    std::size_t after_line = 0; // of the session; 0: behind the header
    std::filesystem::path file; // beside the session
    std::vector<float> positions;
    std::vector<float> normals;
};

// The name of the check with this number, 1 …: "wave-check-1.ply" of wave.knead.
std::filesystem::path name_of_check(const Session& session, std::size_t number);
// Whether a check's cloud is one that recording would write anew: beside the session, under such a name.
bool is_recorded(const Session& session, const CheckLine& check);

std::filesystem::path folder_of(const Session& session);

// Throws Error (output), before the work is done, where recording would write over what is none of its own:
// the session is a link from another folder, or `cloud`, that it begins with, or `out`, where the shape is to
// be written, has the name of a check.
void refuse_to_record(const Session& session, const std::filesystem::path& cloud,
                      const std::optional<std::filesystem::path>& out);
// The same where a check of this name is there and not of this session: another one may have recorded it.
// Only when all are made is it known how many there are.
void refuse_to_replace_others(const Session& session, std::span<const RecordedCheck> recorded);

// Writes the clouds of the checks into a folder.
void write_checks(std::span<const RecordedCheck> recorded, const PointCloud& cloud,
                  const std::filesystem::path& folder, Progress& progress);
// Writes the session as it was, line for line, with these checks in the place of those that were recorded
// before. A check whose name was there keeps its tolerance.
void write_session(const Session& session, std::span<const RecordedCheck> recorded, FileInTheMaking& file);

} // namespace knead
