// What handles that scale do to what is beyond them.

#include "edit/editing.h"

namespace knead {
namespace {

using namespace knead::test;

// What is stretched in its middle sends its free end as far as the middle grew, and no further: links that
// lie half on the handle are not stretched along.
TEST(Scaling, PushesWhatIsBeyondByWhatTheHandleGrows) {
    const std::string foot = R"({"op":"handle","name":"foot","role":"fixed",)"
                             R"("region":{"halfspace":{"point":[0,0,-2.3],"normal":[0,0,-1]}}})"
                             "\n";
    const std::string middle = R"({"op":"handle","name":"middle","role":"moving",)"
                               R"("region":{"box":{"min":[-2,-2,-0.3],"max":[2,2,0.3]}}})"
                               "\n";
    for (const std::uint64_t samples : {200U, 1000U}) {
        Settings settings;
        settings.samples = samples;
        Desk desk(made(Shape::cylinder, 10'000), settings);
        desk.play(foot + middle +
                  R"({"op":"drag","handle":"middle","pivot":[0,0,0],"frames":[{"scale":[1,1,3]}]})"
                  "\n" +
                  settle(100));
        const double rise = farthest(
            desk, [](const Vec3d& p) { return p.z() > 2.4; }, [](const Vec3d& p) { return p; });
        // With half of each link beside it growing along it would be .8 and .68.
        EXPECT_NEAR(rise, 0.6, 0.03) << samples << " samples";
    }
}

// Where both ends stay, as much is pressed together as the middle grew.
TEST(Scaling, IsAlikeForAnyNumberOfSamples) {
    std::vector<float> with_most;
    for (const std::uint64_t samples : {4000U, 200U}) {
        Settings settings;
        settings.samples = samples;
        Desk desk(bar(10'000), settings);
        desk.play(foot +
                  R"({"op":"handle","name":"top","role":"moving","region":{"box":)"
                  R"({"min":[-2,-2,1.5],"max":[2,2,3]}}})"
                  "\n" +
                  drag(R"({"scale":2})") + settle(100));
        const std::vector<float> posed = desk.shape();
        if (with_most.empty()) with_most = posed;
        double square = 0;
        for (std::size_t i = 0; i < posed.size(); ++i)
            square += std::pow(double{posed[i]} - double{with_most[i]}, 2);
        EXPECT_LT(std::sqrt(3 * square / static_cast<double>(posed.size())) / desk.diagonal(), 0.004);
    }
}

} // namespace
} // namespace knead
