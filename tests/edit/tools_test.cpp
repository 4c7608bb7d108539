// What interrupts the tools.

#include "edit/tools_bench.h"

namespace knead {
namespace {

using namespace test;

TEST(Tools, DropEverythingWhenTheWindowLosesTheHand) {
    Bench bench;
    bench.add_gizmo();
    bench.hit('G');
    bench.move({90, 90});
    drop_everything(bench.tools, bench.commands);
    EXPECT_TRUE(is<CancelDrag>(bench.commands.back()));
    bench.press({90, 90}, plain, MouseButton::middle);
    drop_everything(bench.tools, bench.commands);
    EXPECT_EQ(bench.tools.doing, Doing::nothing);
    bench.press({90, 90});
    drop_everything(bench.tools, bench.commands);
    EXPECT_TRUE(bench.tools.band.empty());
    EXPECT_EQ(bench.commands.size(), 3U);
}

TEST(Tools, ADragThatWasTakenAwayIsOver) {
    Bench bench;
    bench.add_gizmo();
    bench.hit('G');
    bench.tools.drag.reset(); // as another cloud is opened
    bench.move({90, 90});
    EXPECT_EQ(bench.tools.doing, Doing::nothing);
}

} // namespace
} // namespace knead
