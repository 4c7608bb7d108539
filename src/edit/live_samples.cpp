// How the document's thread chooses the number of samples by itself.

#include "edit/live_work.h"
#include "edit/median.h"

#include <algorithm>
#include <utility>

namespace knead {

namespace {

// Frames that are tried where no drag has been measured yet; the first, which meets cold memory, and a kernel
// that was never run, does not count.
constexpr int tried_frames = 4;

// Each frame of the trial goes so much further, over the diagonal: a handle at rest costs less than one that
// moves.
constexpr double trial_step = 1e-9;

// A drag of fewer frames than this says nothing about the machine.
constexpr std::size_t telling_frames = 3;

// So many drags in a row may be slower than what was measured before them: a machine is as fast as it was,
// and what else it has to do comes and goes. After them the fastest of them is believed.
constexpr unsigned most_slower_drags = 4;

// From so many samples on, how far apart the handles are is not asked.
constexpr std::size_t most_looked_at = 100'000;

} // namespace

void LiveWork::carry_out(task::ChooseSamples& task) {
    choice_.by_itself = task.by_itself;
    record([&] { recording_->chooses_samples(choice_.by_itself); });
    publish_view();
}

// What frames of so many iterations take. A frame's start costs about what an iteration does.
FrameCost LiveWork::at_iterations(const MeasuredCost& measured, unsigned iterations) {
    FrameCost cost = measured.cost;
    cost.solving *= (1.0 + iterations) / (1.0 + measured.iterations);
    return cost;
}

SampleNeeds LiveWork::sample_needs() const {
    SampleNeeds needs{document_->pipeline().order().vertices(), choice_.spread, {}};
    if (choice_.measured) needs.cost = at_iterations(*choice_.measured, document_->settings().iterations);
    return needs;
}

// What would be chosen now. As long as no frame was measured the number stays as it is: what a machine of any
// speed would be given is not told.
SampleChoice LiveWork::suited_samples() const {
    const std::optional<std::uint64_t> now = document_->settings().samples;
    SampleChoice suited = choose_samples_again(sample_needs(), now);
    if (choice_.by_itself && !choice_.measured && suited.samples != now)
        suited = {now, SampleReason::machine};
    return suited;
}

// After the stages are prepared. What is chosen is part of the act that led to it, and undone with it.
void LiveWork::choose_samples() {
    look_at_handles();
    const bool now = choice_.by_itself && choice_.is_due && !document_->is_posed() && recording_->can_undo();
    if (!now) return;
    if (!choice_.measured) measure_frame();
    choice_.is_due = false;
    const std::optional<std::uint64_t> samples = suited_samples().samples;
    if (samples == document_->settings().samples) return;
    SettingsChange change;
    change.samples = samples;
    auto coming = recording_->coming_to_last(SetLine{change});
    document_->change_settings(change, "");
    record([&] { recording_->add(std::move(coming)); });
    ahead_ = true;
}

void LiveWork::look_at_handles() {
    const Pipeline& pipeline = document_->pipeline();
    choice_.spread = {};
    if (document_->handles().empty() || pipeline.samples().size() > most_looked_at) return;
    choice_.spread =
        spread_of(pipeline.labels(), pipeline.graph(), pipeline.samples(), pipeline.sample_graph().graph);
}

// A handle that is dragged to where it is, or all but, and never was.
void LiveWork::measure_frame() {
    const auto& handles = document_->handles();
    const auto moving = std::ranges::find(handles, HandleRole::moving, &Handle::role);
    if (moving == handles.end()) return;
    std::vector<double> solving, upsampling;
    document_->begin_drag(moving->name, Vec3d::Zero(), "", progress_);
    try {
        const auto undisturbed = [&] {
            return shared_.with([](const LiveShared& s) { return s.inbox.empty() && !s.stop; });
        };
        for (int frame = 0; frame < tried_frames && undisturbed(); ++frame) {
            HandlePose pose;
            pose.translate.x() = trial_step * frame * document_->bounds().diagonal();
            const Stopwatch clock;
            document_->drag_frame(pose, "", progress_);
            const double upsample = document_->log().upsample.back();
            if (frame == 0) continue;
            upsampling.push_back(upsample);
            solving.push_back(clock.seconds() - upsample);
        }
    } catch (...) {
        document_->abandon();
        throw;
    }
    document_->abandon();
    learn_cost(std::move(solving), std::move(upsampling));
}

void LiveWork::learn_cost(std::vector<double> solving, std::vector<double> upsampling) {
    if (solving.size() < telling_frames) return;
    const std::uint64_t points = document_->pipeline().order().vertices();
    const std::uint64_t samples = std::min(document_->settings().samples.value_or(points), points);
    // Frames that are drawn on the device tell nothing of those that are not.
    const double moving = !upsampling.empty() ? median(std::move(upsampling))
                          : choice_.newest    ? choice_.newest->cost.upsampling
                                              : 0;
    learn({{samples, median(std::move(solving)), moving}, document_->settings().iterations});
}

// What it measured is believed at once where the machine was as fast as before. Of drags that were slower it
// is the fastest, and only after some of them.
void LiveWork::learn(const MeasuredCost& learned) {
    choice_.newest = learned;
    const auto is_slower_than = [&](const MeasuredCost& known) {
        return is_faster(at_iterations(known, learned.iterations), learned.cost);
    };
    if (choice_.measured && is_slower_than(*choice_.measured)) {
        if (!choice_.slower || !is_slower_than(*choice_.slower)) choice_.slower = learned;
        if (++choice_.slower_drags <= most_slower_drags) return;
        choice_.measured = choice_.slower;
    } else {
        choice_.measured = learned;
    }
    choice_.slower.reset();
    choice_.slower_drags = 0;
}

} // namespace knead
