// kill -9 at random moments of saves: every file is the old one or the new one, whole, and what a killed save
// left is gone after the next.
//
// KNEAD_KILLS says how often each kind of save is killed (default 8, so that the suite stays quick):
//     KNEAD_KILLS=250 build/tests/test_robustness --gtest_filter='Kills.*'

#include "base/stopwatch.h"
#include "edit/editing.h"
#include "edit/live_bar.h"
#include "edit/live_recording.h"
#include "support/child.h"
#include "support/run_knead.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <set>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace knead::test {
namespace {

namespace fs = std::filesystem;

int tries() {
    const char* wanted = std::getenv("KNEAD_KILLS");
    return wanted ? std::max(1, std::atoi(wanted)) : 8;
}

class Kills : public testing::Test {
protected:
    // Kills what `begin` begins after a random while of up to `longest` seconds, counted from when it is
    // `ready`.
    void kill_one(
        const std::function<pid_t()>& begin, double longest,
        const std::function<bool()>& ready = [] { return true; }) {
        const pid_t child = begin();
        wait_until(ready);
        std::uniform_real_distribution<double> wait(0, longest);
        ::usleep(static_cast<useconds_t>(wait(random_) * 1e6));
        if (kill_child(child)) ++killed_;
    }

    // One line of the table.
    void tell(const char* what, const std::string& outcome) const {
        std::printf("[  KILLS   ] %-28s %4d tries, %4d killed at work: %s\n", what, tries(), killed_,
                    outcome.c_str());
    }

    std::set<std::string> names(const fs::path& folder) const {
        std::set<std::string> all;
        for (const auto& entry : fs::directory_iterator(folder)) all.insert(entry.path().filename().string());
        return all;
    }

    // How many temporaries lie there.
    std::size_t left_in(const fs::path& folder) const {
        const std::set<std::string> all = names(folder);
        return static_cast<std::size_t>(std::ranges::count_if(
            all, [](const std::string& name) { return name.find(".knead-making") != std::string::npos; }));
    }

    const ScratchFolder folder_;
    std::mt19937 random_{20};
    int killed_ = 0;
};

// --- Saves in a loop, so that every kill meets one

TEST_F(Kills, OfSavesOfACloudAndASession) {
    SilentProgress silent;
    const PointCloud cloud = bar(60'000);
    std::vector<float> moved = cloud.positions;
    for (float& coordinate : moved) coordinate += 1;
    const fs::path target = folder_ / "cloud.ply", session = folder_ / "work.knead";
    const auto recording = [&](std::size_t acts) {
        Session header;
        header.cloud = target;
        LiveRecording made(header, std::nullopt);
        for (std::size_t i = 0; i < acts; ++i) made.add(made.coming(CommitLine{}, false, {}));
        return made;
    };
    LiveRecording few = recording(10), many = recording(5000);
    const auto save = [&](bool second) {
        write_cloud(target, cloud, second ? PosedShape{moved, {}, {}} : PosedShape{}, silent);
        (second ? many : few).save(session);
    };
    std::set<std::string> clouds, sessions;
    for (const bool second : {true, false}) {
        save(second);
        clouds.insert(read_text(target));
        sessions.insert(read_text(session));
    }
    ASSERT_EQ(clouds.size() + sessions.size(), 4U);

    int broken = 0, changed = 0;
    std::size_t left = 0;
    std::string before = read_text(target);
    for (int i = 0; i < tries(); ++i) {
        kill_one(
            [&] {
                return begin_child([&] {
                    for (bool second = true;; second = !second) save(second);
                });
            },
            0.1);
        const std::string now = read_text(target);
        if (!clouds.contains(now) || !sessions.contains(read_text(session))) ++broken;
        if (now != before) ++changed;
        before = now;
        left += left_in(folder_.path());
        EXPECT_LE(left_in(folder_.path()), 2U) << "a save clears away what the one before it left";
    }
    save(false);
    EXPECT_EQ(names(folder_.path()), (std::set<std::string>{"cloud.ply", "work.knead"}));
    EXPECT_EQ(broken, 0);
    EXPECT_EQ(killed_, tries());
    tell("save a cloud and a session", std::to_string(broken) + " broken, " + std::to_string(changed) +
                                           " changed the cloud, " + std::to_string(left) +
                                           " left a temporary, 0 temporaries after the next save");
}

// --- The program

// Begins the program as it is, to be killed.
pid_t begin_knead(const std::vector<std::string>& arguments, const fs::path& folder) {
    return begin_child([&] {
        const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
        ::dup2(nowhere, STDOUT_FILENO);
        ::dup2(nowhere, STDERR_FILENO);
        const std::string binary = knead_binary().string();
        std::vector<std::string> words{binary};
        words.insert(words.end(), arguments.begin(), arguments.end());
        std::vector<char*> pointers;
        pointers.reserve(words.size() + 1);
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        if (::chdir(folder.c_str()) == 0) ::execv(binary.c_str(), pointers.data());
        ::_exit(127);
    });
}

TEST_F(Kills, OfAReplayThatSavesItsShapeAndItsChecks) {
    const fs::path bar_path = bar_file(folder_, 5000);
    const auto check = [](int number) { // that is recorded again
        return R"({"op":"check","positions":"s-check-)" + std::to_string(number) +
               ".ply\",\"tolerance\":0.5}\n";
    };
    const std::string session = "{\"knead\":1,\"cloud\":{\"path\":\"bar.ply\"}}\n" + ends + drag(lift) +
                                check(1) + commit + drag(turn('y', 20)) + check(2);
    const std::vector<std::string> arguments{"replay",          "s.knead",  "--out",     "out.ply",
                                             "--record-checks", "--device", "reference", "--samples=100"};
    const std::set<std::string> finished{"bar.ply", "out.ply", "s-check-1.ply", "s-check-2.ply", "s.knead"};
    write_text(folder_ / "s.knead", session);
    Stopwatch clock;
    ASSERT_EQ(run_knead(arguments, folder_.path()).code, 0);
    const double usual = clock.seconds();
    std::map<std::string, std::string> made;
    for (const std::string& name : finished) made[name] = read_text(folder_ / name);

    const auto begin_anew = [&] {
        for (const std::string& name : finished)
            if (name != "bar.ply") write_text(folder_ / name, "old");
        write_text(folder_ / "s.knead", session);
    };
    int broken = 0, all_new = 0;
    for (int i = 0; i < tries(); ++i) {
        begin_anew();
        kill_one([&] { return begin_knead(arguments, folder_.path()); }, 1.2 * usual);
        bool is_new = true;
        for (const std::string& name : finished) {
            const std::string old = name == "s.knead" ? session : name == "bar.ply" ? made[name] : "old";
            const std::string now = read_text(folder_ / name);
            if (now != old && now != made[name]) ++broken;
            is_new &= now == made[name];
        }
        if (is_new) ++all_new;
    }
    begin_anew();
    ASSERT_EQ(run_knead(arguments, folder_.path()).code, 0);
    EXPECT_EQ(names(folder_.path()), finished);
    EXPECT_EQ(broken, 0);
    tell("replay --out --record-checks",
         std::to_string(broken) + " broken, " + std::to_string(all_new) + " were done before");
}

// --- The recording that is always on

// Acts for ever, and counts those whose end was seen.
void edit_for_ever(const OpenRequest& request, std::atomic<std::size_t>& finished) {
    LiveDocument live(request);
    wait_until_open(live);
    StepNumber step = 0;
    for (const SessionAction& handle : bar_handles()) live.post(++step, {handle});
    for (int k = 1;; ++k) {
        live.begin_drag(++step, "high", {0, 0, 2});
        live.drag_to(turned(0.02 * k));
        live.end_drag();
        SettingsChange change;
        change.iterations = 1U + static_cast<unsigned>(k % 5);
        live.post(++step, {SetLine{change}});
        if (k % 3 == 0) live.undo(step);
        if (k % 7 == 0) live.post(++step, {CommitLine{}});
        wait_until([&] {
            finished = live.view()->acts;
            return !live.status().busy;
        });
    }
}

TEST_F(Kills, OfAnEditorLoseNoFinishedAct) {
    OpenRequest request = request_for(bar_file(folder_, 300));
    request.journal_folder = folder_ / "state";
    request.threads = 1;
    void* shared = ::mmap(nullptr, sizeof(std::atomic<std::size_t>), PROT_READ | PROT_WRITE,
                          MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(shared, MAP_FAILED);
    auto& finished = *new (shared) std::atomic<std::size_t>(0);
    int lost_acts = 0, torn = 0, restored = 0;
    std::size_t most = 0;
    for (int i = 0; i < tries(); ++i) {
        finished = 0;
        // Every fourth time at any moment, else at work.
        kill_one([&] { return begin_child([&] { edit_for_ever(request, finished); }); }, 0.4,
                 [&] { return i % 4 == 0 || finished > 0; });
        const std::vector<LostWork> lost = find_lost_work(folder_ / "state");
        const std::size_t seen = finished;
        most = std::max(most, seen);
        bool dropped = false;
        const std::size_t found =
            lost.empty() ? 0 : recovered_session(lost.front().journal, dropped).lines.size();
        if (lost.size() > 1 || found < seen) ++lost_acts;
        if (lost.empty()) continue;
        if (!read_text(lost.front().journal).ends_with('\n')) ++torn;
        if (i % 8 == 0) { // opens again, with all of them
            ++restored;
            const std::string acts = in_child([&] {
                OpenRequest restore = request;
                restore.restore = lost.front().journal;
                LiveDocument live(restore);
                wait_until_open(live);
                return live.view() ? std::to_string(live.view()->acts) : "not open";
            });
            EXPECT_EQ(acts, std::to_string(found));
        }
        fs::remove(lost.front().journal);
    }
    ::munmap(shared, sizeof(std::atomic<std::size_t>));
    EXPECT_EQ(lost_acts, 0);
    EXPECT_GT(most, 2U) << "the kills came before anything was done";
    tell("the editor's recording", std::to_string(lost_acts) + " lost an act, " + std::to_string(torn) +
                                       " ended in a torn line, up to " + std::to_string(most) + " acts, " +
                                       std::to_string(restored) + " opened again");
}

} // namespace
} // namespace knead::test
