// What the user hears of handles that ask for more than a shape can give.

#include "edit/handle_demand.h"

#include "edit/editing.h"

namespace knead {
namespace {

using namespace knead::test;

std::string words_of(Desk& desk) {
    SilentProgress progress;
    return words_about_demand(desk.document().demand(progress));
}

HandleDemand demand_of(const std::string& lines) {
    SilentProgress progress;
    Desk desk(bar());
    desk.play(lines);
    EXPECT_LT(desk.handle_error(), 1e-6); // whatever they ask, handles are met
    return desk.document().demand(progress);
}

TEST(HandleDemand, TellsOfTurnsThatAreNotKept) {
    const auto turned = [](int degrees) {
        std::string frames;
        for (int angle = 10; angle <= degrees; angle += 10)
            frames += (frames.empty() ? "" : ",") + turn('z', angle);
        Desk desk(made(Shape::bar, 6000));
        desk.play(ends + R"({"op":"drag","handle":"top","frames":[)" + frames + "]}\n" + settle(1000));
        SilentProgress progress;
        return desk.document().demand(progress);
    };
    EXPECT_TRUE(turned(360).lost.empty()) << "a bar keeps that";
    const HandleDemand lost = turned(700);
    ASSERT_EQ(lost.lost.size(), 1U);
    EXPECT_NEAR(lost.lost[0].asked, 700, 1e-3);
    EXPECT_LT(lost.lost[0].kept, 90);
    EXPECT_SAYS(words_about_demand(lost), "the cloud does not keep the 700° by which \"top\" is turned");
}

TEST(HandleDemand, IsSilentAsLongAsTheShapeCanFollow) {
    for (const std::string& frame :
         {turn('y', 90, "[-1,0,-1]"), turn('z', 135), turn('x', 60),
          std::string(R"({"translate":[2,0,-0.5]})"), std::string(R"({"scale":2})")})
        EXPECT_EQ(words_about_demand(demand_of(ends + drag(frame) + settle(100))), "") << frame;
}

TEST(HandleDemand, TellsOfPullingAndPressing) {
    // The free part of 4 to 16, and to 1.
    const HandleDemand pulled = demand_of(ends + drag(R"({"translate":[0,0,12]})") + settle(100));
    EXPECT_NEAR(pulled.strain.longest, 4, 1.2);
    EXPECT_GT(pulled.strain.shortest, 0.8); // cork: as wide as before
    EXPECT_SAYS(words_about_demand(pulled), "pull the cloud to");
    const HandleDemand pressed = demand_of(ends + drag(R"({"translate":[0,0,-3]})") + settle(100));
    EXPECT_NEAR(pressed.strain.shortest, 0.25, 0.1);
    EXPECT_LT(pressed.strain.longest, 1.3);
    EXPECT_SAYS(words_about_demand(pressed), "press the cloud together to");
}

TEST(HandleDemand, TellsWhichHandlesTearTheCloud) {
    const std::string touching =
        foot +
        R"({"op":"handle","name":"top","role":"moving","region":{"halfspace":{"point":[0,0,-2],"normal":[0,0,1]}}})"
        "\n";
    Desk desk(bar());
    desk.play(touching + drag(R"({"translate":[0,0,0.02]})"));
    EXPECT_EQ(words_of(desk), "") << "apart by a fraction of the spacing";
    desk.play(drag(R"({"translate":[0,0,1]})"));
    EXPECT_SAYS(words_of(desk), "tears between \"foot\" and \"top\"");
    desk.play(undo);
    EXPECT_EQ(words_of(desk), "");
}

TEST(HandleDemand, KnowsTheBorderOfARegion) {
    const std::string region =
        R"({"op":"handle","name":"upper","role":"roi","region":{"halfspace":{"point":[0,0,0],"normal":[0,0,1]}}})"
        "\n";
    const std::string all_of_it =
        R"({"op":"handle","name":"top","role":"moving","region":{"halfspace":{"point":[0,0,0],"normal":[0,0,1]}}})"
        "\n";
    EXPECT_SAYS(words_about_demand(demand_of(region + all_of_it + drag(R"({"translate":[0,0,1]})"))),
                "tears between \"top\" and what lies outside the region");
    EXPECT_EQ(words_about_demand(demand_of(region + top + drag(R"({"translate":[0,0,1]})") + settle(50))),
              "");
}

TEST(HandleDemand, TellsWhereFloatsLieApart) {
    const std::string whole = R"({"op":"handle","name":"top","role":"moving","region":"all"})"
                              "\n";
    Desk desk(bar());
    desk.play(whole + drag(R"({"translate":[100,0,0]})"));
    EXPECT_EQ(words_of(desk), "");
    desk.play(drag(R"({"translate":[0,1e5,0]})"));
    EXPECT_SAYS(words_of(desk), "its points there are rounded to");
}

TEST(HandleDemand, OfNothingPosedIsNothing) {
    Desk desk(bar());
    EXPECT_EQ(words_of(desk), "");
    desk.play(ends + drag(R"({"translate":[0,0,12]})") + commit);
    EXPECT_EQ(words_of(desk), ""); // the shape as committed is the new rest shape
}

} // namespace
} // namespace knead
