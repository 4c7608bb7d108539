// What is left of an act where memory runs out on the way: nothing, and the act can be tried again.

#include "edit/document_acts.h"
#include "edit/editing.h"
#include "no_memory/failing_new.h"

#include <limits>
#include <new>
#include <ostream>
#include <string>
#include <vector>

namespace knead::test {
namespace {

constexpr std::size_t never = std::numeric_limits<std::size_t>::max();

// Large ones are few, and what stages are made of.
constexpr std::size_t large = 10'000;

// A tube that stands on its end, of which handles hold the ends or the middle: most blocks of points are in
// none.
std::vector<float> tube() {
    std::vector<float> positions;
    constexpr int around = 100, along = 200;
    for (int ring = 0; ring < along; ++ring)
        for (int place = 0; place < around; ++place) {
            const double angle = 2 * std::numbers::pi * (place + 0.5 * (ring % 2)) / around;
            positions.push_back(static_cast<float>(std::cos(angle)));
            positions.push_back(static_cast<float>(std::sin(angle)));
            positions.push_back(0.05F * static_cast<float>(ring)); // up to 10
        }
    return positions;
}

std::vector<SessionAction> parsed(const std::vector<std::string>& lines) {
    std::string text = R"({"knead":1,"cloud":{"path":"a.ply"}})";
    for (const std::string& line : lines) text += "\n" + line;
    std::vector<SessionAction> acts;
    Session session = parse_session(text + "\n", "s");
    for (SessionLine& line : session.lines) acts.push_back(std::move(line.action));
    return acts;
}

std::string handle(const std::string& name, const std::string& kind, const std::string& lowest,
                   const std::string& highest) {
    return R"({"op":"handle","name":")" + name + R"(",)" + kind + R"(,"region":{"box":{"min":[-2,-2,)" +
           lowest + R"(],"max":[2,2,)" + highest + "]}}}";
}

const std::vector<SessionAction>& acts() {
    static const std::vector<SessionAction> made = parsed(
        {handle("foot", R"("role":"fixed")", "0", "0.5"), handle("top", R"("role":"moving")", "9.5", "10"),
         R"({"op":"drag","handle":"top","frames":[{"translate":[0,0,0.5]},{"translate":[1,0,0.5]}]})",
         R"({"op":"settle","iterations":3})", R"({"op":"set","stiffness":0.05,"poisson":0.3})",
         R"({"op":"commit"})",
         handle("ring", R"("role":"moving","rotation":"free","falloff":0.6)", "4", "4.5"),
         R"({"op":"drag","handle":"ring","frames":[{"translate":[0.3,0,0]}]})",
         R"({"op":"drag","handle":"top","frames":[{"translate":[0,1,0]}]})", R"({"op":"commit"})",
         R"({"op":"delete","handle":"ring"})", R"({"op":"set","samples":60,"weights":"paper"})",
         R"({"op":"drag","handle":"top","frames":[{"translate":[0,0.5,0]}]})", R"({"op":"undo"})",
         R"({"op":"undo"})", R"({"op":"redo"})"});
    return made;
}

SilentProgress silent;

void carry_out(Document& document, const SessionAction& act) {
    if (std::holds_alternative<UndoLine>(act))
        document.undo("");
    else if (std::holds_alternative<RedoLine>(act))
        document.redo("");
    else
        carry_out_act(document, act, "", silent);
}

Desk desk() {
    Settings settings;
    settings.samples = 100;
    return Desk(make_cloud(tube()), settings, 1); // by one thread allocations come in one order
}

// The shape after each act, where memory is enough.
const std::vector<std::vector<float>>& expected_shapes() {
    static const std::vector<std::vector<float>> shapes = [] {
        std::vector<std::vector<float>> made;
        Desk undisturbed = desk();
        for (const SessionAction& act : acts()) {
            carry_out(undisturbed.document(), act);
            made.push_back(undisturbed.shape());
        }
        return made;
    }();
    return shapes;
}

// Whether the act came about though this allocation failed; `failed` tells whether there was one.
bool comes_about(Document& document, const SessionAction& act, std::size_t after, std::size_t at_least,
                 bool& failed) {
    const FailingNew failing(after, at_least);
    bool done = true;
    try {
        carry_out(document, act);
    } catch (const std::bad_alloc&) {
        done = false;
    } catch (const Error& error) { // of a system
        EXPECT_EQ(error.trouble(), Trouble::numeric) << error.what();
        done = false;
    }
    failed = failing.has_failed();
    return done;
}

// How many acts can be undone, and redone.
std::pair<std::size_t, std::size_t> history_of(Document& document) {
    const auto steps = [](auto&& step) {
        std::size_t done = 0;
        try {
            for (;; ++done) step();
        } catch (const Error&) {
            return done;
        }
    };
    const std::size_t back = steps([&] { document.undo(""); });
    const std::size_t all = steps([&] { document.redo(""); });
    for (std::size_t step = back; step < all; ++step) document.undo("");
    return {back, all - back};
}

// What is undone and can be redone while acts fail: nothing else does it.
const SettingsChange& undone_change() {
    static const SettingsChange change = [] {
        SettingsChange made;
        made.iterations = 9;
        return made;
    }();
    return change;
}

void put_into_future(Document& document) {
    document.change_settings(undone_change(), "");
    document.undo("");
}

// An act that fails leaves the history, and what could be redone; of undo and redo it is another.
void expect_untouched(Document& document, const std::pair<std::size_t, std::size_t>& history,
                      bool has_future) {
    ASSERT_EQ(history_of(document), history);
    if (!has_future) return;
    document.redo("");
    ASSERT_EQ(document.settings().iterations, 9U);
    document.undo("");
}

// Every allocation of short acts, and of long ones fewer and fewer: each try goes on where the last one broke
// off, so all of their stages come to it.
TEST(NoMemory, LeavesEverythingAsItWas) {
    if (!has_own_new) GTEST_SKIP() << "the sanitizers have an operator new of their own";
    expected_shapes();
    Desk disturbed = desk();
    Document& document = disturbed.document();
    std::size_t tries = 0;
    for (std::size_t k = 0; k < acts().size(); ++k) {
        SCOPED_TRACE("act " + std::to_string(k));
        const bool goes_back =
            std::holds_alternative<UndoLine>(acts()[k]) || std::holds_alternative<RedoLine>(acts()[k]);
        if (!goes_back) put_into_future(document);
        const auto history = history_of(document);
        for (std::size_t after = 0;; after += 1 + after / 30) {
            bool failed = false;
            const bool done = comes_about(document, acts()[k], after, 0, failed);
            if (done && !failed) break;
            ++tries;
            if (done) { // what failed only spares time
                ASSERT_TRUE(same_bits(disturbed.shape(), expected_shapes()[k])) << after;
                if (goes_back) break;
                document.undo("");
                put_into_future(document);
            }
            ASSERT_NO_FATAL_FAILURE(expect_untouched(document, history, !goes_back)) << after;
        }
        ASSERT_TRUE(same_bits(disturbed.shape(), expected_shapes()[k]));
    }
    EXPECT_GT(tries, 400U);
}

// How many large allocations an act makes, after those before it.
std::size_t large_allocations_of(std::size_t act) {
    Desk undisturbed = desk();
    for (std::size_t k = 0; k < act; ++k) carry_out(undisturbed.document(), acts()[k]);
    const FailingNew counting(never, large);
    carry_out(undisturbed.document(), acts()[act]);
    return counting.counted();
}

// Most of the first ones make what no handle has a part in; of the later ones this is every one, or one in so
// many.
struct Tried {
    std::size_t act, every;
};
// The name of the test.
void PrintTo(const Tried& tried, std::ostream* out) {
    *out << "act " << tried.act;
}

class NoMemoryIn : public testing::TestWithParam<Tried> {};

// One of the large allocations fails, the act is tried again at once, and others follow. So for acts that
// make most of the stages: all of them, for more handles, for other samples.
TEST_P(NoMemoryIn, AnActLeavesNoStageHalfMade) {
    if (!has_own_new) GTEST_SKIP() << "the sanitizers have an operator new of their own";
    const auto [act, every] = GetParam();
    const std::size_t all = large_allocations_of(act);
    ASSERT_GT(all, 10U);
    std::size_t tries = 0;
    for (std::size_t after = 0; after < all; after += after < 2 * all / 3 ? 10 : every) {
        SCOPED_TRACE("without the large allocation " + std::to_string(after));
        Desk disturbed = desk();
        Document& document = disturbed.document();
        for (std::size_t k = 0; k < act; ++k) carry_out(document, acts()[k]);
        bool failed = false;
        if (!comes_about(document, acts()[act], after, large, failed)) carry_out(document, acts()[act]);
        ASSERT_TRUE(failed);
        ASSERT_TRUE(same_bits(disturbed.shape(), expected_shapes()[act]));
        const bool all_that_follow = ++tries % 16 == 0;
        for (std::size_t k = act + 1; all_that_follow && k < acts().size(); ++k) {
            carry_out(document, acts()[k]);
            ASSERT_TRUE(same_bits(disturbed.shape(), expected_shapes()[k])) << "act " << k;
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Each, NoMemoryIn, testing::Values(Tried{2, 1}, Tried{7, 3}, Tried{12, 5}));

} // namespace
} // namespace knead::test
