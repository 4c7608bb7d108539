#pragma once
// What the window's thread and the document's thread of a LiveDocument both see. Private to this room.

#include "edit/live_document.h"

#include <list>
#include <variant>

namespace knead {

// A pose that the hand set.
struct WantedPose {
    Transform transform;
    std::chrono::steady_clock::time_point set;
};

namespace task {
struct ChooseSamples {
    bool by_itself = false;
};
struct Lines {
    StepNumber step = 0;
    std::vector<SessionAction> lines;
    bool joins_last = false;
};
struct EditHandle {
    StepNumber step = 0;
    HandleEdit edit;
};
struct PutPivots {
    StepNumber step = 0;
    std::vector<PivotPlace> places;
};
struct MakePosed {
    StepNumber step = 0;
    HandleLine line;
    PoseOfAnother pose;
};
struct BeginDrag {
    StepNumber step = 0;
    std::string handle;
    Vec3d pivot = Vec3d::Zero();
    std::vector<Companion> with = {};
};
struct EndDrag {
    std::optional<WantedPose> last; // not followed yet
};
struct CancelDrag {};
struct ResetPoses {
    StepNumber step = 0;
    std::vector<std::string> handles;
};
struct Undo {
    StepNumber step = 0;
    bool to_look = false;
};
struct Redo {
    StepNumber step = 0;
    bool to_look = false;
};
struct Play {
    StepNumber step = 0;
};
struct SaveCloud {
    std::filesystem::path target;
    ExportOptions options = {};
    bool anyway = false;
    bool keeps_original = false;
    std::vector<std::uint8_t> hidden = {}; // as LiveDocument::save_cloud() has it
};
struct SaveSession {
    std::filesystem::path target;
    bool anyway = false;
};
} // namespace task
using LiveTask =
    std::variant<task::ChooseSamples, task::Lines, task::EditHandle, task::PutPivots, task::MakePosed,
                 task::BeginDrag, task::EndDrag, task::CancelDrag, task::ResetPoses, task::Undo, task::Redo,
                 task::Play, task::SaveCloud, task::SaveSession>;

// How a step is played.
struct PlayPace {
    double speed = 1; // of the 30 frames a second
    bool held = false;
    int frames = 0; // to go on, or back, though it is held
};

struct LiveShared {
    // To the document.
    std::list<LiveTask> inbox;        // a list: what is taken from it, or put off, needs no memory
    std::optional<WantedPose> wanted; // the newest pose of the drag that was begun last
    PlayPace pace;
    std::size_t saves = 0;        // that were asked for and are not done with
    std::size_t undos = 0;        // likewise, and redos; without those to look
    bool draws_on_device = false; // whoever draws can, and needs no positions in a drag
    bool stop = false;
    bool keep_journal = true;

    // From it.
    LiveDocument::Status status;
    OpenedCloud opened;
    std::shared_ptr<const DocumentView> view;
    PosedFrame frame;
    PosedFrame drawn; // without points, if it is newer than `frame`
    std::vector<Notice> notices;
    bool lacked_memory = false; // even for words about it
    std::vector<LiveDocument::Refused> refused;
    std::vector<HeldSave> held_saves;
    LiveDocument::Saved saved;
};

// How many such tasks were asked for and are not done with, where somebody wants to know; null: nobody does.
std::size_t LiveShared::*count_of(const LiveTask& task);

// Tells the user of the exception that is being handled.
void tell_of_exception(Locked<LiveShared>& shared) noexcept;

// The document's thread from its first to its last moment.
void run_live_document(OpenRequest request, Locked<LiveShared>& shared) noexcept;

} // namespace knead
