#include "edit/live_publisher.h"

#include "edit/handle_motion.h"
#include "graph/local_spacing.h"

#include <algorithm>
#include <cctype>

namespace knead {

void LivePublisher::say(Notice::Kind kind, const std::string& words, Notice::About about) {
    shared_.with([&](LiveShared& s) { s.notices.push_back({kind, words, about}); });
}

void LivePublisher::refuse(LiveDocument::Refused refused) {
    shared_.with([&](LiveShared& s) { s.refused.push_back(refused); });
}

// Posed shapes change where the pipeline wrote them since the last one was shown; any other is all new.
void LivePublisher::note_changes(const RestShape& shape, const Pipeline& pipeline) {
    const bool is_posed = &shape == &pipeline.posed();
    changed_in_.resize(blocks_of(shape.positions.size() / 3), 0);
    for (std::size_t block = 0; block < changed_in_.size(); ++block)
        if (!is_posed || pipeline.written()[block] > shown_upsampling_) changed_in_[block] = frames_;
    shown_upsampling_ = is_posed ? pipeline.upsampled() : 0;
}

void LivePublisher::shape(std::shared_ptr<const RestShape> shape, const Pipeline& pipeline,
                          const FrameFacts& facts) {
    ++frames_;
    note_changes(*shape, pipeline);
    next_.shape = std::move(shape);
    next_.changed_in = changed_in_;
    next_.version = next_.points_version = frames_;
    next_.on_device.reset();
    note_facts(next_, facts);
    last_is_drawn_ = false;
    PosedFrame drawn;
    shared_.with([&](LiveShared& s) {
        std::swap(s.frame, next_);
        std::swap(s.drawn, drawn);
    });
    next_.shape.reset(); // for the next shape to be written into
}

void LivePublisher::note_facts(PosedFrame& frame, const FrameFacts& facts) {
    frame.shows_pose = facts.pose_set.has_value();
    if (facts.pose_set) frame.pose_set = *facts.pose_set;
    frame.solve = facts.solve;
    frame.upsample = facts.upsample;
}

// Whoever draws has other points from here on, so the next shape is all new.
void LivePublisher::drawn(std::shared_ptr<const DeviceFrame> frame, const FrameFacts& facts) {
    ++frames_;
    shown_upsampling_ = 0;
    last_is_drawn_ = true;
    PosedFrame made;
    made.version = frames_;
    made.on_device = std::move(frame);
    note_facts(made, facts);
    shared_.with([&](LiveShared& s) { s.drawn = std::move(made); });
}

void LivePublisher::view(const Document& document, const LiveRecording& recording, const ViewFacts& facts) {
    auto view = std::make_shared<DocumentView>();
    const Pipeline& pipeline = document.pipeline();
    view->settings = document.settings();
    view->handles = document.handles();
    view->motions = document.motions();
    view->posed = facts.moving || std::ranges::any_of(document.motions(), leaves_rest);
    view->acts = recording.acts();
    view->state = recording.state();
    view->last_step = facts.last_step;
    view->last_words = recording.last_words();
    view->next_words = recording.next_words();
    view->last_frames = recording.last_frames();
    view->undoable_steps = recording.undoable_steps();
    view->redoable_steps = recording.redoable_steps();
    view->samples = pipeline.samples().size();
    view->chooses_samples = facts.chooses_samples;
    view->suited = facts.suited;
    view->strays = pipeline.strays();
    view->rest = document.kept_rest();
    view->graph = pipeline.shared_graph();
    view->components = pipeline.shared_components();
    view->cloud_size = pipeline.cloud_size();
    view->small_patches = pipeline.small_patches();
    note_graph(pipeline);
    view->spacings = spacings_;
    view->outliers = outliers_;
    note_samples(pipeline);
    view->sample_vertices = sample_vertices_;
    view->sample_graph = sample_graph_;
    view->device = facts.device;
    view->cloud = recording.cloud();
    view->session = facts.session;
    shared_.with([&](LiveShared& s) {
        s.view = std::move(view);
        s.saved = facts.saved;
    });
}

void LivePublisher::tell(Notice::Kind kind, Notice::About about, std::string words, std::string& told) {
    if (words == told) return;
    told = words;
    if (!words.empty()) words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
    if (!words.empty()) words += '.';
    shared_.with([&](LiveShared& s) { s.notices.push_back({kind, std::move(words), about}); });
}

void LivePublisher::strays(const Pipeline::LooseParts& strays) {
    std::string words = words_about(strays);
    if (!words.empty() && strays.fate == Strays::freeze)
        words +=
            "; \"Strays\" in the shape panel can make all such parts follow, or join them to what they "
            "lie next to. Changing it makes the pose the new rest shape, so undo first (Ctrl+Z) what tore "
            "them off";
    tell(Notice::Kind::information, Notice::About::strays, std::move(words), told_of_strays_);
}

void LivePublisher::demand(const HandleDemand& demand) {
    tell(Notice::Kind::warning, Notice::About::demand, words_about_demand(demand), told_of_demand_);
}

namespace {

// Of what a drag moves, those of the first handle about which there is something to say.
template<typename WordsAbout>
std::string first_words(const Document& document, const DragLine& drag, WordsAbout&& words_about) {
    std::string words = words_about(document, drag.handle);
    for (auto other = drag.with.begin(); other != drag.with.end() && words.empty(); ++other)
        words = words_about(document, other->handle);
    return words;
}

} // namespace

void LivePublisher::swallowed(const Document& document, const DragLine& drag) {
    tell(Notice::Kind::warning, Notice::About::swallowed, first_words(document, drag, words_about_swallowed),
         told_of_swallowed_);
}

void LivePublisher::loose(const Document& document, const DragLine& drag) {
    std::string words = first_words(document, drag, words_about_loose);
    if (!words.empty() && document.settings().strays != Strays::bridge)
        words += "; \"Strays: Join\" in the shape panel joins them. Changing it makes the pose the new rest "
                 "shape, so undo that first (Ctrl+Z)";
    tell(Notice::Kind::warning, Notice::About::loose, std::move(words), told_of_loose_);
}

// What the window knows of the points by their neighbours.
void LivePublisher::note_graph(const Pipeline& pipeline) {
    if (!pipeline.shared_graph() || pipeline.shared_graph() == graph_seen_) return;
    spacings_ = std::make_shared<const std::vector<float>>(
        spacing_of_points(pipeline.order(), *pipeline.shared_graph(), pipeline.opened().positions, workers_));
    const std::span<const std::uint8_t> hanging = pipeline.hanging();
    outliers_ = hanging.empty()
                    ? nullptr
                    : std::make_shared<const std::vector<std::uint8_t>>(hanging.begin(), hanging.end());
    graph_seen_ = pipeline.shared_graph(); // last: where memory runs out, this is done again
}

void LivePublisher::note_samples(const Pipeline& pipeline) {
    if (pipeline.samples_version() == samples_seen_) return;
    sample_vertices_ = std::make_shared<const std::vector<Index>>(pipeline.samples());
    sample_graph_ = std::make_shared<const Graph>(pipeline.sample_graph().graph);
    samples_seen_ = pipeline.samples_version(); // last, too
}

} // namespace knead
