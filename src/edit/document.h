#pragma once
// A cloud being edited: its handles, settings, poses and history, changed by the actions of a session.
//
// The replay and the editor both work on a Document; an action is carried out whole or refused with an Error,
// which leaves the document as it was.

#include "edit/pipeline.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace knead {

// Where handles have their joints, by their names; in whose coordinates says who has them.
using Pivots = std::map<std::string, Vec3d>;

// What the frames of a document cost, for whoever wants to know; times in seconds.
struct FrameLog {
    std::vector<double> iteration; // one entry an iteration of all samples
    std::vector<double> upsample;  // one entry a frame, and one more where its points came later
    std::size_t frames = 0;        // of drags
};

class Document {
public:
    // `cloud` must have a finite point. `workers` and `upsampler` must outlive the document. A rehearsal
    // checks every act but computes no shape: everything stays where it was opened, and regions are not
    // resolved once a pose would have been committed.
    enum class Mode { real, rehearsal };
    Document(PointCloud cloud, const Settings& settings, Workers& workers, Upsampler& upsampler,
             Mode mode = Mode::real);
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    const PointCloud& cloud() const { return cloud_; }
    const Bounds& bounds() const { return bounds_; } // of the shape as opened; its diagonal is D
    const Pipeline& pipeline() const { return pipeline_; }
    const Settings& settings() const { return now().settings; }
    const std::vector<Handle>& handles() const { return handles_; }
    const FrameLog& log() const { return log_; }

    // Whether handles were dragged since the last commit.
    bool is_posed() const { return now().posed != nullptr; }

    // Called after every frame of drag(), when the points of that frame are pipeline().posed(): for pictures
    // of a sequence. May be empty.
    std::function<void()> on_frame;

    // Runs the stages that need no handles, and all of them where there are some, so that the first drag
    // begins at once.
    void prepare_ahead(Progress& progress);

    // For who keeps shapes while the next ones are made (keep_shown()): after prepare_ahead(), and when a
    // drag has begun, it takes the memory for them, which a frame would have to, else.
    void make_spare_shapes() { pipeline_.make_spare_shapes(); }

    // Whether this act would be refused now since handles are posed, and for nothing else that is known: a
    // commit has to come before it.
    bool needs_commit(const SessionAction& act) const;

    // Whether there is this very handle, whatever was declared after it. Not of lines with a region.
    bool has(const HandleLine& line) const;

    // --- The acts; `place` names the line in errors ---

    void declare(const HandleLine& line, const std::string& place);
    void drag(const DragLine& line, const std::string& place, Progress& progress);
    void settle(const SettleLine& line, Progress& progress);
    void commit(Progress& progress);
    void change_settings(const SettingsChange& change, const std::string& place);
    void remove(const DeleteLine& line, const std::string& place);
    void rename(const RenameLine& line, const std::string& place);
    void undo(const std::string& place);
    void redo(const std::string& place);

    // What redo() would do again where that is a drag, or a settling; null, or nothing, where it is not.
    const DragLine* redoable_drag() const;
    std::optional<SettleLine> redoable_settling() const;

    // --- A drag or a settling that is looked at while it goes on ---
    //
    // begin, any number of frames, end: the document is then exactly as after drag() or settle() of those
    // frames. Until the end nothing of it is history, and no other act may come in between. An end that
    // throws forgets what was begun, as abandon() does.

    // `with`: as DragLine has it.
    void begin_drag(const std::string& handle, const Vec3d& pivot, const std::string& place,
                    Progress& progress, const std::vector<Companion>& with = {});
    // One frame: the handle's whole pose in this edit. Returns the longest way that a sample went in the last
    // iteration, over the cloud's size. An absurd pose is refused, and the drag stays as it was.
    // `later` leaves moving the points to whoever draws, where the upsampler can (upsample/drawing.h): then
    // the frame is drawn_frame(), and its points are made when somebody asks for shown().
    enum class Points { now, later };
    double drag_frame(const HandlePose& pose, const std::string& place, Progress& progress,
                      Points points = Points::now);
    // The last frame of the drag, where its points were left for later; else null.
    const std::shared_ptr<const DeviceFrame>& drawn_frame() const { return drawn_frame_; }
    DragLine end_drag(); // the line that does the same; one without frames did nothing

    void begin_settling(Progress& progress);
    // Up to so many iterations more, and one upsampling. Returns whether the samples have come to rest.
    bool settle_some(unsigned iterations, Progress& progress);
    SettleLine end_settling(); // the line that does the same

    // Forgets what was begun; nothing happens where nothing was.
    void abandon() noexcept;

    // --- The shape now ---

    // In the order of computation (pipeline().order()), good until the next act.
    const RestShape& shape(Progress& progress);
    // The same, but in the middle of a drag or a settling what its last frame made.
    const RestShape& shown(Progress& progress);
    // That, which stays as it is for as long as somebody has it, in whatever thread.
    std::shared_ptr<const RestShape> keep_shown(Progress& progress);
    // Of each handle in this edit, as it was at the last finished act.
    const std::vector<HandleMotion>& motions() const { return motions_; }
    // Every pose that a handle was given in this edit, the first one first.
    std::vector<HandleMotion> way_of(const std::string& handle) const;

    // --- Where handles have their joints, relative to the cloud's origin (document_pivots.cpp) ---

    // What an act did to where the joints are that lines told of (HandleLine::pivot).
    struct PivotMove {
        std::string handle;
        std::optional<Vec3d> before, after; // nothing: its middle
    };
    // Of every act, those that can be redone included.
    std::vector<std::vector<PivotMove>> pivot_moves() const;
    // Of all handles that were ever dragged and of whose joints no line tells, by the names that they had
    // then: where the pivot of the last drag is by now, which that took along.
    Pivots last_pivots() const;
    // The handles as a commit would leave them: their pivots go where they are taken.
    std::vector<Handle> handles_committed() const;

    // --- What history costs ---
    //
    // It costs what the acts brought, poses and handles as their lines have them, and not points: of
    // committed shapes and of the samples' states only some are kept, near the present more than far from it,
    // and another is made again, on the same device to the bit, from what is kept and the poses that were
    // recorded.

    struct Memory {
        std::size_t shapes = 4;
        std::size_t samples = 4;                           // states of them, at least
        std::size_t sample_bytes = std::size_t{256} << 20; // more of them only as long as they take no more
    };
    void keep_at_most(const Memory& memory) { memory_ = memory; }
    // The shape that this edit began with, where it is another than the opened one and is still kept.
    std::shared_ptr<const RestShape> kept_rest() const;
    std::size_t kept_bytes() const; // of those shapes and states

    // Of what is shown: 3n floats in the order of the file, relative to cloud().origin; and normals, empty
    // without.
    std::vector<float> positions(Progress& progress);
    std::vector<float> normals(Progress& progress);
    // How each point turned since the cloud was opened: 4n floats in the order of the file, w x y z, unit
    // quaternions; empty unless the cloud holds splats (cloud/splats.h), and where nothing was ever moved.
    std::vector<float> rotations(Progress& progress);

    // Whether the handles ask for more than the shape can give; nothing when nothing is posed.
    HandleDemand demand(Progress& progress);

    // The largest distance of a handle's point from where its handle sends it, over D; 0 when nothing is
    // posed.
    double handle_error(Progress& progress);

private:
    // A committed shape.
    struct Committed {
        std::shared_ptr<const RestShape> shape; // null: dropped
        std::size_t made_from = 0;              // in history_: the posed state that was committed
    };

    // A handle, and where it is.
    struct Moved {
        Index handle = 0;
        HandleMotion motion = {};
    };

    // The samples after a drag or a settling.
    struct Posed {
        std::shared_ptr<const SampleState> samples;  // null: dropped
        std::size_t made_from = 0;                   // in history_: the state before the act
        std::variant<DragLine, SettleLine> act = {}; // that made it
        std::vector<Moved> moved = {}; // by a drag: where it brought its handle, and those that went along
    };

    // Everything that undo takes back, shared between states where it is large. Of the handles and their
    // motions, of which there may be thousands, it has what changed since the state before.
    struct State {
        Settings settings;
        std::shared_ptr<const HandleChange> change; // of the handles; null: none
        std::shared_ptr<Committed> rest;            // null: as opened
        std::shared_ptr<Posed> posed;               // null: nothing was dragged in this edit
        std::shared_ptr<const Pivots> pivots;       // at rest, as Handle::pivot; null: no line told of any
    };

    // What a frame of a drag needs to know of those before it, or an iteration of settling.
    struct FrameMemory {
        bool logs = true; // false for frames that are computed a second time
        Acceleration acceleration = {};
        CoarseFollowing following = {};
    };

    // What begin_drag() and begin_settling() began.
    struct UnderWay {
        State after; // it
        std::vector<HandleMotion> motions;
        SampleState samples, samples_before = {}; // the latter: before the frame that is being computed
        std::vector<Moved> from = {}; // what the drag moves, where it was when that began; none: settling
        std::vector<Moved> before = {}, next = {}; // and before and after the frame that is being computed
        DragLine line = {};                        // its frames so far
        SampleState coarse_before = {};            // likewise, of memory.following
        unsigned iterations = 0;                   // of settling
        FrameMemory memory = {};
        bool is_shown = false; // whether the pipeline's posed points are those of `samples`
    };

    bool is_as_opened() const;
    Index find_handle(const std::string& name, const std::string& place, const char* key = "handle") const;
    // The handle of this name, where it holds what the line says and as it says.
    std::optional<Index> held_as_in(const HandleLine& line, const std::string& place) const;
    // The handle that this line gives another colour or pivot and changes in nothing else; nothing: it does
    // more.
    std::optional<Index> retouched_by(const HandleLine& line, const std::string& place) const;
    void refuse_while_posed(const std::string& what, const std::string& place) const;
    State next_state() const; // for an act to change
    void take(State next);    // makes it the present one, and the present one the last in history
    void arrive_at(const State& next);
    static void take_motions_of(const State& state, std::size_t handles, std::vector<HandleMotion>& motions);
    void change_handles(HandleChange change, std::shared_ptr<const Pivots> pivots);
    void show_pivots(const State& before, const State& now) noexcept;
    void move_pivots(const Posed& posed, std::vector<HandleMotion>& motions, Pivots& pivots) const;
    // As they were in a state of the past, or are in the present one.
    std::vector<Handle> handles_of(std::size_t at) const;
    std::vector<HandleMotion> motions_of(std::size_t at) const;
    void prepare_for(std::size_t at, Progress& progress);
    void prepare(Progress& progress);
    Index movable_handle(const std::string& name, const char* key, const std::string& place) const;
    double iterate_once(const std::vector<HandleMotion>& motions, SampleState& samples, FrameMemory& memory);
    std::vector<Moved> moved_by(const DragLine& line, std::span<const HandleMotion> motions,
                                const std::string& place) const;
    void move(const DragLine& drag, const HandlePose& pose, std::span<const Moved> from,
              std::span<const HandleMotion> now, std::vector<Moved>& next) const;
    double follow(std::span<const Moved> next, bool coarse, unsigned iterations,
                  std::vector<HandleMotion>& motions, SampleState& samples, FrameMemory& memory,
                  Progress& progress);
    void upsample(const std::vector<HandleMotion>& motions, const SampleState& state);
    void show(UnderWay& act);
    bool make_frame(const UnderWay& drag);
    // From any state in history; made again where it was dropped.
    std::shared_ptr<const RestShape> rest_of(const State& state, Progress& progress);
    std::shared_ptr<const SampleState> samples_of(const State& state, Progress& progress); // of a posed one
    std::shared_ptr<const RestShape> posed_now(Progress& progress); // where something is posed
    // The pipeline's posed points, which are those of these motions, as a shape to keep.
    std::shared_ptr<const RestShape> posed_shape(const std::vector<HandleMotion>& motions,
                                                 const SampleState& samples);
    void repeat(const Posed& posed, SampleState& samples, Progress& progress);
    const State& now() const { return history_[at_]; }
    void end(UnderWay act, std::variant<DragLine, SettleLine> line);
    void keep(const std::shared_ptr<Committed>& committed) noexcept;
    void keep(const std::shared_ptr<Posed>& posed) noexcept;
    std::vector<Index> resolve(const HandleLine& line, const std::string& place);

    Mode mode_;
    PointCloud cloud_;
    Bounds bounds_;
    bool holds_splats_;
    Workers& workers_;
    Pipeline pipeline_;
    std::vector<State> history_;        // from the cloud as it was opened to what can be redone
    std::size_t at_ = 0;                // the present one
    std::vector<Handle> handles_;       // of the present one
    std::vector<HandleMotion> motions_; // one a handle, in this edit
    Memory memory_;
    std::vector<std::shared_ptr<Committed>> kept_shapes_; // those with a shape, the oldest first
    std::vector<std::shared_ptr<Posed>> kept_samples_;    // and with samples
    std::optional<UnderWay> under_way_;
    bool posed_is_now_ = false; // whether the pipeline's posed points are the present ones
    std::shared_ptr<const DeviceFrame> drawn_frame_;
    FrameLog log_;
};

// That this handle moves nothing, as handles that were declared later hold all of its points; "" where it
// does. After an act that prepared it: a drag.
std::string words_about_swallowed(const Document& document, const std::string& handle);
// That nothing stays of the part of the cloud which this handle moves, though there is what stays elsewhere;
// "" where that is not so. After the same.
std::string words_about_loose(const Document& document, const std::string& handle);

} // namespace knead
