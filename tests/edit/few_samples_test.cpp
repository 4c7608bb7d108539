#include "edit/few_samples.h"

#include "edit/editing.h"

namespace knead {
namespace {

using namespace test;

std::string words_of(const std::string& handles, std::optional<std::uint64_t> samples) {
    Settings settings;
    settings.samples = samples;
    Desk desk(bar(6000), settings);
    desk.play(handles + drag(lift));
    return words_about_few_samples(desk.pipeline());
}

TEST(FewFreeSamples, AreToldOf) {
    const std::string narrow = R"({"op":"handle","name":"foot","role":"fixed","region":)"
                               R"({"halfspace":{"point":[0,0,-0.1],"normal":[0,0,-1]}}})"
                               "\n"
                               R"({"op":"handle","name":"top","role":"moving","region":)"
                               R"({"halfspace":{"point":[0,0,0.1],"normal":[0,0,1]}}})"
                               "\n";
    EXPECT_NE(words_of(narrow, 200).find("where the cloud can move"), std::string::npos);
    EXPECT_NE(words_of(ends + above("around", 1.7), 200), "");
    EXPECT_EQ(words_of(narrow, 5000), "") << "few points to each";
    EXPECT_EQ(words_of(narrow, std::nullopt), "");
    EXPECT_EQ(words_of(ends, 200), "");
    EXPECT_EQ(words_of(ends, 60), "") << "a good part of them is free";
}

} // namespace
} // namespace knead
