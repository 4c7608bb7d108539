#include "edit/live_document.h"

#include "edit/cures.h"
#include "edit/live_shared.h"

#include <utility>

namespace knead {

void changed_since(std::uint64_t version, const PosedFrame& frame, std::vector<PointRange>& ranges) {
    ranges.clear();
    for (std::size_t block = 0; block < frame.changed_in.size(); ++block)
        if (frame.changed_in[block] > version) append_block(block, frame.positions().size() / 3, ranges);
}

LiveDocument::LiveDocument(OpenRequest request) : shared_(std::make_unique<Locked<LiveShared>>()) {
    thread_ = std::make_unique<Background>([request = std::move(request), &shared = *shared_]() mutable {
        run_live_document(std::move(request), shared);
    });
}

std::size_t LiveShared::*count_of(const LiveTask& task) {
    if (std::holds_alternative<task::SaveCloud>(task) || std::holds_alternative<task::SaveSession>(task))
        return &LiveShared::saves;
    const auto* undo = std::get_if<task::Undo>(&task);
    const auto* redo = std::get_if<task::Redo>(&task);
    const bool counts = (undo && !undo->to_look) || (redo && !redo->to_look);
    return counts ? &LiveShared::undos : nullptr;
}

LiveDocument::~LiveDocument() {
    shared_->change([](LiveShared& shared) { shared.stop = true; });
    thread_.reset();
}

LiveDocument::Status LiveDocument::status() const {
    return shared_->with([](const LiveShared& shared) {
        Status status = shared.status;
        const bool plays = status.playing && (!shared.pace.held || shared.pace.frames != 0);
        status.busy |= plays || !shared.inbox.empty();
        status.saving = shared.saves > 0;
        status.undoing = shared.undos > 0;
        return status;
    });
}

void LiveDocument::cancel_opening() {
    shared_->change([](LiveShared& shared) {
        if (shared.status.stage == Stage::opening) shared.stop = true;
    });
}

OpenedCloud LiveDocument::opened() const {
    return shared_->with([](const LiveShared& shared) { return shared.opened; });
}

namespace {

void put(Locked<LiveShared>& shared, LiveTask task) {
    const auto count = count_of(task);
    shared.change([&](LiveShared& s) {
        s.inbox.push_back(std::move(task));
        if (count) ++(s.*count);
    });
}

} // namespace

void LiveDocument::post(StepNumber step, std::vector<SessionAction> lines, bool joins_last) {
    put(*shared_, task::Lines{step, std::move(lines), joins_last});
}

void LiveDocument::edit_handle(StepNumber step, HandleEdit edit) {
    put(*shared_, task::EditHandle{step, std::move(edit)});
}

void LiveDocument::put_pivots(StepNumber step, std::vector<PivotPlace> places) {
    put(*shared_, task::PutPivots{step, std::move(places)});
}

void LiveDocument::make_posed(StepNumber step, HandleLine line, PoseOfAnother pose) {
    put(*shared_, task::MakePosed{step, std::move(line), std::move(pose)});
}

void LiveDocument::choose_samples(bool by_itself) {
    put(*shared_, task::ChooseSamples{by_itself});
}

void LiveDocument::begin_drag(StepNumber step, std::string handle, Vec3d pivot, std::vector<Companion> with) {
    put(*shared_, task::BeginDrag{step, std::move(handle), std::move(pivot), std::move(with)});
}

void LiveDocument::drag_to(const Transform& transform) {
    shared_->change([&](LiveShared& shared) {
        shared.wanted = WantedPose{transform, std::chrono::steady_clock::now()};
    });
}

// The last pose goes with the task, so that a drag begun right afterwards does not take its place.
void LiveDocument::end_drag() {
    shared_->change([](LiveShared& shared) {
        shared.inbox.emplace_back(task::EndDrag{std::exchange(shared.wanted, std::nullopt)});
    });
}

void LiveDocument::cancel_drag() {
    shared_->change([](LiveShared& shared) {
        shared.wanted.reset();
        shared.inbox.emplace_back(task::CancelDrag{});
    });
}

void LiveDocument::reset_poses(StepNumber step, std::vector<std::string> handles) {
    put(*shared_, task::ResetPoses{step, std::move(handles)});
}

void LiveDocument::undo(StepNumber step, bool to_look) {
    put(*shared_, task::Undo{step, to_look});
}

void LiveDocument::redo(StepNumber step, bool to_look) {
    put(*shared_, task::Redo{step, to_look});
}

void LiveDocument::play(StepNumber step) {
    put(*shared_, task::Play{step});
}

void LiveDocument::set_play_pace(double speed, bool held) {
    shared_->change([&](LiveShared& shared) { shared.pace = {speed, held, 0}; });
}

void LiveDocument::advance_play(int frames) {
    shared_->change([&](LiveShared& shared) { shared.pace.frames += frames; });
}

void LiveDocument::save_cloud(std::filesystem::path target, ExportOptions options, bool anyway,
                              bool keeps_original, std::vector<std::uint8_t> hidden) {
    put(*shared_, task::SaveCloud{std::move(target), options, anyway, keeps_original, std::move(hidden)});
}

void LiveDocument::save_session(std::filesystem::path target, bool anyway) {
    put(*shared_, task::SaveSession{std::move(target), anyway});
}

void LiveDocument::draw_drags_on_device(bool yes) {
    shared_->with([&](LiveShared& shared) { shared.draws_on_device = yes; }); // nobody waits for this
}

namespace {

// What a frame without points tells; they stay.
void take_facts(PosedFrame& from, PosedFrame& to) {
    to.version = from.version;
    to.on_device = std::exchange(from.on_device, nullptr);
    to.pose_set = from.pose_set;
    to.shows_pose = from.shows_pose;
    to.solve = from.solve;
    to.upsample = from.upsample;
}

} // namespace

std::shared_ptr<const DocumentView> LiveDocument::view() const {
    return shared_->with([](const LiveShared& shared) { return shared.view; });
}

bool LiveDocument::take_frame(PosedFrame& frame) {
    std::shared_ptr<const DeviceFrame> spent; // which go without the lock
    std::shared_ptr<const RestShape> shown;
    return shared_->change([&](LiveShared& shared) { // the document may wait for this
        bool is_new = false;
        if (shared.frame.version > frame.version) {
            std::swap(shared.frame, frame);
            spent = std::exchange(shared.frame.on_device, nullptr);
            shown = std::exchange(shared.frame.shape, nullptr);
            is_new = true;
        }
        if (shared.drawn.on_device && shared.drawn.version > frame.version) {
            take_facts(shared.drawn, frame);
            is_new = true;
        }
        return is_new;
    });
}

std::vector<Notice> LiveDocument::take_notices() {
    return shared_->with([](LiveShared& shared) {
        if (shared.lacked_memory) shared.notices.push_back({.kind = Notice::Kind::error, .words = no_memory});
        shared.lacked_memory = false;
        return std::exchange(shared.notices, {});
    });
}

std::vector<LiveDocument::Refused> LiveDocument::take_refused() {
    return shared_->with([](LiveShared& shared) { return std::exchange(shared.refused, {}); });
}

std::vector<HeldSave> LiveDocument::take_held_saves() {
    return shared_->with([](LiveShared& shared) { return std::exchange(shared.held_saves, {}); });
}

LiveDocument::Saved LiveDocument::saved() const {
    return shared_->with([](const LiveShared& shared) { return shared.saved; });
}

void LiveDocument::discard_journal() {
    shared_->change([](LiveShared& shared) { shared.keep_journal = false; });
}

} // namespace knead
