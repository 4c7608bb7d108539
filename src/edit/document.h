#pragma once
// A cloud being edited: its handles, settings, poses and history, changed by the actions of a session.
//
// The replay and the editor both work on a Document; an action is carried out whole or refused with an Error,
// which leaves the document as it was.

#include "edit/pipeline.h"

#include <memory>
#include <string>
#include <vector>

namespace knead {

// What the frames of a document cost, for whoever wants to know; times in seconds.
struct FrameLog {
    std::vector<double> iteration; // one entry an iteration
    std::vector<double> upsample;  // one entry a frame
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
    const Settings& settings() const { return now_.settings; }
    const std::vector<Handle>& handles() const { return now_.handles; }
    const FrameLog& log() const { return log_; }

    // Whether handles were dragged since the last commit.
    bool is_posed() const { return now_.samples != nullptr; }

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

    // --- The shape now ---

    // 3n floats in the order of the file, relative to cloud().origin; and normals, empty without.
    std::vector<float> positions(Progress& progress);
    std::vector<float> normals(Progress& progress);

    // The largest distance of a handle's point from where its handle sends it, over D; 0 when nothing is
    // posed.
    double handle_error(Progress& progress);

private:
    // Everything that undo takes back; arrays are shared between states, and never changed once they are
    // here.
    struct State {
        Settings settings;
        std::vector<Handle> handles;
        std::vector<HandleMotion> motions;          // one a handle, in this edit
        std::shared_ptr<const RestShape> rest;      // null: as opened
        std::shared_ptr<const SampleState> samples; // null: nothing was dragged in this edit
    };

    Index find_handle(const std::string& name, const std::string& place) const;
    void refuse_while_posed(const std::string& what, const std::string& place) const;
    void take(State next); // makes it the present one, and the present one the last in history
    void prepare(Progress& progress);
    std::size_t run_iterations(const std::vector<HandleMotion>& motions, SampleState& state,
                               std::size_t count, bool until_at_rest, Progress& progress);
    void upsample(const std::vector<HandleMotion>& motions, const SampleState& state);
    const RestShape& shape_now(Progress& progress);
    std::vector<Index> resolve(const HandleLine& line, const std::string& place);

    Mode mode_;
    PointCloud cloud_;
    Bounds bounds_;
    Pipeline pipeline_;
    State now_;
    std::vector<State> past_, future_;
    bool posed_is_now_ = false; // whether the pipeline's posed points are those of now_
    FrameLog log_;
};

} // namespace knead
