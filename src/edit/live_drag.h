#pragma once
// A drag as the document's thread follows it. Private to this room.

#include "edit/live_shared.h"

namespace knead {

struct LiveDrag {
    StepNumber step = 0;
    std::string handle;
    Vec3d pivot = Vec3d::Zero();           // in the file's coordinates
    HandleMotion base;                     // the pose when it began
    Vec3d origin = Vec3d::Zero();          // the cloud's
    std::vector<Companion> with = {};      // others that go along
    std::optional<WantedPose> wanted = {}; // the newest pose of the hand
    Transform shown = {};                  // how far it was followed
    std::size_t frames = 0;                // computed so far
    bool is_coarse = false;                // the newest of them shows what few samples answered
    std::size_t repeats = 0;               // frames since the last new pose
    bool rests = true;                     // nothing changes until the hand moves
    std::vector<double> solving = {};      // seconds of every frame but the coarse ones
    std::vector<double> upsampling = {};   // seconds of every frame

    // Whether frames only repeat a pose, and the shape converges.
    bool repeats_pose() const { return wanted && shown == wanted->transform; }
};

// A step that is done again while it is looked at.
struct LivePlay {
    bool begun = false;    // its present act, in the document
    std::size_t frame = 0; // of the present act: shown so far
    double due = 0;        // the part of a frame that is left over from the last picture
};

// Tells the window how far a long stage is, and stops it when the window closes.
class LiveProgress final : public Progress {
public:
    explicit LiveProgress(Locked<LiveShared>& shared) : shared_(shared) {}
    void report(std::string_view stage, double fraction) override;
    bool cancelled() const override;

private:
    Locked<LiveShared>& shared_;
};

} // namespace knead
