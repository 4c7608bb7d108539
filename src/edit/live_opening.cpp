#include "edit/live_opening.h"

#include "base/error.h"
#include "edit/document_acts.h"
#include "edit/session_cloud.h"

namespace knead {

namespace {

Session restored_session(const std::filesystem::path& journal, std::string& remark) {
    bool dropped = false;
    Session session = recovered_session(journal, dropped);
    if (dropped)
        remark = "The recording breaks off in the middle of its last line, which is left out: what was being "
                 "written when knead ended is lost, and everything before it is here.";
    return session;
}

} // namespace

Session session_to_open(const OpenRequest& request, Progress& progress, std::string& remark) {
    if (request.restore) return restored_session(*request.restore, remark);
    if (is_session(request.file, progress)) return read_session(request.file);
    if (request.cloud)
        throw Error(Trouble::usage, request.file.string(),
                    "is no session, and only a session can be opened with another cloud");
    Session session;
    session.cloud = std::filesystem::absolute(request.file);
    session.settings = changed({}, request.settings);
    return session;
}

void refuse_changed_cloud(const std::filesystem::path& cloud, const std::filesystem::path& journal) {
    const std::optional<FileStamp> now = stamp_of(cloud), then = read_journal_facts(journal).cloud;
    if (now && then && *now != *then)
        throw Error(Trouble::input, cloud.string(),
                    "was written to after it was opened for what is to be restored now. Choose a copy of it "
                    "as it was then; or this very file, if its points are the same");
}

PointCloud cloud_to_open(const OpenRequest& request, Session& session, Progress& progress) {
    const bool is_plain = session.file.empty();
    PointCloud cloud =
        read_session_cloud(session, is_plain ? std::optional(request.file) : request.cloud, progress);
    if (request.cloud) {
        session.cloud = std::filesystem::absolute(*request.cloud);
        session.sha256.reset();
    }
    session.points = cloud.size();
    return cloud;
}

void replay_session(const Session& session, Document& document, LiveRecording& recording,
                    Progress& progress) {
    std::size_t done = 0;
    for (const SessionLine& line : session.lines) {
        progress.step("replaying the session",
                      static_cast<double>(done++) / static_cast<double>(session.lines.size()));
        const std::string place = session.place(line.number);
        if (std::holds_alternative<UndoLine>(line.action)) {
            document.undo(place);
            recording.step_back(false);
        } else if (std::holds_alternative<RedoLine>(line.action)) {
            document.redo(place);
            recording.step_forward(false);
        } else if (const auto* check = std::get_if<CheckLine>(&line.action)) {
            // wherever the journal lies
            recording.note(
                CheckLine{std::filesystem::absolute(session.resolve(check->positions)), check->tolerance});
        } else {
            auto coming = std::holds_alternative<SettleLine>(line.action)
                              ? recording.coming_to_last(line.action)
                              : recording.coming(line.action, false, document.handles());
            carry_out_act(document, line.action, place, progress);
            recording.add(std::move(coming));
        }
    }
}

} // namespace knead
