// The recorded sessions of data/, replayed as a user would, on every device.

#include "support/run_knead.h"
#include "support/scans.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace knead::test {
namespace {

std::vector<std::filesystem::path> sessions() {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(in_repository("data")))
        if (entry.path().extension() == ".knead") paths.push_back(entry.path());
    std::ranges::sort(paths);
    return paths;
}

std::vector<std::string> devices() {
    std::vector<std::string> names{"auto", "reference"};
    const Outcome outcome = run_knead({"devices", "--json"});
    const auto json = nlohmann::json::parse(outcome.out);
    for (std::size_t i = 0; i < json["devices"].size(); ++i) names.push_back(std::to_string(i));
    return names;
}

TEST(Sessions, OfTheRepositoryHoldOnEveryDevice) {
    const ScratchFolder folder;
    std::size_t checks = 0;
    ASSERT_GE(sessions().size(), 3U);
    for (const auto& session : sessions())
        for (const std::string& device : devices()) {
            SCOPED_TRACE(session.filename().string() + " on " + device);
            const Outcome outcome = run_knead({"replay", session.string(), "--device", device, "--json",
                                               "--out", (folder / "out.ply").string()});
            EXPECT_EQ(outcome.code, 0) << outcome.err;
            if (outcome.code != 0) continue;
            const auto json = nlohmann::json::parse(outcome.out);
            for (const auto& check : json["checks"]) EXPECT_TRUE(check["held"]) << check;
            checks += json["checks"].size();
            EXPECT_LT(json["handle_error"], 1e-5);
            EXPECT_TRUE(std::filesystem::exists(folder / "out.ply"));
        }
    EXPECT_GE(checks, 12U);
}

TEST(Sessions, OfTheRepositoryPassARehearsal) {
    for (const auto& session : sessions())
        EXPECT_EQ(run_knead({"replay", session.string(), "--dry-run"}).code, 0) << session;
}

TEST(Sessions, AreOnACloudThatHangsTogether) {
    const Outcome outcome = run_knead({"info", in_repository("data/creature.ply").string(), "--json"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["components"], 1);
    EXPECT_EQ(json["largest_component"], json["points"]);
}

} // namespace
} // namespace knead::test
