// Hands that know nothing do whatever commands there are, in any order and without waiting. Whatever comes of
// it, the recording replays to the same bytes, and undo and redo lead where they came from, to the bit.

#include "edit/cures.h"
#include "edit/editor.h"
#include "edit/live.h"
#include "edit/replay.h"

#include <cmath>
#include <cstdlib>
#include <random>

namespace knead::test {
namespace {

constexpr int width = 800, height = 600;

class RandomHands : public ::testing::TestWithParam<unsigned> {
protected:
    void SetUp() override {
        const Shape shapes[] = {Shape::bar, Shape::creature, Shape::knot, Shape::solid_bar};
        ShapeOptions options;
        options.points = 1200 + below(1800);
        options.outliers = below(2) ? 0.02 : 0.0;
        SilentProgress silent;
        Workers workers(1);
        write_cloud(file_, make_shape(shapes[below(4)], options, workers, silent), {}, silent);
        editor_.viewport = {width, height};
        OpenRequest request;
        request.file = file_;
        request.journal_folder = folder_ / "state";
        request.device = "reference";
        request.threads = 1 + below(2);
        request.choose_samples = below(3) == 0;
        request.quick = below(3) == 0 ? 0 : 1; // at once, or never
        open(editor_, request);
        ASSERT_TRUE(wait_until([&] { return refresh(editor_) && editor_.document; }));
        calm();
    }

    // --- Chance ---

    unsigned below(unsigned end) { return static_cast<unsigned>(chance_() % end); }
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(chance_()) / static_cast<double>(chance_.max());
    }
    template<typename Value>
    Value one_of(std::initializer_list<Value> values) {
        return *(values.begin() + below(static_cast<unsigned>(values.size())));
    }
    SelectMode any_mode() { return one_of({SelectMode::replace, SelectMode::add, SelectMode::remove}); }
    std::string any_handle() {
        const auto& handles = editor_.document->handles;
        if (handles.empty() || below(20) == 0) return "nobody";
        return handles[below(static_cast<unsigned>(handles.size()))].name;
    }

    void do_now(const Command& command) { apply(editor_, command); }

    // --- What a hand may do ---

    Command choose_points() {
        const glm::dvec2 corner{between(0, width), between(0, height)};
        switch (below(6)) {
        case 0:
            return ChangeSelection{one_of({SelectionStep::all, SelectionStep::invert, SelectionStep::grow,
                                           SelectionStep::shrink, SelectionStep::connected})};
        case 1:
            return SelectPointUnder{corner, any_mode(), between(5, 60), below(2) == 0};
        case 2:
            return SelectHandlePoints{any_handle(), any_mode()};
        case 3:
            if (below(4) == 0)
                return ChangeHidden{one_of({HideStep::hide_selected, HideStep::hide_unselected})};
            return ChangeHidden{HideStep::show_all};
        default:
            return SelectRegion{ScreenBox{corner, corner + glm::dvec2(between(20, 250), between(20, 250))},
                                any_mode(), below(2) == 0};
        }
    }

    Command change_handles() {
        const auto any_role = [&] {
            return one_of(
                {HandleRole::fixed, HandleRole::moving, HandleRole::moving, HandleRole::region_of_interest});
        };
        const auto any_handles = [&] { return chosen_with(editor_, any_handle()); };
        switch (below(14)) {
        case 13:
            if (below(2) == 0) return MirrorMoves{};
            return MirrorMoves{static_cast<int>(below(3))};
        case 12:
            return SetPivot{glm::dvec3(between(-1, 1), between(-1, 1), between(-1, 1))};
        case 0:
            return RenameHandle{any_handle(), "name " + std::to_string(below(30))};
        case 1:
            return AssignPoints{any_handle(), any_mode()};
        case 2:
            return ChangeRole{any_handle(), any_role()};
        case 3:
            return ChangeHold{any_handle(), below(2) == 0, below(2) * between(0, 0.5)};
        case 4:
            return ColorHandle{any_handle(), 0x4aa8ffU};
        case 5:
            return DeleteHandles{any_handles()};
        case 6:
            return ResetPoses{any_handles()};
        case 7:
            return MirrorHandle{any_handle(), static_cast<int>(below(3))};
        case 8:
            return ChooseHandle{any_handle()};
        default:
            return MakeHandle{any_role(), ""};
        }
    }

    Command change_settings() {
        SettingsChange change;
        switch (below(8)) {
        case 0:
            change.stiffness = std::pow(10, between(-3, 0));
            break;
        case 1:
            change.poisson = between(-0.5, 0.45);
            break;
        case 2:
            change.iterations = below(5);
            break;
        case 3:
            change.weights = one_of({InfluenceWeights::smooth, InfluenceWeights::paper});
            break;
        case 4:
            change.strays = one_of({Strays::freeze, Strays::carry, Strays::bridge});
            break;
        case 5:
            change.neighbors = 5 + below(4);
            break;
        case 6:
            return ChooseSamples{below(2) == 0};
        default:
            change.samples = std::optional<std::uint64_t>(10 + below(900));
            if (below(8) == 0) change.samples = std::optional<std::uint64_t>();
        }
        return ChangeSettings{change};
    }

    Command go_through_time() {
        switch (below(8)) {
        case 0:
            return RedoStep{true};
        case 1:
            return UndoStep{true};
        case 2:
            return PlayStep{};
        case 3:
            return PacePlaying{between(0.5, 60), below(3) == 0};
        case 4:
            return AdvancePlaying{static_cast<int>(below(7)) - 3};
        case 5:
            return RedoStep{};
        default:
            return UndoStep{};
        }
    }

    void drag() {
        if (!chosen_handle(editor_)) do_now(ChooseHandle{any_handle()});
        if (below(3) == 0) do_now(ChooseAlso{any_handle()});
        glm::dvec3 pivot(between(-1, 1), between(-1, 1), between(-1, 1));
        do_now(BeginDrag{pivot});
        Transform transform;
        transform.pivot = pivot;
        transform.axis = glm::normalize(glm::dvec3(between(-1, 1), between(-1, 1), between(0.1, 1)));
        const glm::dvec3 along(between(-0.2, 0.2), between(-0.2, 0.2), between(-0.2, 0.2));
        const double turn = between(-0.4, 0.4);
        for (unsigned moves = 1 + below(5), k = 1; k <= moves; ++k) {
            transform.angle = turn * k;
            transform.shift = along * static_cast<double>(k);
            if (below(8) == 0) transform.scale = glm::dvec3(between(0.8, 1.2));
            do_now(DragTo{transform});
            pause();
        }
        if (below(6) == 0)
            do_now(CancelDrag{});
        else
            do_now(EndDrag{});
    }

    void pause() {
        switch (below(6)) {
        case 0:
            std::this_thread::sleep_for(std::chrono::milliseconds(below(30)));
            break;
        case 1:
            calm();
            break;
        default:
            break;
        }
        if (below(3) > 0) refresh(editor_);
    }

    void make_handle(HandleRole role) {
        const glm::dvec2 corner{between(0, 0.8 * width), between(0, 0.8 * height)};
        const glm::dvec2 opposite = corner + glm::dvec2(between(30, 300), between(30, 300));
        do_now(SelectRegion{ScreenBox{corner, opposite}, SelectMode::replace, below(3) > 0});
        do_now(MakeHandle{role, ""});
    }

    void do_anything() {
        const unsigned kind = below(24);
        if (kind < 3)
            do_now(choose_points());
        else if (kind < 6)
            make_handle(one_of({HandleRole::fixed, HandleRole::moving, HandleRole::moving}));
        else if (kind < 9)
            do_now(change_handles());
        else if (kind < 16)
            drag();
        else if (kind < 19)
            do_now(change_settings());
        else if (kind < 20)
            do_now(CommitPose{});
        else if (kind < 23)
            do_now(go_through_time());
        else
            do_now(LookAtSide{one_of({Side::front, Side::right, Side::top})});
        pause();
    }

    // --- What must come of it ---

    void calm() {
        wait_until_idle(*editor_.live);
        refresh(editor_);
        refresh(editor_);
        for (const Notice& notice : editor_.notices)
            EXPECT_EQ(notice.words.find(mistake_in_knead), std::string::npos) << notice.words;
        editor_.notices.clear();
    }

    // The shape as it is, and how it is recorded.
    void expect_replay_makes_the_same() {
        live().save_cloud(folder_ / "saved.ply");
        live().save_session(folder_ / "saved.knead");
        calm();
        ReplayOptions options;
        options.out = folder_ / "replayed.ply";
        options.device = "reference";
        SilentProgress silent;
        replay(read_session(folder_ / "saved.knead"), options, silent, [](const std::string&) {});
        EXPECT_EQ(read_text(folder_ / "saved.ply"), read_text(folder_ / "replayed.ply"))
            << read_text(folder_ / "saved.knead");
    }

    // As a crash would leave it now.
    void copy_journal() {
        calm();
        if (looks_back(editor_)) return; // the journal is ahead
        std::filesystem::copy(folder_ / "state", folder_ / "crashed",
                              std::filesystem::copy_options::recursive);
        crashed_ = editor_.frame.positions();
    }
    void expect_restoring_makes_the_same() {
        if (crashed_.empty()) return;
        const std::vector<LostWork> lost = find_lost_work(folder_ / "crashed");
        if (lost.empty()) { // nothing was done
            EXPECT_TRUE(std::ranges::equal(crashed_, editor_.opened.opened->positions));
            return;
        }
        OpenRequest request;
        request.restore = lost.at(0).journal;
        request.device = "reference";
        Editor restored{1};
        open(restored, request);
        ASSERT_TRUE(wait_until([&] { return refresh(restored) && restored.document; }));
        wait_until_idle(*restored.live);
        refresh(restored);
        EXPECT_TRUE(restored.frame.positions() == crashed_) << read_text(lost.at(0).journal);
    }

    LiveDocument& live() { return *editor_.live; }

    std::mt19937_64 chance_{GetParam()};
    ScratchFolder folder_;
    std::filesystem::path file_ = folder_ / "cloud.ply";
    Editor editor_{1};
    LineArray<float> crashed_; // the points when the journal was copied
};

TEST_P(RandomHands, LeaveWhatIsTheSameReplayedRestoredAndRedone) {
    make_handle(HandleRole::fixed);
    make_handle(HandleRole::moving);
    for (unsigned step = 0; step < 30; ++step) do_anything();
    copy_journal();
    for (unsigned step = 0; step < 20; ++step) do_anything();
    calm();
    while (looks_back(editor_) && can_redo(editor_)) do_now(RedoStep{true}), calm();
    expect_replay_makes_the_same();
    const LineArray<float> last = editor_.frame.positions();
    std::size_t steps = 0;
    for (; can_undo(editor_) && steps < 1000; ++steps) do_now(UndoStep{}), calm();
    EXPECT_LT(steps, 1000U);
    const std::span<const float> opened = editor_.opened.opened->positions;
    EXPECT_TRUE(std::ranges::equal(editor_.frame.positions(), opened));
    EXPECT_TRUE(editor_.document->handles.empty());
    for (std::size_t k = 0; k < steps; ++k) do_now(RedoStep{}), calm();
    EXPECT_TRUE(editor_.frame.positions() == last);
    expect_replay_makes_the_same();
    expect_restoring_makes_the_same();
}

unsigned hands() {
    const char* const wanted = std::getenv("KNEAD_RANDOM_HANDS"); // so many, for a long search
    return wanted ? static_cast<unsigned>(std::atoi(wanted)) : 6;
}

INSTANTIATE_TEST_SUITE_P(Many, RandomHands, ::testing::Range(0U, hands()));

} // namespace
} // namespace knead::test
