#pragma once
// How a live document begins: the session that it opens or makes, and the acts that are in it already.
// Private to this room.

#include "edit/document.h"
#include "edit/live_recording.h"
#include "edit/live_shared.h"

namespace knead {

// The session of the request's file, or of its journal; for a plain cloud a new one without a file of its
// own. `remark` becomes what the user should hear about a journal. Throws Error (input).
Session session_to_open(const OpenRequest& request, Progress& progress, std::string& remark);

// The cloud of that session, which learns what it is: where another was asked for, that one. Throws Error
// (input).
PointCloud cloud_to_open(const OpenRequest& request, Session& session, Progress& progress);

// Throws Error (input) where the file of the cloud is not the one any more that was edited, as far as is
// known of what that journal recorded.
void refuse_changed_cloud(const std::filesystem::path& cloud, const std::filesystem::path& journal);

// Carries out and records all lines of the session. A settling is undone together with the act before it.
void replay_session(const Session& session, Document& document, LiveRecording& recording, Progress& progress);

} // namespace knead
