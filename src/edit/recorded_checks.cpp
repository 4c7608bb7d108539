#include "edit/recorded_checks.h"

#include "base/error.h"
#include "io/cloud_file.h"

#include <algorithm>
#include <limits>

namespace knead {

namespace {

// Of a check that is recorded for the first time, in D: what two machines differ by, and a lot more.
constexpr double usual_tolerance = 1e-4;

// Whether name_of_check() makes such names.
bool is_name_of_check(const Session& session, const std::filesystem::path& name) {
    const std::string stem = name.stem().string(), begin = session.file.stem().string() + "-check-";
    return name.extension() == ".ply" && stem.starts_with(begin) && stem.size() > begin.size() &&
           std::ranges::all_of(stem.substr(begin.size()), [](char c) { return c >= '0' && c <= '9'; });
}

// The session's check with this cloud; null: it has none.
const CheckLine* check_of(const Session& session, const std::filesystem::path& file) {
    for (const SessionLine& line : session.lines)
        if (const auto* check = std::get_if<CheckLine>(&line.action); check && check->positions == file)
            return check;
    return nullptr;
}

// The session would be written where the link leads, and its checks could be found from one of them only.
void refuse_link_from_elsewhere(const Session& session) {
    std::error_code trouble, ignored;
    const std::filesystem::path file = std::filesystem::canonical(session.file, trouble);
    if (!trouble && !std::filesystem::equivalent(file.parent_path(), folder_of(session), ignored))
        throw Error(Trouble::output, session.file.string(),
                    "is a link into another folder; record the checks of " + file.string() + " itself");
}

void refuse_cloud_among_checks(const Session& session, const std::filesystem::path& cloud) {
    std::error_code trouble, ignored;
    std::filesystem::directory_iterator entry(folder_of(session), trouble), end;
    for (; !trouble && entry != end; entry.increment(trouble))
        if (is_name_of_check(session, entry->path().filename()) &&
            std::filesystem::equivalent(entry->path(), cloud, ignored))
            throw Error(Trouble::output, entry->path().string(),
                        "is the cloud that the session begins with, and has a name that recorded checks "
                        "take; give the cloud another one");
}

void refuse_shape_among_checks(const Session& session, const std::filesystem::path& out) {
    if (!is_name_of_check(session, out.filename())) return;
    std::error_code ignored;
    const std::filesystem::path folder = out.parent_path();
    if (std::filesystem::equivalent(folder.empty() ? "." : folder, folder_of(session), ignored))
        throw Error(Trouble::output, out.string(),
                    "has a name that recorded checks take; give the shape another one");
}

} // namespace

std::filesystem::path name_of_check(const Session& session, std::size_t number) {
    return session.file.stem().string() + "-check-" + std::to_string(number) + ".ply";
}

bool is_recorded(const Session& session, const CheckLine& check) {
    return check.positions.parent_path().empty() && is_name_of_check(session, check.positions);
}

std::filesystem::path folder_of(const Session& session) {
    const std::filesystem::path folder = session.file.parent_path();
    return folder.empty() ? "." : folder;
}

void refuse_to_record(const Session& session, const std::filesystem::path& cloud,
                      const std::optional<std::filesystem::path>& out) {
    refuse_link_from_elsewhere(session);
    const TemporaryFolder checks(folder_of(session)); // throws where nothing can be written
    const FileInTheMaking rewritten(session.file);
    refuse_cloud_among_checks(session, cloud);
    if (out) refuse_shape_among_checks(session, *out);
}

void refuse_to_replace_others(const Session& session, std::span<const RecordedCheck> recorded) {
    for (const RecordedCheck& check : recorded) {
        const std::filesystem::path target = session.resolve(check.file);
        std::error_code ignored;
        if (!check_of(session, check.file) && std::filesystem::exists(target, ignored))
            throw Error(Trouble::output, target.string(),
                        "is there already and no check of this session has it; to record one there, "
                        "move the file away first");
    }
}

void write_checks(std::span<const RecordedCheck> recorded, const PointCloud& cloud,
                  const std::filesystem::path& folder, Progress& progress) {
    // Only positions are ever read from them, which every format holds.
    for (const RecordedCheck& check : recorded)
        (void)write_cloud(folder / check.file, cloud, {check.positions, check.normals}, progress);
}

void write_session(const Session& session, std::span<const RecordedCheck> recorded, FileInTheMaking& file) {
    file.write(session.header_text + "\n");
    auto next = recorded.begin();
    const auto put_checks_up_to = [&](std::size_t line) {
        for (; next != recorded.end() && next->after_line <= line; ++next) {
            const CheckLine* const before = check_of(session, next->file);
            file.write(to_text(CheckLine{next->file, before ? before->tolerance : usual_tolerance}) + "\n");
        }
    };
    put_checks_up_to(1);
    for (const SessionLine& line : session.lines) {
        put_checks_up_to(line.number - 1);
        const auto* check = std::get_if<CheckLine>(&line.action);
        if (!check || !is_recorded(session, *check)) file.write(line.text + "\n");
    }
    put_checks_up_to(std::numeric_limits<std::size_t>::max());
}

} // namespace knead
