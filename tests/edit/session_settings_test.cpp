// Settings of --set, and telling sessions from clouds.

#include "base/error.h"
#include "edit/session.h"
#include "support/comparing.h"

#include <gtest/gtest.h>

namespace knead {
namespace {

std::string refusal_of_setting(const std::string& assignment) {
    try {
        parse_setting(assignment);
    } catch (const Error& error) {
        EXPECT_EQ(error.trouble(), Trouble::usage);
        return error.what();
    }
    return "accepted";
}

TEST(SettingOfTheCommandLine, TakesJsonAndBareWords) {
    EXPECT_EQ(parse_setting("neighbors=8").neighbors, 8U);
    EXPECT_EQ(parse_setting("samples=2000").samples.value(), 2000U);
    EXPECT_FALSE(parse_setting("samples=all").samples.value().has_value());
    EXPECT_FALSE(parse_setting("samples=\"all\"").samples.value().has_value());
    EXPECT_EQ(parse_setting("stiffness=2e-2").stiffness, 0.02);
    EXPECT_EQ(parse_setting("weights=paper").weights, InfluenceWeights::paper);
    EXPECT_EQ(parse_setting("strays=freeze").strays, Strays::freeze);
    EXPECT_FALSE(parse_setting("strays=freeze").poisson.has_value());
}

TEST(SettingOfTheCommandLine, RefusesTheRestAsUsage) {
    EXPECT_SAYS(refusal_of_setting("samples"), "a setting is written key=value");
    EXPECT_SAYS(refusal_of_setting("=3"), "a setting is written key=value");
    EXPECT_SAYS(refusal_of_setting(""), "a setting is written key=value");
    EXPECT_SAYS(refusal_of_setting("sample=3"),
                "sample=3: there is no setting \"sample\"; there are neighbors, samples");
    EXPECT_SAYS(refusal_of_setting("op=set"), "there is no setting \"op\"");
    EXPECT_SAYS(refusal_of_setting("neighbors=1"),
                "neighbors=1: \"neighbors\" must be a whole number, 2 to 64, not 1");
    EXPECT_SAYS(refusal_of_setting("stiffness="), "\"stiffness\" must be a number, not \"\"");
    EXPECT_SAYS(refusal_of_setting("stiffness=1e999"), "\"stiffness\" must be a number");
    EXPECT_SAYS(refusal_of_setting("stiffness=\xFF"), "\"stiffness\" must be a number");
}

TEST(Settings, ChangeOnlyWhatIsGiven) {
    Settings settings;
    settings.neighbors = 9;
    SettingsChange change;
    EXPECT_EQ(changed(settings, change), settings);
    change.samples = std::optional<std::uint64_t>();
    change.poisson = 0.25;
    const Settings result = changed(settings, change);
    EXPECT_EQ(result.neighbors, 9U);
    EXPECT_FALSE(result.samples.has_value());
    EXPECT_EQ(result.poisson, 0.25);
    EXPECT_EQ(result.iterations, 3U);
}

TEST(LooksLikeSession, GoesByContent) {
    EXPECT_TRUE(looks_like_session(R"({"knead":1,"cloud":{"path":"a.ply"}})"));
    EXPECT_TRUE(looks_like_session("\xEF\xBB\xBF\r\n  { \"cloud\":{\"path\":\"knead\"}, \"knead\" : 99"));
    EXPECT_FALSE(looks_like_session(""));
    EXPECT_FALSE(looks_like_session("ply\ncomment {\"knead\":1}"));
    EXPECT_FALSE(looks_like_session("{\"title\":\"knead\"}"));
    EXPECT_FALSE(looks_like_session("{" + std::string(2000, ' ') + R"("knead":1})"));
}

} // namespace
} // namespace knead
