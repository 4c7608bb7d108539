// The recorded sessions of data/ and data/regression/, replayed as a user would, on every device.

#include "support/run_knead.h"
#include "support/scans.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace knead::test {
namespace {

std::vector<std::filesystem::path> sessions_in(const std::string& folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(in_repository(folder)))
        if (entry.path().extension() == ".knead") paths.push_back(entry.path());
    std::ranges::sort(paths);
    return paths;
}

std::vector<std::filesystem::path> all_sessions() {
    std::vector<std::filesystem::path> paths = sessions_in("data");
    std::ranges::copy(sessions_in("data/regression"), std::back_inserter(paths));
    return paths;
}

// What --device takes on this machine ("auto" is one of them).
std::vector<std::string> devices() {
    std::vector<std::string> names{"reference"};
    const auto json = nlohmann::json::parse(run_knead({"devices", "--json"}).out);
    for (std::size_t i = 0; i < json["devices"].size(); ++i) names.push_back(std::to_string(i));
    return names;
}

// Replays a session, whose checks must hold; what it said.
nlohmann::json replayed(const std::filesystem::path& session, const std::string& device) {
    SCOPED_TRACE(session.filename().string() + " on " + device);
    const ScratchFolder folder;
    const Outcome outcome = run_knead(
        {"replay", session.string(), "--device", device, "--json", "--out", (folder / "out.ply").string()});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    if (outcome.code != 0) return {};
    auto json = nlohmann::json::parse(outcome.out);
    for (const auto& check : json["checks"]) EXPECT_TRUE(check["held"]) << check;
    EXPECT_LT(json["handle_error"], 1e-5);
    EXPECT_TRUE(std::filesystem::exists(folder / "out.ply"));
    return json;
}

TEST(Sessions, OfTheRepositoryHoldOnEveryDevice) {
    std::size_t checks = 0;
    ASSERT_GE(sessions_in("data").size(), 3U);
    for (const auto& session : sessions_in("data"))
        for (const std::string& device : devices()) checks += replayed(session, device)["checks"].size();
    EXPECT_GE(checks, 6 * devices().size());
}

// What a session of data/regression/ makes knead say; the others leave it silent.
const std::map<std::string, std::vector<std::string>> said_by{
    {"handle-inside-handle", {"tears between \"head\" and \"ears\""}},
    {"impossible-interleaved", {"tears between \"odd\" and \"even\""}},
    {"impossible-pull", {"times its length"}},
    {"impossible-push", {"together to"}},
    {"impossible-side-by-side", {"tears between \"lower\" and \"upper\""}},
    {"strays-bridge", {"too far"}},
    {"strays-carry", {"follows the nearest part", "has nothing that stays"}},
    {"strays-freeze", {"stays where it is", "has nothing that stays"}}};

TEST(Sessions, OfTheRegressionSuiteHoldAndSayWhatTheyShould) {
    ASSERT_GE(sessions_in("data/regression").size(), 27U);
    for (const auto& session : sessions_in("data/regression")) {
        SCOPED_TRACE(session.filename().string());
        const auto expected = said_by.find(session.stem().string());
        for (const std::string& device : devices()) {
            const auto json = replayed(session, device);
            EXPECT_GE(json["checks"].size(), 1U);
            const std::size_t words = expected == said_by.end() ? 0 : expected->second.size();
            ASSERT_EQ(json["warnings"].size(), words) << json["warnings"];
            for (std::size_t i = 0; i < words; ++i)
                EXPECT_NE(json["warnings"][i].get<std::string>().find(expected->second[i]), std::string::npos)
                    << json["warnings"][i];
        }
    }
}

// What is recorded must be worth keeping: 50, 200 and 1000 samples beside all of them, rms over D (the aims
// of `knead evaluate`).
TEST(Sessions, OfTheRegressionSuiteDoNotShowTheNumberOfSamples) {
    const double aims[] = {0.009, 0.0045, 0.002};
    for (const std::string name :
         {"samples-tube-bent", "samples-bar-twisted", "samples-sheet-shifted", "samples-creature-arm"})
        for (std::size_t i = 0; i < std::size(aims); ++i) {
            const auto check = [&](std::size_t number) {
                return in_repository("data/regression/" + name + "-check-" + std::to_string(number) + ".ply")
                    .string();
            };
            const Outcome outcome = run_knead({"diff", check(i + 1), check(std::size(aims) + 1), "--json"});
            ASSERT_EQ(outcome.code, 0) << outcome.err;
            EXPECT_LT(nlohmann::json::parse(outcome.out)["rms"], aims[i]) << name << " " << i;
        }
}

TEST(Sessions, OfTheRepositoryPassARehearsal) {
    for (const auto& session : all_sessions())
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
