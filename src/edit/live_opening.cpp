#include "edit/live_opening.h"

namespace knead {

Session session_to_open(const OpenRequest& request, Progress& progress, std::string& remark) {
    if (request.restore) {
        bool dropped = false;
        Session session = recovered_session(*request.restore, dropped);
        if (dropped)
            remark =
                "The recording breaks off in the middle of its last line, which is left out: what was being "
                "written when knead ended is lost, and everything before it is here.";
        return session;
    }
    if (is_session(request.file, progress)) return read_session(request.file);
    Session session;
    session.cloud = std::filesystem::absolute(request.file);
    session.settings = changed({}, request.settings);
    return session;
}

void carry_out_act(Document& document, const SessionAction& action, const std::string& place,
                   Progress& progress) {
    if (const auto* line = std::get_if<HandleLine>(&action)) document.declare(*line, place);
    if (const auto* line = std::get_if<DragLine>(&action)) document.drag(*line, place, progress);
    if (const auto* line = std::get_if<SettleLine>(&action)) document.settle(*line, progress);
    if (std::holds_alternative<CommitLine>(action)) document.commit(progress);
    if (const auto* line = std::get_if<SetLine>(&action)) document.change_settings(line->change, place);
    if (const auto* line = std::get_if<DeleteLine>(&action)) document.remove(*line, place);
    if (const auto* line = std::get_if<RenameLine>(&action)) document.rename(*line, place);
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
            recording.step_forward();
        } else if (const auto* check = std::get_if<CheckLine>(&line.action)) {
            recording.note(CheckLine{session.resolve(check->positions), check->tolerance});
        } else {
            carry_out_act(document, line.action, place, progress);
            if (std::holds_alternative<SettleLine>(line.action))
                recording.add_to_last(line.action);
            else
                recording.add(line.action, false);
        }
    }
}

} // namespace knead
