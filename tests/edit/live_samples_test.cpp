// A live document that chooses its number of samples by itself. What it chooses depends on how fast this
// machine is at the moment; these tests only know that it never chooses 700.

#include "edit/editor_bar.h"
#include "edit/live_bar.h"

#include <set>

namespace knead::test {

namespace {

constexpr std::uint64_t by_hand = 700;

bool is_chosen(const Settings& settings) {
    return !settings.samples ||
           std::set<std::uint64_t>{200, 500, 1000, 2000, 5000, 10000, 20000}.contains(*settings.samples);
}

SettingsChange of_samples(std::uint64_t samples) {
    SettingsChange change;
    change.samples = samples;
    return change;
}

// The bar with 700 samples and no handles yet.
class ChoosingBar : public LiveBar {
protected:
    void SetUp() override { open_bar(by_hand); }

    void open_bar(std::optional<std::uint64_t> samples, std::size_t points = 3000) {
        OpenRequest request = request_for(bar_file(folder_, points));
        request.choose_samples = true;
        if (samples) request.settings = of_samples(*samples);
        live_ = std::make_unique<LiveDocument>(request);
        wait_until_open(*live_);
        ASSERT_EQ(live_->status().stage, LiveDocument::Stage::open);
    }

    void make_handles() {
        for (const SessionAction& handle : bar_handles()) live_->post(++step_, {handle});
        settle_down();
    }

    Settings settings() const { return live_->view()->settings; }
};

} // namespace

TEST_F(ChoosingBar, AnOwnNumberStaysAsItIs) {
    make_handles();
    drag({turned(0.5)});
    live_->post(++step_, {CommitLine{}});
    settle_down();
    EXPECT_FALSE(live_->view()->chooses_samples);
    EXPECT_EQ(settings().samples, by_hand);
}

TEST_F(ChoosingBar, ACloudThatIsOpenedHasAChosenNumberAndNoAct) {
    for (const std::size_t points : {900U, 3000U, 20000U}) {
        open_bar(std::nullopt, points);
        settle_down();
        EXPECT_TRUE(live_->view()->chooses_samples);
        EXPECT_EQ(live_->view()->acts, 0U);
        EXPECT_EQ(settings().samples, points == 900    ? std::optional<std::uint64_t>{}
                                      : points == 3000 ? std::optional<std::uint64_t>{1000}
                                                       : std::optional<std::uint64_t>{2000});
    }
}

TEST_F(ChoosingBar, ASessionKeepsItsNumber) {
    make_handles();
    live_->save_session(folder_ / "a.knead");
    settle_down();
    OpenRequest request = request_for(folder_ / "a.knead");
    request.choose_samples = true;
    live_ = std::make_unique<LiveDocument>(request);
    wait_until_open(*live_);
    live_->post(++step_, {DeleteLine{"low"}});
    settle_down();
    EXPECT_FALSE(live_->view()->chooses_samples);
    EXPECT_EQ(settings().samples, by_hand);

    request.session_chooses_samples = true;
    live_ = std::make_unique<LiveDocument>(request);
    wait_until_open(*live_);
    settle_down();
    EXPECT_TRUE(live_->view()->chooses_samples);
    EXPECT_EQ(settings().samples, by_hand) << "until an act asks for another";
    live_->post(++step_, {DeleteLine{"low"}});
    settle_down();
    EXPECT_TRUE(is_chosen(settings()));
}

TEST_F(ChoosingBar, WhatItChoosesBelongsToTheActThatLedToIt) {
    live_->choose_samples(true);
    live_->post(++step_, {bar_handles()[0]});
    live_->post(++step_, {bar_handles()[1]});
    settle_down();
    const auto view = live_->view();
    EXPECT_TRUE(is_chosen(view->settings)) << *view->settings.samples;
    EXPECT_EQ(view->suited.samples, view->settings.samples);
    EXPECT_EQ(view->undoable_steps, 2U);
    EXPECT_GE(view->acts, 3U);
    EXPECT_EQ(view->last_words, "new moving handle \"high\"");

    live_->undo(step_);
    live_->undo(step_ - 1);
    settle_down();
    EXPECT_EQ(settings().samples, by_hand);
    EXPECT_EQ(live_->view()->redoable_steps, 2U) << "an undo leads to no choice";
    live_->redo(step_ - 1);
    live_->redo(step_);
    settle_down();
    EXPECT_EQ(settings().samples, view->settings.samples);
    EXPECT_EQ(live_->view()->state, view->state);
}

TEST_F(ChoosingBar, WaitsForACommitAndNeverMakesOne) {
    make_handles();
    drag({turned(0.5)});
    const LineArray<float> posed = frame_.positions();
    live_->choose_samples(true);
    drag({turned(0.9)});
    SettingsChange softer;
    softer.stiffness = 0.02;
    live_->post(++step_, {SetLine{softer}});
    settle_down();
    EXPECT_TRUE(live_->view()->posed);
    EXPECT_EQ(settings().samples, by_hand);
    EXPECT_NE(live_->view()->suited.samples, by_hand) << "it knows what it would choose";

    const std::size_t steps = live_->view()->undoable_steps;
    live_->post(++step_, {CommitLine{}});
    settle_down();
    EXPECT_FALSE(live_->view()->posed);
    EXPECT_TRUE(is_chosen(settings()));
    EXPECT_EQ(live_->view()->undoable_steps, steps + 1);
    EXPECT_EQ(live_->view()->last_words, "pose committed");
    live_->undo(step_);
    settle_down();
    EXPECT_TRUE(live_->view()->posed);
    EXPECT_EQ(settings().samples, by_hand);
}

TEST_F(ChoosingBar, WhatItChoseReplaysToTheSameBytes) {
    live_->choose_samples(true);
    make_handles();
    drag({turned(0.4, {1, 0, 0}), turned(0.8, {1, 0, 0})});
    live_->post(++step_, {CommitLine{}});
    settle_down();
    EXPECT_TRUE(is_chosen(settings()));
    drag({turned(0.5, {0, 1, 0})});
    expect_replay_makes_the_same();
    std::size_t chosen = 0;
    for (const SessionLine& line : read_session(folder_ / "saved.knead").lines)
        if (const auto* set = std::get_if<SetLine>(&line.action)) chosen += set->change.samples ? 1 : 0;
    EXPECT_GE(chosen, 1U);
}

TEST_F(ChoosingBar, WhatWasSavedStaysSaved) {
    live_->choose_samples(true);
    live_->post(++step_, {bar_handles()[1]});
    live_->save_session(folder_ / "a.knead");
    settle_down();
    EXPECT_EQ(live_->saved().session_state, live_->view()->state);
}

// --- The editor's part of it ---

TEST_F(BarEditor, AnOwnNumberOfSamplesEndsTheChoosingAndItsUndoBringsItBack) {
    apply(editor_, ChangeSettings{of_samples(by_hand)});
    make_handles();
    EXPECT_FALSE(editor_.chooses_samples);
    apply(editor_, ChooseSamples{true});
    calm();
    EXPECT_TRUE(editor_.chooses_samples);
    EXPECT_TRUE(is_chosen(editor_.document->settings));
    const auto chosen = editor_.document->settings.samples;
    EXPECT_EQ(editor_.past.size(), editor_.document->undoable_steps + 2) << "two selections";

    apply(editor_, ChangeSettings{of_samples(300)});
    calm();
    EXPECT_FALSE(editor_.chooses_samples);
    EXPECT_FALSE(editor_.document->chooses_samples);
    EXPECT_EQ(editor_.document->settings.samples, 300U);
    for (int undone = 0; undone < 3 && editor_.document->settings.samples != by_hand; ++undone) {
        apply(editor_, UndoStep{});
        calm();
        const bool before_it_was_chosen = editor_.document->settings.samples == by_hand;
        EXPECT_EQ(editor_.chooses_samples, !before_it_was_chosen);
        EXPECT_EQ(editor_.document->chooses_samples, !before_it_was_chosen);
    }
    EXPECT_EQ(editor_.document->settings.samples, by_hand);
    while (can_redo(editor_)) apply(editor_, RedoStep{});
    calm();
    EXPECT_FALSE(editor_.chooses_samples);
    EXPECT_EQ(editor_.document->settings.samples, 300U);
    EXPECT_NE(chosen, 300U);
}

TEST_F(BarEditor, ChoosingSamplesOfAPosedCloudWaits) {
    apply(editor_, ChangeSettings{of_samples(by_hand)});
    make_handles();
    turn_chosen("40");
    const std::size_t steps = editor_.past.size();
    apply(editor_, ChooseSamples{true});
    calm();
    EXPECT_TRUE(editor_.document->posed);
    EXPECT_EQ(editor_.past.size(), steps);
    EXPECT_EQ(editor_.document->settings.samples, by_hand);
    apply(editor_, CommitPose{});
    calm();
    EXPECT_TRUE(is_chosen(editor_.document->settings));
    EXPECT_EQ(editor_.past.size(), steps + 1);
}

} // namespace knead::test
