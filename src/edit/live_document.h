#pragma once
// A document that is edited while it is looked at: it lives on a thread of its own, so that the window never
// waits for it.
//
// The window posts acts and takes back, whenever it likes, what is newest: a view of the document, the posed
// points, words for the user. Of the poses of a drag only the newest counts; the ones that were computed are
// the frames of the session's `drag` line, so that a replay of the recording on the same device makes
// the same shape to the bit.
// Where iterations of all samples cannot follow the hand, few answer for them (a frame with `coarse`), and
// all go on as soon as the hand rests. While a pose rests the shape goes on converging: in a drag by repeated
// frames, afterwards by a `settle` line.
//
// Every finished act goes to the journal, if there is one, before anybody sees its result.

#include "base/background.h"
#include "base/locked.h"
#include "edit/command.h"
#include "edit/document.h"
#include "edit/handle_lines.h"
#include "edit/journal.h"
#include "edit/sample_choice.h"
#include "edit/session.h"
#include "upsample/devices.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace knead {

// A number that the caller gives an act, to be told of its fate.
using StepNumber = std::uint64_t;

// The document as it is between two acts. Shared and never changed.
struct DocumentView {
    Settings settings;
    std::vector<Handle> handles;
    std::vector<HandleMotion> motions; // of each handle, in this edit, about the cloud's origin
    bool posed = false;
    std::size_t acts = 0;        // that were recorded so far
    std::uint64_t state = 0;     // names what the acts so far make; undone and done again it is the same
    StepNumber last_step = 0;    // the newest that was carried out
    std::string last_words;      // what the newest act does, such as "pose committed"; empty at the beginning
    std::string next_words;      // and what would be redone next; empty where nothing is undone
    std::size_t last_frames = 0; // of the drag that the newest step began with; 0: it is none
    std::size_t undoable_steps = 0, redoable_steps = 0;
    std::size_t samples = 0;      // 0: not chosen yet
    bool chooses_samples = false; // by itself
    SampleChoice suited;          // what it would choose, or does
    Pipeline::LooseParts strays;
    std::shared_ptr<const RestShape> rest;        // of this edit; null: as opened, or it was let go of
    std::shared_ptr<const Graph> graph;           // of the vertices; null until it was built
    std::shared_ptr<const Components> components; // and what hangs together in it; null as long
    // Of the vertices 1 for an outlier, which lies off the surface by itself; null as long, and without any.
    std::shared_ptr<const std::vector<std::uint8_t>> outliers;
    double cloud_size = 0;                                 // Pipeline::cloud_size(); 0 as long
    std::shared_ptr<const PatchesOfHandles> small_patches; // of handles, once those are prepared
    std::shared_ptr<const std::vector<float>>
        spacings; // of the points as opened; null until the graph was built
    std::shared_ptr<const std::vector<Index>> sample_vertices; // where the samples are; null before a drag
    std::shared_ptr<const Graph> sample_graph;                 // between them; null before a drag
    std::string device;
    std::filesystem::path cloud;   // the file that it is about, absolute
    std::filesystem::path session; // where it was saved last, or opened from; empty: never
};

// The posed points, in the order of computation.
struct PosedFrame {
    // Shared with the document, which does not change it any more; empty where there is nothing yet.
    std::shared_ptr<const RestShape> shape = std::make_shared<RestShape>();
    std::uint64_t version = 0; // counts the frames; 0: nothing here
    // Where frames of a drag are drawn on the device (LiveDocument::draw_drags_on_device()): the newest one,
    // which moves the points for whoever draws, and of which `shape` knows nothing: that is of a version
    // before. Null where that is the newest.
    std::shared_ptr<const DeviceFrame> on_device;
    std::uint64_t points_version = 0; // of `shape`
    // The version in which each block of points (upsample/point_blocks.h) changed last: whoever has the
    // points of an earlier version needs only what changed after it, see changed_since().
    std::vector<std::uint64_t> changed_in;
    std::chrono::steady_clock::time_point pose_set; // when the hand set the pose that this frame shows
    bool shows_pose = false; // whether it is of a drag at all (not of an undo, a commit ...)
    double solve = 0;        // seconds of its iterations
    double upsample = 0;     // seconds

    const LineArray<float>& positions() const { return shape->positions; }
    const LineArray<float>& normals() const { return shape->normals; }
};

// The points that changed since the frame of this version; all of them since 0. `ranges` are written over.
void changed_since(std::uint64_t version, const PosedFrame& frame, std::vector<PointRange>& ranges);

// What the user should hear.
struct Notice {
    enum class Kind { information, warning, error } kind = Kind::information;
    std::string words; // empty: what was said about this before holds no longer
    // One about the shape takes the place of what was said about the same before.
    enum class About { itself, demand, strays, swallowed, loose, committed } about = About::itself;
};

// Everything that stays of the opened cloud; views into the live document, valid as long as it lives.
struct OpenedCloud {
    std::filesystem::path file;
    const PointCloud* cloud = nullptr;
    const PointOrder* order = nullptr;
    std::shared_ptr<const RestShape> opened;
    Bounds bounds;           // in the file's coordinates
    double spacing = 0;      // the usual distance between neighbouring points
    Pivots last_pivots = {}; // of Document, as it was opened
    // Document::pivot_moves() of every step, those that can be undone first, in the order in which they were
    // done.
    std::vector<std::vector<Document::PivotMove>> pivot_moves = {};
};

// Where a handle's joint is to be, in the file's coordinates; nothing: it has none of its own.
struct PivotPlace {
    std::string handle;
    std::optional<Vec3d> place;
};

// What is saved with a cloud beside its own attributes, and what without.
struct ExportOptions {
    bool displacement = false;   // "displacement", of each point from where it was opened
    bool stretch = false;        // "stretch", see edit/measures.h
    bool without_hidden = false; // leaves out the points that are hidden when it is asked for
};

// A save that was not carried out, since somebody else has changed the file after this editor read or wrote
// it.
struct HeldSave {
    std::filesystem::path target;
    std::optional<ExportOptions> options; // of a cloud; none: a session
};

struct OpenRequest {
    std::filesystem::path file;                   // a cloud or a session
    std::filesystem::path journal_folder;         // empty: no journal
    std::optional<std::filesystem::path> restore; // a journal to take over instead: `file` is not looked at
    // Instead of the one that the session or the journal names, which is in another place now; its digest is
    // not asked for. Refused with a plain cloud.
    std::optional<std::filesystem::path> cloud;
    std::string device; // as make_upsampler() takes it
    unsigned threads = 0;
    UpsamplerMaker make_upsampler = knead::make_upsampler; // another one, for tests of failing devices
    SettingsChange settings;                               // of a cloud; of a session only where
    bool sets_session = false; // this says so: then they are a step of its own at its end
    // Whether the number of samples is chosen, and chosen anew after acts, as edit/sample_choice.h says: of a
    // cloud, and not where `settings` have a number.
    bool choose_samples = false;
    // The same of a session, which has its own number until the first of these acts.
    bool session_chooses_samples = false;
    // Seconds. If solving a frame takes longer, few samples answer for all while the hand moves.
    double quick = 0.02;
};

// The pose of a moving handle, for another one that takes it over. It comes there the same way, as often
// round.
struct PoseOfAnother {
    std::string handle;
    std::function<HandleMotion(const HandleMotion&)> seen; // of any of its motions: what the other's would be
};

struct LiveShared; // what both threads see (edit/live_shared.h)

class LiveDocument {
public:
    // Starts opening at once and returns.
    explicit LiveDocument(OpenRequest request);
    // Stops what is going on, and waits for it.
    ~LiveDocument();
    LiveDocument(const LiveDocument&) = delete;
    LiveDocument& operator=(const LiveDocument&) = delete;

    // --- How opening goes ---

    enum class Stage { opening, open, failed };
    struct Status {
        Stage stage = Stage::opening;
        std::string doing;        // what a long stage does now; empty when nothing long goes on
        double fraction = 0;      // of it
        bool wants_cloud = false; // failed, as the session's cloud is not there, or is another one
        bool busy = false;        // whether the thread has anything to do, converging included
        bool solving = false;     // whether it is converging or following the hand
        bool saving = false;      // whether a file is being written, or is yet to be
        bool undoing = false;     // whether an undo or redo that counts, and is not to look, is yet to be
        // What play() shows at the moment.
        struct Playing {
            std::string handle;     // that was dragged; empty: a pose comes to rest, or nothing moves
            std::size_t frame = 0;  // the one that is shown, from 1; 0: none yet
            std::size_t frames = 0; // of the drag, or of what comes to rest
            bool held = false;
            bool operator==(const Playing&) const = default;
        };
        std::optional<Playing> playing;
    };
    Status status() const;
    void cancel_opening();
    OpenedCloud opened() const; // after Stage::open

    // --- Acts; all return at once, and are carried out in the order in which they were posted ---

    // Carries out session lines as one step of undo. Where a line may not stand while handles are posed, a
    // commit is put before it. A refused step is told by take_refused(), and changes nothing; lines of it
    // that were carried out before the one that was refused stand in the recording, undone, and what could be
    // redone before them no longer can. `joins_last`: it
    // is undone together with the step before it (a slider that goes on being moved).
    void post(StepNumber step, std::vector<SessionAction> lines, bool joins_last = false);

    // Changes a handle as it is when its turn comes, after all that was posted before. Where it is gone by
    // then, or is so already, the step counts as refused without words.
    void edit_handle(StepNumber step, HandleEdit edit);

    // Puts handles' joints where they are to be when their turn comes. Else as edit_handle().
    void put_pivots(StepNumber step, std::vector<PivotPlace> places);

    // Makes a handle, whose line has points, or takes the one that it declares as it is, and poses it like
    // another one.
    void make_posed(StepNumber step, HandleLine line, PoseOfAnother pose);

    // Whether the number of samples is chosen by itself from here on. That happens after an act that leaves
    // nothing posed, and belongs to its step: never in a drag, never where it would take a commit, and never
    // after an undo. It is recorded like any setting.
    void choose_samples(bool by_itself);

    // A drag of a moving handle: frames go on until end_drag(), the newest pose first. `pivot` is in the
    // file's coordinates.
    // `with`: other moving handles, which go along (DragLine::with).
    void begin_drag(StepNumber step, std::string handle, Vec3d pivot, std::vector<Companion> with = {});
    void drag_to(const Transform& transform); // on top of the handle's pose at begin_drag()
    void end_drag();
    // Whether whoever draws can move the points itself (upsample/drawing.h), and needs no positions while a
    // drag goes on: then its frames may come as PosedFrame::on_device. The points come when the shape has
    // come to rest and when the drag has ended, and with each frame from the next one on where it no longer
    // can.
    void draw_drags_on_device(bool yes);
    void cancel_drag(); // as if it had not begun; its step counts as refused without words

    // Takes handles back to where they were at rest in this edit, unwinding their turns.
    void reset_poses(StepNumber step, std::vector<std::string> handles);

    // Takes the last step back, or does it again. `step` is its number, so that nothing happens if it was
    // refused meanwhile. `to_look`: the journal has the step as done until something else is recorded; and
    // what was redone to look at it is undone again when that is taken back.
    void undo(StepNumber step, bool to_look = false);
    void redo(StepNumber step, bool to_look = false);

    // Does a step again like redo() to look at it, but shows the poses that were recorded, 30 a second at a
    // speed of 1, and of very many only some. Any act that comes in between ends it at once, as redo() would
    // have.
    void play(StepNumber step);
    void set_play_pace(double speed, bool held); // also of later ones
    void advance_play(int frames);               // while it is held; below 0: back, as far as this drag goes

    // Writes the shape as it is now / the session so far. Success and failure come as notices. Over a file
    // that somebody else has changed since this editor read or wrote it, only `anyway`: else
    // take_held_saves() has it. `keeps_original`: where the target is the very file that the cloud was read
    // from, that is copied first (edit/kept_original.h), and the document is about the copy from then on.
    // `hidden`: one a point in the order of the edit, 1 where the options may leave it out; empty: none is.
    void save_cloud(std::filesystem::path target, ExportOptions options = {}, bool anyway = false,
                    bool keeps_original = false, std::vector<std::uint8_t> hidden = {});
    void save_session(std::filesystem::path target, bool anyway = false);

    // --- What is newest ---

    std::shared_ptr<const DocumentView> view() const; // null until open
    // Puts the newest frame into `frame` if there is a newer one than it holds.
    bool take_frame(PosedFrame& frame);
    std::vector<Notice> take_notices();
    struct Refused {
        StepNumber step = 0;
        bool ends_redo = false; // nothing can be redone any more
        bool operator==(const Refused&) const = default;
    };
    std::vector<Refused> take_refused();
    std::vector<HeldSave>
    take_held_saves(); // since they were taken last, in the order in which they were asked for

    // The state (DocumentView::state) that a session on disk has; nothing where there is none.
    struct Saved {
        std::optional<std::uint64_t> session_state;
    };
    Saved saved() const;

    // Ends the journal for good: nothing will be offered for restoring. Call it when the user closes and
    // needs nothing kept.
    void discard_journal();

private:
    std::unique_ptr<Locked<LiveShared>> shared_;
    std::unique_ptr<Background> thread_;
};

} // namespace knead
