// Full disks and read-only ones: every output of the program and of the editor leaves the old files, nothing
// else, and a word.

#include "edit/editing.h"
#include "edit/live_bar.h"
#include "support/child.h"
#include "support/run_knead.h"

#include <fstream>
#include <map>

namespace knead::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* no_mounts = "file systems cannot be mounted here: it takes root or user namespaces";
constexpr std::size_t disk_bytes = std::size_t{1} << 20;

std::map<std::string, std::string> files_in(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        files[entry.path().lexically_relative(folder).string()] =
            entry.is_regular_file() ? read_text(entry.path()) : "";
    return files;
}

// Takes all of the disk but so many bytes, in one file.
void fill(const fs::path& folder, std::size_t but) {
    std::string all(disk_bytes, 'f');
    for (all.resize(all.size() - but); !all.empty(); all.resize(all.size() > 4096 ? all.size() - 4096 : 0)) {
        std::ofstream out(folder / "filler", std::ios::binary);
        if ((out << all).flush()) return;
    }
}

struct Command {
    const char* name;
    std::vector<std::string> arguments;
    bool draws = false;
};

// All ways of the program to a file. They work on bar.ply (1000 points, 27 kB), s.knead, and t.knead, the
// same with a check that is recorded again.
std::vector<Command> commands() {
    return {{"make", {"make", "bar", "--points", "3000", "--out", "out.ply"}},
            {"replay --out", {"replay", "s.knead", "--out", "out.ply"}},
            {"replay --record-checks", {"replay", "t.knead", "--record-checks"}},
            {"both", {"replay", "t.knead", "--record-checks", "--out", "out.ply"}},
            {"render", {"render", "bar.ply", "--out", "out.png"}, true},
            {"replay --picture", {"replay", "s.knead", "--picture", "out.png"}, true},
            {"replay --frames", {"replay", "s.knead", "--frames", "frames"}, true},
            {"replay --frames, new", {"replay", "s.knead", "--frames", "new"}, true}};
}

bool draws_pictures() {
    const Outcome outcome = run_knead({"render", "/nowhere.ply", "--out", "/nowhere.png"});
    return outcome.err.find("built without OpenGL") == std::string::npos;
}

// What is wrong with how the program failed, with old files in its way; empty if nothing is.
std::string complaint(const Command& command, const fs::path& folder, const std::string& wanted) {
    const auto before = files_in(folder);
    const Outcome outcome = run_knead(command.arguments, folder);
    const std::string said = std::string(command.name) + ": " + outcome.err;
    if (outcome.code != 5) return said + "exit " + std::to_string(outcome.code) + "\n";
    if (!outcome.out.empty()) return said + "wrote to stdout\n";
    if (outcome.err.find(wanted) == std::string::npos) return said + "does not say: " + wanted + "\n";
    if (files_in(folder) != before) return said + "changed the folder\n";
    return {};
}

class Disks : public testing::Test {
protected:
    void SetUp() override {
        bar_file(folder_, 1000);
        const std::string first = "{\"knead\":1,\"cloud\":{\"path\":\"bar.ply\"}}\n" + ends + drag(lift),
                          second = commit + drag(turn('y', 20));
        write_text(folder_ / "s.knead", first + second);
        write_text(folder_ / "t.knead", first +
                                            R"({"op":"check","positions":"t-check-1.ply","tolerance":1})"
                                            "\n" +
                                            second);
        fs::create_directory(folder_ / "disk");
    }

    // In a process of its own, with a disk of its own: the session, its cloud, and old files.
    bool lay_out_disk() const {
        const fs::path disk = folder_ / "disk";
        if (!mount_small_disk(disk, disk_bytes)) return false;
        for (const char* name : {"bar.ply", "s.knead", "t.knead"}) fs::copy_file(folder_ / name, disk / name);
        fs::create_directory(disk / "frames");
        for (const char* name : {"out.ply", "out.png", "t-check-1.ply", "frames/frame-000001.png"})
            write_text(disk / name, "old");
        return true;
    }

    const ScratchFolder folder_;
};

TEST_F(Disks, AFullOneLeavesTheOldFilesForEveryCommand) {
    const bool draws = draws_pictures();
    const std::string outcome = in_child([&]() -> std::string {
        if (!lay_out_disk()) return no_mounts;
        fill(folder_ / "disk", 16384);
        std::string complaints;
        for (const Command& command : commands())
            if (draws || !command.draws)
                complaints += complaint(command, folder_ / "disk", "the disk is full");
        return complaints;
    });
    if (outcome == no_mounts) GTEST_SKIP() << no_mounts;
    EXPECT_EQ(outcome, "");
}

TEST_F(Disks, AReadOnlyOneLeavesTheOldFilesForEveryCommand) {
    const bool draws = draws_pictures();
    const std::string outcome = in_child([&]() -> std::string {
        if (!lay_out_disk() || !make_read_only(folder_ / "disk")) return no_mounts;
        std::string complaints;
        for (const Command& command : commands())
            if (draws || !command.draws)
                complaints += complaint(command, folder_ / "disk", "the disk is read-only");
        return complaints;
    });
    if (outcome == no_mounts) GTEST_SKIP() << no_mounts;
    EXPECT_EQ(outcome, "");
}

std::string words_of(LiveDocument& live) {
    std::string words;
    for (const Notice& notice : live.take_notices())
        if (notice.kind == Notice::Kind::error)
            words += notice.words.substr(notice.words.find(": ") + 2) + "\n";
    return words;
}

// What an editor does whose disk fills up: its words, and what is on the disk in the end.
std::string edit_on_full_disk(const fs::path& disk) {
    OpenRequest request = request_for(disk / "bar.ply");
    request.journal_folder = disk / "state";
    LiveDocument live(request);
    wait_until_open(live);
    StepNumber step = 0;
    const auto act = [&](const SessionAction& action) {
        live.post(++step, {action});
        wait_until_idle(live);
    };
    act(bar_handles()[0]);
    act(bar_handles()[1]);
    write_text(disk / "work.knead", "old");
    fill(disk, 0);
    live.save_cloud(disk / "out.ply");
    live.save_session(disk / "work.knead");
    wait_until_idle(live);
    std::string told = words_of(live);
    // So long that it does not fit into what is left of the journal's last block.
    act(RenameLine{"high", std::string(5000, 'h')});
    told += words_of(live);
    told += "acts " + std::to_string(live.view()->acts) + "\n";
    told +=
        "out.ply " + read_text(disk / "out.ply") + ", work.knead " + read_text(disk / "work.knead") + "\n";
    fs::remove(disk / "filler"); // and there is room again
    act(RenameLine{"low", "base"});
    for (const auto& entry : fs::directory_iterator(disk / "state"))
        if (entry.path().extension() == ".knead")
            told += "journal " + std::to_string(read_session(entry.path()).lines.size()) + "\n";
    live.save_cloud(disk / "out.ply");
    wait_until_idle(live);
    told += words_of(live);
    for (const auto& [name, text] : files_in(disk))
        if (name.find("making") != std::string::npos) told += "left " + name + "\n";
    return told;
}

TEST_F(Disks, AnEditorOnAFullOneGoesOnAndItsRecordingCatchesUp) {
    const std::string outcome = in_child([&]() -> std::string {
        if (!lay_out_disk()) return no_mounts;
        return edit_on_full_disk(folder_ / "disk");
    });
    if (outcome == no_mounts) GTEST_SKIP() << no_mounts;
    EXPECT_EQ(outcome,
              "cannot be written: the disk is full; free some space or choose another place\n"
              "cannot be written: the disk is full; free some space or choose another place\n"
              "cannot write the recording: No space left on device. Until it can be, a crash would lose what "
              "you do: save the session (Ctrl+S).\n"
              "acts 3\n"
              "out.ply old, work.knead old\n"
              "journal 4\n");
}

} // namespace
} // namespace knead::test
