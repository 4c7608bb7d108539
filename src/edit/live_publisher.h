#pragma once
// What a live document tells the window. Private to this room.

#include "edit/live_recording.h"
#include "edit/live_shared.h"

namespace knead {

class LivePublisher {
public:
    LivePublisher(Locked<LiveShared>& shared, Workers& workers) : shared_(shared), workers_(workers) {}

    void say(Notice::Kind kind, const std::string& words, Notice::About about = Notice::About::itself);
    void refuse(LiveDocument::Refused refused);

    // The newest points. `pose_set`: of a drag, when the hand set the pose that they show.
    struct FrameFacts {
        std::optional<std::chrono::steady_clock::time_point> pose_set;
        double solve = 0, upsample = 0; // seconds
    };
    void shape(std::shared_ptr<const RestShape> shape, const Pipeline& pipeline, const FrameFacts& facts);
    // The same, for whoever draws to move them.
    void drawn(std::shared_ptr<const DeviceFrame> frame, const FrameFacts& facts);
    std::uint64_t shapes() const { return frames_; } // so many: the version of the last one
    bool last_is_drawn() const { return last_is_drawn_; }

    // The document between two acts.
    struct ViewFacts {
        bool moving = false; // a drag goes on, or what it left still settles
        StepNumber last_step = 0;
        std::string device;
        std::filesystem::path session;
        LiveDocument::Saved saved;
        bool chooses_samples = false;
        SampleChoice suited;
    };
    void view(const Document& document, const LiveRecording& recording, const ViewFacts& facts);

    // Parts that follow no handle, and handles that ask for too much: said once for every change, and taken
    // back where it is no longer so.
    void strays(const Pipeline::LooseParts& strays);
    void demand(const HandleDemand& demand);
    // And a handle that is dragged and has no points left to move.
    void swallowed(const Document& document, const DragLine& drag);
    // And one of a part that nothing holds back.
    void loose(const Document& document, const DragLine& drag);

private:
    void note_changes(const RestShape& shape, const Pipeline& pipeline);
    static void note_facts(PosedFrame& frame, const FrameFacts& facts);
    void note_samples(const Pipeline& pipeline);
    void note_graph(const Pipeline& pipeline);
    void tell(Notice::Kind kind, Notice::About about, std::string words, std::string& told);

    Locked<LiveShared>& shared_;
    Workers& workers_;
    PosedFrame next_; // to hand over; what is handed over in turn is of frames before
    std::uint64_t frames_ = 0;
    std::vector<std::uint64_t> changed_in_; // of each block of points, the frame
    // Which of the pipeline's the last frame shows; 0: it shows another shape.
    std::uint64_t shown_upsampling_ = 0;
    bool last_is_drawn_ = false;
    std::string told_of_strays_, told_of_demand_, told_of_swallowed_, told_of_loose_;
    // Copies for the window, which may look at them while the pipeline makes others.
    std::uint64_t samples_seen_ = 0;
    std::shared_ptr<const std::vector<Index>> sample_vertices_;
    std::shared_ptr<const Graph> sample_graph_;
    std::shared_ptr<const Graph> graph_seen_;
    std::shared_ptr<const std::vector<float>> spacings_;
    std::shared_ptr<const std::vector<std::uint8_t>> outliers_;
};

} // namespace knead
