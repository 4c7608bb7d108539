// What the document's thread makes of acts where memory runs out: document and recording have the same ones,
// and what comes after is carried out.

#include "edit/handle_motion.h"
#include "edit/live.h"
#include "edit/live_work.h"
#include "edit/replay.h"
#include "no_memory/failing_new.h"

#include <limits>
#include <new>

namespace knead::test {
namespace {

constexpr std::size_t never = std::numeric_limits<std::size_t>::max();

// A document's thread without a thread: tasks are carried out when the test says so. Its bar has its handles.
class Work {
public:
    Work() : work_(request(), shared_) {
        work_.open();
        carry_out(task::Lines{++step_, bar_handles(), false});
    }

    // Whether an allocation failed, the one after so many.
    bool carry_out(LiveTask task, std::size_t after = never) {
        shared_.change([&](LiveShared& shared) { shared.inbox.push_back(std::move(task)); });
        const FailingNew failing(after);
        work_.turn();
        EXPECT_TRUE(shared_.with([](const LiveShared& shared) { return shared.inbox.empty(); }));
        return failing.has_failed();
    }

    void begin_drag(std::size_t after = never) {
        failed_ = carry_out(task::BeginDrag{++step_, "high", {0, 0, 2}}, after);
    }
    void end_drag(std::size_t after = never) {
        const WantedPose pose{turned(0.1, {1, 0, 0}), std::chrono::steady_clock::now()};
        failed_ = carry_out(task::EndDrag{pose}, after);
    }
    // A frame of it.
    void drag_to(double angle, std::size_t after = never) {
        shared_.change([&](LiveShared& shared) {
            shared.wanted = WantedPose{turned(angle, {1, 0, 0}), std::chrono::steady_clock::now()};
        });
        const FailingNew failing(after);
        work_.turn();
        failed_ = failing.has_failed();
    }
    void set_iterations(std::size_t after = never) {
        SettingsChange change;
        change.iterations = 7;
        failed_ = carry_out(task::Lines{++step_, {SetLine{change}}, false}, after);
    }
    void commit(std::size_t after = never) {
        failed_ = carry_out(task::Lines{++step_, {CommitLine{}}, false}, after);
    }
    void undo(std::size_t after = never) { failed_ = carry_out(task::Undo{++step_, false}, after); }
    void redo(std::size_t after = never) { failed_ = carry_out(task::Redo{++step_, false}, after); }

    bool has_failed() const { return failed_; } // an allocation of the last one of these

    DocumentView view() {
        carry_out(task::ChooseSamples{false}); // which tells all again
        return shared_.with([](const LiveShared& shared) { return *shared.view; });
    }

    // Back to the bar with its handles. What the recording takes back has to be what the document has.
    void expect_one_history() {
        carry_out(task::CancelDrag{});
        set_iterations();
        EXPECT_EQ(view().settings.iterations, 7U) << "it was not carried out";
        while (!testing::Test::HasFailure() && view().undoable_steps > 1) undo();
        const DocumentView now = view();
        EXPECT_EQ(now.undoable_steps, 1U);
        EXPECT_EQ(now.handles.size(), 2U);
        EXPECT_TRUE(std::ranges::none_of(now.motions, leaves_rest));
        EXPECT_EQ(now.settings, Settings{});
    }

    // The cloud as it is, and as a replay of what was recorded makes it.
    void expect_replayed_as_it_is() {
        const std::filesystem::path cloud = folder_ / "now.ply", session = folder_ / "now.knead";
        shared_.change([](LiveShared& shared) { shared.saves = 2; });
        carry_out(task::SaveCloud{.target = cloud, .anyway = true});
        carry_out(task::SaveSession{session, true});
        ReplayOptions options;
        options.out = folder_ / "replayed.ply";
        options.device = "reference";
        options.threads = 1;
        SilentProgress progress;
        replay(read_session(session), options, progress, [](const std::string&) {});
        EXPECT_TRUE(read_text(*options.out) == read_text(cloud));
    }

    void expect_nothing_left() {
        undo();
        EXPECT_TRUE(view().handles.empty());
        EXPECT_EQ(view().undoable_steps, 0U);
    }

private:
    OpenRequest request() const {
        OpenRequest made;
        made.file = bar_file(folder_);
        made.journal_folder = folder_ / "state";
        made.device = "reference";
        made.threads = 1;
        return made;
    }

    ScratchFolder folder_;
    Locked<LiveShared> shared_;
    LiveWork work_;
    StepNumber step_ = 0;
    bool failed_ = false;
};

// Every allocation of short tasks, and of long ones fewer and fewer. With none that fails, there are so many
// steps; 0: nobody asks.
template<typename Before, typename Act>
void expect_one_history_where_each_fails(Work& work, std::size_t steps, Before&& before, Act&& act) {
    for (std::size_t after = 0;; after += 1 + after / 25) {
        SCOPED_TRACE("without allocation " + std::to_string(after));
        before();
        ASSERT_NO_THROW(act(after));
        if (!work.has_failed()) break;
        work.expect_one_history();
        if (testing::Test::HasFailure()) return;
    }
    if (steps > 0) {
        EXPECT_EQ(work.view().undoable_steps, steps) << "now it was carried out";
    }
    work.expect_one_history();
}

class LiveNoMemory : public testing::Test {
protected:
    void SetUp() override {
        if (!has_own_new) GTEST_SKIP() << "the sanitizers have an operator new of their own";
    }

    Work work_;
};

TEST_F(LiveNoMemory, LeavesOneHistoryOfADrag) {
    expect_one_history_where_each_fails(
        work_, 0, [] {}, [&](std::size_t after) { work_.begin_drag(after); });
    expect_one_history_where_each_fails(
        work_, 2, [&] { work_.begin_drag(); }, [&](std::size_t after) { work_.end_drag(after); });
    work_.expect_nothing_left();
}

TEST_F(LiveNoMemory, RecordsTheFramesThatADragHas) {
    for (std::size_t after = 0;; ++after) {
        SCOPED_TRACE("without allocation " + std::to_string(after));
        work_.begin_drag();
        work_.drag_to(0.1);
        work_.drag_to(0.2, after);
        const bool has_failed = work_.has_failed();
        work_.carry_out(task::EndDrag{});
        work_.expect_replayed_as_it_is();
        if (!has_failed) break;
        work_.undo();
    }
}

TEST_F(LiveNoMemory, LeavesOneHistoryOfLines) {
    expect_one_history_where_each_fails(
        work_, 2, [] {}, [&](std::size_t after) { work_.set_iterations(after); });
    const auto drag = [&] {
        work_.begin_drag();
        work_.end_drag();
    };
    expect_one_history_where_each_fails(work_, 3, drag, [&](std::size_t after) { work_.commit(after); });
    work_.expect_nothing_left();
}

TEST_F(LiveNoMemory, LeavesOneHistoryOfUndoAndRedo) {
    const auto change = [&] { work_.set_iterations(); };
    expect_one_history_where_each_fails(work_, 1, change, [&](std::size_t after) { work_.undo(after); });
    const auto change_and_undo = [&] {
        work_.set_iterations();
        work_.undo();
    };
    expect_one_history_where_each_fails(work_, 2, change_and_undo,
                                        [&](std::size_t after) { work_.redo(after); });
    work_.expect_nothing_left();
}

} // namespace
} // namespace knead::test
