// Sessions of every version open for ever: tests/data holds a set of each. Their checks allow 1 % of the
// diagonal: the mathematics may get better, what a line means may not change.

#include "edit/editing.h"
#include "edit/replay.h"
#include "support/scans.h"

#include <algorithm>
#include <set>

namespace knead::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> stored_sessions() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(in_repository("tests/data/version-1")))
        if (entry.path().extension() == ".knead") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

TEST(Version1, StoredSessionsReplayToTheStoredShapes) {
    std::size_t checks = 0;
    for (const fs::path& file : stored_sessions())
        for (const std::string device : {"reference", ""}) {
            SCOPED_TRACE(file.filename().string() + " on \"" + device + '"');
            ReplayOptions options;
            options.device = device;
            SilentProgress silent;
            const ReplayReport report =
                replay(read_session(file), options, silent, [](const std::string& /*words*/) {});
            EXPECT_GE(report.checks.size(), 1U);
            for (const CheckResult& check : report.checks) EXPECT_TRUE(check.held) << check.words;
            EXPECT_LT(report.handle_error, 1e-5);
            checks += report.checks.size();
        }
    EXPECT_EQ(checks, 2U * 24);
}

// What a set of sessions has in it, in words.
class Seen {
public:
    void note(const Session& session) {
        add_settings(session.settings);
        if (session.points) add("cloud.points");
        if (session.sha256) add("cloud.sha256");
        for (const SessionLine& line : session.lines)
            std::visit([&](const auto& action) { note(action); }, line.action);
    }
    const std::set<std::string>& words() const { return words_; }

private:
    void add(const std::string& word) { words_.insert(word); }

    void add_settings(const Settings& settings) {
        const Settings usual;
        if (settings.neighbors != usual.neighbors) add("header.neighbors");
        if (settings.samples != usual.samples) add("header.samples");
        if (settings.iterations != usual.iterations) add("header.iterations");
        if (settings.stiffness != usual.stiffness) add("header.stiffness");
        if (settings.poisson != usual.poisson) add("header.poisson");
        if (settings.weights != usual.weights) add("header.weights");
        if (settings.strays != usual.strays) add("header.strays");
    }

    void note(const HandleLine& line) {
        add("role " + std::to_string(static_cast<int>(line.role)));
        if (const auto* region = std::get_if<Region>(&line.points))
            add("region " + std::to_string(region->index()));
        else
            for (const IndexRange& range : std::get<std::vector<IndexRange>>(line.points))
                add(range.first == range.last ? "a point" : "a range");
        if (line.free_rotation) add("rotation free");
        if (line.falloff > 0) add("falloff");
        if (line.color) add("color");
        if (line.pivot) add("pivot");
    }
    void note(const DragLine& line) {
        add("drag");
        for (const HandlePose& pose : line.frames) {
            if (pose.translate != Vec3d::Zero()) add("translate");
            if (pose.rotate.coeffs() != Quatd::Identity().coeffs()) add("rotate");
            if (pose.scale != Vec3d::Ones()) add(pose.scale.x() == pose.scale.y() ? "scale" : "scales");
            if (pose.axes.coeffs() != Quatd::Identity().coeffs()) add("axes");
            if (pose.coarse) add("coarse");
        }
    }
    void note(const SettleLine& /*line*/) { add("settle"); }
    void note(const CheckLine& line) { add(line.positions.has_parent_path() ? "check below" : "check"); }
    void note(const CommitLine& /*line*/) { add("commit"); }
    void note(const SetLine& line) {
        const SettingsChange& change = line.change;
        if (change.neighbors) add("set neighbors");
        if (change.samples) add(*change.samples ? "set samples" : "set samples all");
        if (change.iterations) add("set iterations");
        if (change.stiffness) add("set stiffness");
        if (change.poisson) add("set poisson");
        if (change.weights) add("set weights " + std::to_string(static_cast<int>(*change.weights)));
        if (change.strays) add("set strays " + std::to_string(static_cast<int>(*change.strays)));
    }
    void note(const DeleteLine& /*line*/) { add("delete"); }
    void note(const RenameLine& /*line*/) { add("rename"); }
    void note(const UndoLine& /*line*/) { add("undo"); }
    void note(const RedoLine& /*line*/) { add("redo"); }

    std::set<std::string> words_;
};

TEST(Version1, StoredSessionsHaveEverythingThatTheFormatHas) {
    Seen seen;
    for (const fs::path& file : stored_sessions()) seen.note(read_session(file));
    const char* everything[] = {"role 0",
                                "role 1",
                                "role 2",
                                "region 0",
                                "region 1",
                                "region 2",
                                "region 3",
                                "a point",
                                "a range",
                                "rotation free",
                                "falloff",
                                "color",
                                "pivot",
                                "drag",
                                "translate",
                                "rotate",
                                "scale",
                                "scales",
                                "axes",
                                "coarse",
                                "settle",
                                "check",
                                "check below",
                                "commit",
                                "delete",
                                "rename",
                                "undo",
                                "redo",
                                "cloud.points",
                                "cloud.sha256",
                                "header.neighbors",
                                "header.samples",
                                "header.iterations",
                                "header.stiffness",
                                "header.poisson",
                                "header.weights",
                                "header.strays",
                                "set neighbors",
                                "set samples",
                                "set samples all",
                                "set iterations",
                                "set stiffness",
                                "set poisson",
                                "set weights 0",
                                "set strays 0",
                                "set strays 1",
                                "set strays 2"};
    for (const char* one : everything) EXPECT_TRUE(seen.words().contains(one)) << one;
    EXPECT_EQ(std::variant_size_v<SessionAction>, 10U) << "a new kind of line belongs into the stored set";
}

} // namespace
} // namespace knead::test
