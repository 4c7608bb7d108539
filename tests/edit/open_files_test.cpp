// Two editors on one file know of each other.

#include "edit/live_bar.h"
#include "edit/open_files.h"
#include "support/child.h"

#include <csignal>

#include <sys/resource.h>

namespace knead::test {
namespace {

namespace fs = std::filesystem;

// Another editor that has these files open until it is killed.
pid_t begin_editor(const ScratchFolder& folder, const std::vector<fs::path>& files) {
    fs::remove(folder / "ready");
    const pid_t other = begin_child([&] {
        const OpenFiles open(folder / "state", files);
        write_text(folder / "ready", "");
        ::pause();
    });
    EXPECT_TRUE(wait_until([&] { return fs::exists(folder / "ready"); }));
    return other;
}

TEST(OpenFiles, AreKnownToOtherProcessesByAnyNameUntilTheyEnd) {
    const ScratchFolder folder;
    write_text(folder / "cat.ply", "");
    fs::create_symlink("cat.ply", folder / "link.ply");
    const pid_t one = begin_editor(folder, {folder / "cat.ply"});
    const pid_t two = begin_editor(folder, {folder / "dog.ply", folder / "./link.ply"});
    const OpenFiles own(folder / "state", {folder / "cat.ply"});
    const OpenFiles another(folder / "state", {folder / "cat.ply"});
    std::vector<pid_t> both{one, two};
    std::ranges::sort(both);
    for (const fs::path& name : {folder / "cat.ply", folder / "link.ply", folder / "./cat.ply"})
        EXPECT_EQ(own.others_with(name), both);
    EXPECT_EQ(own.others_with(folder / "dog.ply"), std::vector<pid_t>{two});
    EXPECT_TRUE(own.others_with(folder / "bird.ply").empty());
    kill_child(one);
    EXPECT_EQ(own.others_with(folder / "cat.ply"), std::vector<pid_t>{two});
    kill_child(two);
    EXPECT_TRUE(own.others_with(folder / "cat.ply").empty());
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "state/open"), fs::directory_iterator()), 2)
        << "those of this process; what the dead ones left is gone";
}

TEST(OpenFiles, WhereNothingCanBeWrittenNobodyIsTold) {
    const OpenFiles nowhere({}, {"cat.ply"});
    EXPECT_TRUE(nowhere.others_with("cat.ply").empty());
    const OpenFiles no_folder("/proc/nowhere", {"cat.ply"});
    EXPECT_TRUE(no_folder.others_with("cat.ply").empty());
}

TEST(OpenFiles, OnAFullDiskNobodyIsToldHalfAName) {
    const ScratchFolder folder;
    const std::string names = in_child([&] {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{20, 20}; // bytes of a file: writing more is cut short
        ::setrlimit(RLIMIT_FSIZE, &limit);
        const OpenFiles open(folder / "state", {folder / std::string(100, 'n')});
        return std::to_string(
            std::distance(fs::directory_iterator(folder / "state/open"), fs::directory_iterator()));
    });
    EXPECT_EQ(names, "0");
}

std::vector<std::string> warnings_of(LiveDocument& live) {
    std::vector<std::string> words;
    for (const Notice& notice : live.take_notices())
        if (notice.kind == Notice::Kind::warning) words.push_back(notice.words);
    return words;
}

// A request for an editor with the state folder that begin_editor() uses.
OpenRequest request_in(const ScratchFolder& folder, const fs::path& file) {
    OpenRequest request = request_for(file);
    request.journal_folder = folder / "state";
    return request;
}

void expect_one_warning(LiveDocument& live, pid_t other, const std::string& file) {
    const std::vector<std::string> words = warnings_of(live);
    ASSERT_EQ(words.size(), 1U);
    EXPECT_NE(words[0].find("process " + std::to_string(other)), std::string::npos) << words[0];
    EXPECT_NE(words[0].find(file), std::string::npos) << words[0];
}

TEST(TwoEditors, TheSecondIsToldWhenItOpensAndIsNotKeptFromIt) {
    const ScratchFolder folder;
    const fs::path bar = bar_file(folder);
    const pid_t other = begin_editor(folder, {bar});
    {
        LiveDocument live(request_in(folder, bar));
        wait_until_open(live);
        ASSERT_EQ(live.status().stage, LiveDocument::Stage::open);
        expect_one_warning(live, other, "bar.ply");
    }
    kill_child(other);
    LiveDocument live(request_in(folder, bar));
    wait_until_open(live);
    EXPECT_TRUE(warnings_of(live).empty());
}

TEST(TwoEditors, TheFirstIsToldAtItsNextActAndOnce) {
    const ScratchFolder folder;
    const fs::path bar = bar_file(folder);
    write_text(folder / "s.knead", "{\"knead\":1,\"cloud\":{\"path\":\"bar.ply\"}}\n");
    // Begun before the document has its thread; opens when it is told.
    fs::remove(folder / "ready");
    const pid_t other = begin_child([&] {
        while (!fs::exists(folder / "go")) ::usleep(1000);
        const OpenFiles open(folder / "state", {folder / "s.knead", bar});
        write_text(folder / "ready", "");
        ::pause();
    });
    LiveDocument live(request_in(folder, folder / "s.knead"));
    wait_until_open(live);
    StepNumber step = 0;
    live.post(++step, bar_handles());
    wait_until_idle(live);
    EXPECT_TRUE(warnings_of(live).empty());
    write_text(folder / "go", "");
    ASSERT_TRUE(wait_until([&] { return fs::exists(folder / "ready"); }));
    live.save_session(folder / "s.knead");
    wait_until_idle(live);
    expect_one_warning(live, other, "s.knead");
    live.save_session(folder / "s.knead");
    wait_until_idle(live);
    EXPECT_TRUE(warnings_of(live).empty()) << "once is enough";
    kill_child(other);
}

TEST(TwoEditors, WhoSavesOverWhatAnotherHasOpenIsTold) {
    const ScratchFolder folder;
    const fs::path bar = bar_file(folder);
    const pid_t other = begin_editor(folder, {folder / "posed.ply"});
    LiveDocument live(request_in(folder, bar));
    wait_until_open(live);
    live.save_cloud(folder / "mine.ply");
    wait_until_idle(live);
    EXPECT_TRUE(warnings_of(live).empty());
    live.save_cloud(folder / "posed.ply");
    wait_until_idle(live);
    expect_one_warning(live, other, "posed.ply");
    EXPECT_TRUE(fs::exists(folder / "posed.ply"));
    kill_child(other);
}

} // namespace
} // namespace knead::test
