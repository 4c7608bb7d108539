// How strongly handles pull.

#include "edit/falloffs.h"

#include <gtest/gtest.h>

namespace knead {
namespace {

TEST(Falloffs, PullNoStrongerWhereASampleAlmostCoincidesWithWhatIsHeld) {
    SampleRest rest;
    rest.graph.first = {0, 2, 4, 6};
    rest.graph.neighbor = {1, 2, 0, 2, 0, 1};
    rest.weight.assign(6, 1);
    rest.position = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}};
    rest.handle.assign(3, no_index);
    const auto pull_at = [&](double way) {
        const Pulled pulled{0, 0, way, 0.5, 0, no_index};
        const std::vector<SoftHold> holds =
            soft_holds({Handle{}}, {&pulled, 1}, {rest.position.data(), 1}, rest);
        return holds.size() == 1 ? holds[0].weight : 0;
    };
    EXPECT_GT(pull_at(0.02), 2 * pull_at(0.04));
    EXPECT_GT(pull_at(1e-4), pull_at(0.02));
    EXPECT_NEAR(pull_at(0), pull_at(1e-4), 1e-3 * pull_at(1e-4));
}

} // namespace
} // namespace knead
