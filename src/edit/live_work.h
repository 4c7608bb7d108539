#pragma once
// The document's thread: takes tasks one after the other, follows the newest pose, and lets a pose that rests
// converge. Private to this room.

#include "base/error.h"
#include "base/stopwatch.h"
#include "edit/cloud_digest.h"
#include "edit/cures.h"
#include "edit/known_files.h"
#include "edit/live_drag.h"
#include "edit/live_publisher.h"
#include "edit/live_recording.h"
#include "edit/live_shared.h"
#include "edit/open_files.h"

#include <functional>
#include <new>
#include <set>
#include <span>

namespace knead {

class LiveWork {
public:
    LiveWork(OpenRequest request, Locked<LiveShared>& shared);

    void open();
    bool turn(); // one turn of the loop; false when it is time to stop; what goes wrong in it is told
    void end();

private:
    // --- The loop (live_work.cpp) ---

    PointCloud read_cloud_of(Session& session);
    void belong_to_session_of(const JournalFacts& facts);
    void take_settings();
    std::vector<std::vector<Document::PivotMove>> pivot_moves_of_steps() const;
    void publish_opened();
    void wait_for_next_frame();
    bool something_to_do() const;
    void go_on();
    void take_turn(std::list<LiveTask>& task);
    void rest_if_idle();
    void tell_what_is_open();
    bool look_for_others(const std::filesystem::path& file);
    void look_for_others();
    template<typename Do>
    void guarded(Do&& work);

    // --- Acts (live_acts.cpp) ---

    void carry_out(task::Lines& lines);
    struct StepSoFar {
        std::size_t done = 0; // acts
        bool told_of_commit = false;
    };
    void carry_out_line(const SessionAction& line, bool joins, bool pose_is_seen, StepSoFar& step);
    void carry_out_made(StepNumber step, const std::function<std::vector<SessionAction>()>& make);
    void carry_out(task::EditHandle& task);
    HandleEdit edit_for(const PivotPlace& pivot) const;
    void carry_out(task::PutPivots& task);
    void carry_out(task::MakePosed& task);
    std::vector<SessionAction> ways_back(const std::vector<std::string>& handles);
    void carry_out(task::ResetPoses& task);
    void carry_out(task::Undo& task);
    void carry_out(task::Redo& task);
    void carry_out(task::SaveCloud& task);
    std::vector<std::uint8_t> left_out_of(const task::SaveCloud& task) const;
    std::string words_about_left_out(std::span<const std::uint8_t> left_out) const;
    std::vector<std::string> write(const task::SaveCloud& task, std::span<const std::uint8_t> left_out);
    std::filesystem::path copy_original();
    void go_by_copy(const std::filesystem::path& copy);
    void carry_out(task::SaveSession& task);
    bool hold_back(HeldSave save);
    void begin_digest();
    void note_digest();
    template<typename Record>
    void record(Record&& write);
    void tell_of_journal() noexcept;
    void carry_out_and_record(const SessionAction& line, bool joins);
    void take_back_act(bool to_look);
    void take_back_step(bool to_look);
    void redo_act(bool to_look);
    void show_where_it_rests();
    std::vector<float> in_file_order(std::span<const float> ordered, float left_out);
    std::vector<float> displacement_column();
    std::vector<float> stretch_column();

    // --- Drags and what converges afterwards (live_following.cpp) ---

    bool moves(const std::string& handle) const;
    void carry_out(task::BeginDrag& task);
    void carry_out(task::EndDrag& task);
    void carry_out(task::CancelDrag& task);
    void take_wanted(WantedPose wanted);
    bool is_too_slow() const;
    void follow();
    void take_drag();
    void finish_drag();
    void drop_drag();
    void settle();
    unsigned iterations_a_picture() const;
    void come_to_rest();
    void stop_settling();
    void finish_settling();

    // --- The number of samples (live_samples.cpp) ---

    void carry_out(task::ChooseSamples& task);
    SampleNeeds sample_needs() const;
    void choose_samples();
    void look_at_handles();
    void measure_frame();
    SampleChoice suited_samples() const;
    struct MeasuredCost {
        FrameCost cost;
        unsigned iterations = 0; // that the frames had
    };
    static FrameCost at_iterations(const MeasuredCost& measured, unsigned iterations);
    void learn(const MeasuredCost& learned);
    void learn_cost(std::vector<double> solving, std::vector<double> upsampling);

    // --- Playing (live_playing.cpp) ---

    void carry_out(task::Play& task);
    bool plays_on(const LiveShared& shared) const;
    double seconds_to_next_picture(const LiveShared& shared) const;
    void play_on();
    void play_frames(int frames);
    void play_settling(int frames);
    void finish_playing_act();
    void finish_playing();
    std::optional<LiveDocument::Status::Playing> what_plays(const LiveShared& shared) const;

    // --- Telling the window (live_work.cpp) ---

    void show_document();
    LivePublisher::FrameFacts facts_of_frame(bool of_drag) const;
    void publish_shape(bool of_drag);
    void publish_drag();
    void show_what_was_drawn();
    void publish_view();
    void refuse(StepNumber step, bool ends_redo = false);
    void say(Notice::Kind kind, const std::string& words) { publisher_.say(kind, words); }

    OpenRequest request_;
    Locked<LiveShared>& shared_;
    LiveProgress progress_;
    Workers workers_;
    LivePublisher publisher_;
    std::unique_ptr<Upsampler> upsampler_;
    std::unique_ptr<Document> document_;
    std::unique_ptr<LiveRecording> recording_;
    std::optional<LiveDrag> drag_;
    std::list<LiveTask> after_drag_; // what came while a drag went on
    std::optional<LivePlay> play_;
    StepNumber last_step_ = 0;
    std::set<StepNumber> refused_;
    bool ahead_ = true; // stages could be prepared before they are needed
    bool told_of_journal_ = false;
    Stopwatch since_frame_;
    double solve_seconds_ = 0;

    // A released pose that comes to rest.
    struct {
        bool wanted = false;
        bool begun = false; // in the document
        unsigned iterations = 0;
    } settling_;

    // The number of samples.
    struct {
        bool by_itself = false;
        bool is_due = false;                  // since the last act
        HandleSpread spread;                  // of the handles as they were prepared last
        std::optional<MeasuredCost> newest;   // what the machine did last; nothing: it was not measured yet
        std::optional<MeasuredCost> measured; // what it can, when nothing else is to be done
        unsigned slower_drags = 0;            // since then, one after the other
        std::optional<MeasuredCost> slower;   // the fastest of them
    } choice_;

    struct {
        LiveDocument::Saved saved;
        std::filesystem::path session;
        std::optional<FileStamp> cloud_stamp; // before it was read
        std::optional<CloudDigest> digest;    // begun when it was opened, unless its session knew it
        KnownFiles known;
    } files_;

    // Who else has these files open.
    struct {
        std::optional<OpenFiles> open_files;
        std::set<std::string> told; // in these words
        Stopwatch since_look;
    } others_;
};

// The act is done; that its line cannot be written is said, once, and changes nothing.
template<typename Record>
void LiveWork::record(Record&& write) {
    try {
        std::forward<Record>(write)();
        told_of_journal_ = false;
    } catch (const Error&) {
        tell_of_journal();
    } catch (const std::bad_alloc&) {
        tell_of_journal();
    }
}

} // namespace knead
