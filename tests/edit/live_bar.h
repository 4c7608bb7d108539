#pragma once
// A bar with handles at both ends, in a live document.

#include "edit/live.h"
#include "edit/replay.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace knead::test {

inline OpenRequest request_for(const std::filesystem::path& file) {
    OpenRequest request;
    request.file = file;
    request.device = "reference";
    request.threads = 2;
    return request;
}

// A bar with handles at both ends, open.
class LiveBar : public ::testing::Test {
protected:
    void SetUp() override { open(request_for(bar_file(folder_))); }

    void open(OpenRequest request) {
        live_ = std::make_unique<LiveDocument>(std::move(request));
        wait_until_open(*live_);
        ASSERT_EQ(live_->status().stage, LiveDocument::Stage::open);
        for (const SessionAction& handle : bar_handles()) live_->post(++step_, {handle});
        settle_down();
    }

    void settle_down() {
        wait_until_idle(*live_);
        live_->take_frame(frame_);
    }

    void drag(const std::vector<Transform>& poses) {
        live_->begin_drag(++step_, "high", {0, 0, 2});
        for (const Transform& pose : poses) {
            live_->drag_to(pose);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        live_->end_drag();
        settle_down();
    }

    // Saves cloud and session, replays the session, and expects the same bytes.
    void expect_replay_makes_the_same() {
        live_->save_cloud(folder_ / "saved.ply");
        live_->save_session(folder_ / "saved.knead");
        settle_down();
        const Session session = read_session(folder_ / "saved.knead");
        ReplayOptions options;
        options.out = folder_ / "replayed.ply";
        options.device = "reference";
        SilentProgress silent;
        replay(session, options, silent, [](const std::string&) {});
        EXPECT_EQ(read_text(folder_ / "saved.ply"), read_text(folder_ / "replayed.ply"));
    }

    // How far the points went from where they were opened, at most.
    double largest_displacement() {
        const std::span<const float> opened = live_->opened().opened->positions;
        double largest = 0;
        for (std::size_t i = 0; i < opened.size(); ++i)
            largest = std::max(largest, std::abs(static_cast<double>(frame_.positions()[i] - opened[i])));
        return largest;
    }

    ScratchFolder folder_;
    std::unique_ptr<LiveDocument> live_;
    PosedFrame frame_;
    StepNumber step_ = 0;
};

} // namespace knead::test
