// Undo and redo bring back every bit, and a cancelled act leaves none behind.

#include "edit/editing.h"

namespace knead {
namespace {

using namespace test;

const std::string bend = drag(turn('y', 30) + "," + turn('y', 60, "[0.3,0,0]"));
const std::string twist = drag(turn('z', 40) + "," + turn('z', 80) + "," + turn('z', 120));

std::vector<float> shape_after(const std::string& lines) {
    Desk desk(bar());
    desk.play(lines);
    return desk.shape();
}

TEST(History, ADragAfterAnUndoneOneStartsFromTheSameWarmState) {
    EXPECT_TRUE(same_bits(shape_after(ends + bend + twist + undo + twist), shape_after(ends + bend + twist)));
    EXPECT_TRUE(same_bits(shape_after(ends + twist + undo + bend + twist), shape_after(ends + bend + twist)));
    EXPECT_TRUE(
        same_bits(shape_after(ends + bend + settle(9) + undo + twist), shape_after(ends + bend + twist)));
}

// What an elastic material was stretched to in an undone act must not be where the next one starts.
TEST(History, ASettlingAfterAnUndoneOneHasTheSameBitsInAnElasticMaterial) {
    const std::string cork = set(R"("poisson":0.3)") + ends + bend;
    EXPECT_TRUE(same_bits(shape_after(cork + settle(9) + undo + settle(2)), shape_after(cork + settle(2))));
    EXPECT_TRUE(same_bits(shape_after(cork + twist + undo + settle(2)), shape_after(cork + settle(2))));
}

TEST(History, UndoBringsBackEveryShapeAndRedoRepeatsIt) {
    const std::string acts[] = {ends,
                                bend,
                                set(R"("stiffness":0.05,"weights":"paper")"),
                                settle(7),
                                R"({"op":"rename","handle":"top","to":"hat"})",
                                commit,
                                set(R"("samples":200)"),
                                drag(turn('x', 50), "hat"),
                                commit,
                                R"({"op":"delete","handle":"foot"})",
                                drag(lift, "hat")};
    Desk desk(bar());
    std::vector<std::vector<float>> shapes;
    for (const std::string& act : acts) {
        desk.play(act);
        shapes.push_back(desk.shape());
    }
    for (std::size_t i = shapes.size() - 1; i > 0; --i) {
        desk.play(undo);
        EXPECT_TRUE(same_bits(desk.shape(), shapes[i - 1])) << "undoing " << acts[i];
    }
    for (std::size_t i = 1; i < shapes.size(); ++i) {
        desk.play(redo);
        EXPECT_TRUE(same_bits(desk.shape(), shapes[i])) << "redoing " << acts[i];
    }
}

TEST(History, AnUndoneCommitLeavesThePoseToGoOnFrom) {
    EXPECT_TRUE(
        same_bits(shape_after(ends + bend + commit + undo + twist), shape_after(ends + bend + twist)));
    EXPECT_TRUE(same_bits(shape_after(ends + bend + commit + undo + redo + twist),
                          shape_after(ends + bend + commit + twist)));
    EXPECT_TRUE(same_bits(shape_after(ends + bend + commit + twist + undo + undo + undo + twist),
                          shape_after(ends + twist)));
}

// Few samples ask the points between them, what these stand for, and which territories touch: on the rest
// shape of the time, whatever was looked at before.
TEST(History, NothingIsLeftOfAnotherRestShapeOrOfOtherSamples) {
    for (const char* samples : {"60", "300"}) {
        const std::string begin = set("\"samples\":" + std::string(samples)) + ends;
        const std::string bent = begin + bend, rested = bent + commit;
        EXPECT_TRUE(same_bits(shape_after(rested + twist + undo + undo + twist), shape_after(bent + twist)))
            << samples;
        EXPECT_TRUE(same_bits(shape_after(rested + twist + commit + bend + undo + undo + undo + twist),
                              shape_after(rested + twist)))
            << samples;
        EXPECT_TRUE(same_bits(shape_after(rested + set(R"("neighbors":9)") + twist + undo + undo + twist),
                              shape_after(rested + twist)))
            << samples;
        EXPECT_TRUE(same_bits(shape_after(rested + set(R"("samples":90)") + twist + undo + undo + twist),
                              shape_after(rested + twist)))
            << samples;
    }
}

// In all that was made ready for another value.
TEST(History, ASettingThatIsChangedIsAsIfItHadBeenSoFromTheStart) {
    const std::string coarsely = drag(coarse(turn('z', 40)) + "," + coarse(turn('z', 80)));
    for (const char* samples : {"300", "1000"})
        for (const char* setting : {R"("weights":"paper")", R"("poisson":0.4)", R"("stiffness":0.1)"}) {
            const std::string begin = set("\"samples\":" + std::string(samples)) + ends;
            EXPECT_TRUE(same_bits(shape_after(begin + bend + undo + set(setting) + twist),
                                  shape_after(begin + set(setting) + twist)))
                << samples << ", " << setting;
            EXPECT_TRUE(same_bits(shape_after(begin + bend + undo + set(setting) + coarsely),
                                  shape_after(begin + set(setting) + coarsely)))
                << samples << ", " << setting;
        }
}

TEST(History, TakesBackHandlesSettingsAndNames) {
    Desk desk(bar());
    desk.play(ends + set(R"("samples":77)") + R"({"op":"rename","handle":"top","to":"hat"})" +
              "\n"
              R"({"op":"delete","handle":"foot"})");
    desk.play(undo);
    EXPECT_EQ(desk.document().handles().size(), 2U);
    desk.play(undo);
    EXPECT_EQ(desk.document().handles()[1].name, "top");
    desk.play(undo);
    EXPECT_EQ(desk.document().settings().samples, 1000U);
    desk.play(undo + undo);
    EXPECT_TRUE(desk.document().handles().empty());
    EXPECT_SAYS(refusal(desk, undo), "s:1: there is nothing to undo");
    desk.play(redo + redo + redo + redo + redo);
    EXPECT_EQ(desk.document().handles().size(), 1U);
    EXPECT_EQ(desk.document().settings().samples, 77U);
    EXPECT_SAYS(refusal(desk, redo), "s:1: there is nothing to redo");
}

TEST(History, ANewActForgetsWhatWasUndone) {
    Desk desk(bar());
    desk.play(ends + bend + undo + twist);
    EXPECT_SAYS(refusal(desk, redo), "nothing to redo");
}

TEST(History, ARefusedActIsNoPartOfIt) {
    Desk desk(bar());
    desk.play(ends + bend);
    EXPECT_NE(refusal(desk, foot), "accepted");
    EXPECT_NE(refusal(desk, drag(lift, "nobody")), "accepted");
    desk.play(undo);
    EXPECT_FALSE(desk.document().is_posed());
    EXPECT_TRUE(same_bits(desk.shape(), desk.document().cloud().positions));
}

// Says stop at its n-th question.
class StopsAt final : public Progress {
public:
    explicit StopsAt(int questions) : left_(questions) {}
    void report(std::string_view /*stage*/, double /*fraction*/) override {}
    bool cancelled() const override { return left_.fetch_sub(1) <= 0; }
    bool was_reached() const { return left_ < 0; }

private:
    mutable std::atomic<int> left_;
};

DragLine as_line(const std::string& text) {
    return std::get<DragLine>(
        parse_session("{\"knead\":1,\"cloud\":{\"path\":\"a\"}}\n" + text, "s").lines.at(0).action);
}

// From the first question to the last, through every stage, the document must be as before; and what follows
// must not see that anything was ever stopped.
TEST(History, ACancelledDragLeavesTheDocumentAsItWas) {
    const std::vector<float> bent = shape_after(ends + bend);
    const std::vector<float> both = shape_after(ends + bend + twist);
    Desk fresh(bar());
    fresh.play(ends);
    Desk posed(bar());
    posed.play(ends + bend);
    bool finished = false;
    for (int questions = 0; !finished; ++questions) {
        StopsAt stop(questions);
        try {
            fresh.document().drag(as_line(bend), "s:1", stop);
            finished = true;
        } catch (const Cancelled&) {
            EXPECT_FALSE(fresh.document().is_posed());
        }
    }
    EXPECT_TRUE(same_bits(fresh.shape(), bent));
    finished = false;
    for (int questions = 0; !finished; ++questions) {
        StopsAt stop(questions);
        try {
            posed.document().drag(as_line(twist), "s:1", stop);
            finished = true;
        } catch (const Cancelled&) {
            ASSERT_TRUE(same_bits(posed.shape(), bent)) << "stopped at question " << questions;
        }
    }
    EXPECT_TRUE(same_bits(posed.shape(), both));
}

TEST(History, ACancelledFrameLeavesThoseThatFewSamplesAnswerForAsTheyWere) {
    const auto shape = [](bool cancels) {
        Desk desk(bar());
        Document& document = desk.play(ends).document();
        SilentProgress silent;
        document.begin_drag("top", {0, 0, 2.5}, "s:1", silent);
        HandlePose pose;
        pose.coarse = true;
        pose.rotate = Eigen::AngleAxisd(0.4, Vec3d::UnitY());
        document.drag_frame(pose, "s:1", silent);
        EXPECT_TRUE(desk.pipeline().has_coarse_samples());
        HandlePose fine;
        fine.translate = {0.5, 0, 0};
        StopsAt stop(1); // before the first iteration
        if (cancels) {
            EXPECT_THROW(document.drag_frame(fine, "s:1", stop), Cancelled);
        }
        pose.rotate = Eigen::AngleAxisd(0.8, Vec3d::UnitY());
        document.drag_frame(pose, "s:1", silent);
        document.end_drag();
        return desk.shape();
    };
    EXPECT_TRUE(same_bits(shape(true), shape(false)));
}

// The flood of a handle's samples, stopped half-way, must not stay in the lists.
TEST(History, ACancelledPreparationOfOtherHandlesStartsAgain) {
    const std::string ring = R"({"op":"handle","name":"ring","role":"fixed","region":)"
                             R"({"box":{"min":[-9,-9,-0.2],"max":[9,9,0.2]}}})"
                             "\n";
    const std::vector<float> expected = shape_after(ends + bend + commit + ring + twist);
    for (int questions = 0;; ++questions) {
        Desk desk(bar());
        desk.play(ends + bend + commit + ring);
        StopsAt stop(questions);
        bool finished = true;
        try {
            desk.document().drag(as_line(twist), "s:1", stop);
        } catch (const Cancelled&) {
            finished = false;
            desk.play(twist);
        }
        ASSERT_TRUE(same_bits(desk.shape(), expected)) << "stopped at question " << questions;
        if (finished) break;
    }
}

TEST(History, ShapesThatWereDroppedAreMadeAgainToTheBit) {
    Desk desk(bar());
    desk.play(
        R"({"op":"handle","name":"low","role":"fixed","region":{"halfspace":{"point":[0,0,-2],"normal":[0,0,-1]}}}
{"op":"handle","name":"high","role":"moving","region":{"halfspace":{"point":[0,0,2],"normal":[0,0,1]}}})");
    // More commits than shapes are kept; the handles and the settings change on the way.
    std::vector<std::vector<float>> shapes{desk.shape()};
    constexpr int commits = 12;
    for (int k = 0; k < commits; ++k) {
        desk.play(
            R"({"op":"drag","handle":"high","pivot":[0,0,2],"frames":[{"rotate":[1,0.1,0,0]},{"translate":[0.1,0,0.05],"rotate":[1,0.1,0.1,0]}]}
{"op":"commit"})");
        if (k == 5) desk.play(R"({"op":"set","stiffness":0.03,"samples":500})");
        if (k == 8)
            desk.play(
                R"({"op":"handle","name":"middle","role":"fixed","region":{"box":{"min":[-2,-2,-0.2],"max":[2,2,0.2]}}})");
        shapes.push_back(desk.shape());
    }
    const auto undo_one = [&](int k) {
        desk.play(k == 5 || k == 8 ? "{\"op\":\"undo\"}\n{\"op\":\"undo\"}\n{\"op\":\"undo\"}"
                                   : "{\"op\":\"undo\"}\n{\"op\":\"undo\"}");
    };
    for (int k = commits - 1; k >= 0; --k) {
        undo_one(k);
        EXPECT_EQ(desk.shape(), shapes[static_cast<std::size_t>(k)]) << "back to " << k;
    }
    for (int k = 0; k < commits; ++k)
        desk.play(k == 5 || k == 8 ? "{\"op\":\"redo\"}\n{\"op\":\"redo\"}\n{\"op\":\"redo\"}"
                                   : "{\"op\":\"redo\"}\n{\"op\":\"redo\"}");
    EXPECT_EQ(desk.shape(), shapes.back()) << "and forth without looking on the way";
}

// Undoing and redoing every one of these acts, with almost nothing kept, and comparing each shape.
TEST(History, SamplesThatWereDroppedAreMadeAgainToTheBit) {
    Desk desk(bar());
    desk.document().keep_at_most({.shapes = 2, .samples = 2, .sample_bytes = 0});
    desk.play(set(R"("samples":"all")") + ends);
    std::vector<std::string> acts;
    for (int k = 0; k < 9; ++k) {
        acts.push_back(drag(turn('y', 3 * k + 5) + "," + turn('z', 9 * k, "[0.1,0,0.05]")));
        if (k % 3 == 1) acts.push_back(drag(coarse(turn('x', 4 * k)) + "," + coarse(turn('x', 6 * k))));
        if (k % 2 == 1) acts.push_back(settle(5));
        if (k == 3) acts.push_back(set(R"("stiffness":0.04,"iterations":2)"));
        if (k == 5) acts.push_back(commit);
    }
    std::vector<std::vector<float>> shapes{desk.shape()};
    for (const std::string& act : acts) shapes.push_back(desk.play(act).shape());
    for (std::size_t i = acts.size(); i > 0; --i)
        ASSERT_TRUE(same_bits(desk.play(undo).shape(), shapes[i - 1])) << "undoing act " << i;
    for (std::size_t i = 0; i < acts.size(); ++i)
        ASSERT_TRUE(same_bits(desk.play(redo).shape(), shapes[i + 1])) << "redoing act " << i;
    for (std::size_t i = 0; i < acts.size(); ++i) desk.play(undo);
    for (std::size_t i = 0; i < acts.size(); ++i) desk.play(redo);
    EXPECT_TRUE(same_bits(desk.shape(), shapes.back())) << "and forth without looking on the way";
    // What goes on from a state that was dropped goes on from the same warm start.
    for (std::size_t i = 0; i < 3; ++i) desk.play(undo);
    Desk other(bar());
    other.play(set(R"("samples":"all")") + ends);
    for (std::size_t i = 0; i + 3 < acts.size(); ++i) other.play(acts[i]);
    EXPECT_TRUE(same_bits(desk.play(twist).shape(), other.play(twist).shape()));
}

// Name, role and array of the points of each handle, and its motion; and whether the pipeline takes the same.
struct Seen {
    std::vector<std::string> names;
    std::vector<const void*> points;
    std::vector<Vec3d> offsets;
    explicit Seen(const Document& document) {
        for (const Handle& handle : document.handles()) {
            names.push_back(handle.name + (handle.role == HandleRole::fixed ? " fixed" : " moving"));
            points.push_back(handle.points.get());
        }
        for (const HandleMotion& motion : document.motions()) offsets.push_back(motion.offset);
    }
    bool operator==(const Seen&) const = default;
};

TEST(History, HandlesAndTheirMotionsAreThoseOfTheTime) {
    const auto handle = [](const std::string& name, const std::string& role, const std::string& points) {
        return R"({"op":"handle","name":")" + name + R"(","role":")" + role + R"(","points":)" + points +
               "}\n";
    };
    const auto removed = [](const std::string& name) {
        return R"({"op":"delete","handle":")" + name + "\"}\n";
    };
    const auto renamed = [](const std::string& name, const std::string& to) {
        return R"({"op":"rename","handle":")" + name + R"(","to":")" + to + "\"}\n";
    };
    const std::string acts[] = {handle("a", "moving", "[[0,9]]"),
                                handle("b", "fixed", "[[20,29]]"),
                                handle("c", "moving", "[[40,49]]"),
                                handle("a", "moving", "[[50,59]]"), // again: behind the others now
                                renamed("b", "bee"),
                                drag(lift, "a"),
                                drag(lift, "c"),
                                renamed("c", "sea"), // while it is posed
                                set(R"("stiffness":0.02)"),
                                settle(2),
                                drag(R"({"translate":[0,0.25,0]})", "sea"),
                                commit,
                                removed("bee"),
                                handle("d", "fixed", "[3]"),
                                drag(lift, "sea"),
                                commit,
                                removed("a")};
    const std::size_t count = std::size(acts);
    Desk desk(bar());
    desk.document().keep_at_most({.shapes = 1, .samples = 1, .sample_bytes = 0}); // much is made again
    std::vector<Seen> seen{Seen(desk.document())};
    std::vector<std::vector<float>> shapes{desk.shape()};
    for (const std::string& act : acts) {
        shapes.push_back(desk.play(act).shape());
        seen.emplace_back(desk.document());
    }
    EXPECT_EQ(seen[4].names, (std::vector<std::string>{"b fixed", "c moving", "a moving"}));
    EXPECT_EQ(seen[count].names, (std::vector<std::string>{"sea moving", "d fixed"}));
    EXPECT_EQ(seen[11].offsets, (std::vector<Vec3d>{{0, 0, 0}, {0, 0.25, 0}, {0.5, 0, 0.25}}));
    std::size_t at = count;
    const auto go_to = [&](std::size_t target) {
        for (; at > target; --at) desk.play(undo);
        for (; at < target; ++at) desk.play(redo);
        EXPECT_EQ(Seen(desk.document()), seen[at]) << "after act " << at;
        EXPECT_TRUE(same_bits(desk.shape(), shapes[at])) << "after act " << at;
    };
    for (const std::size_t target : {16U, 17U, 11U, 13U, 6U, 5U, 12U, 3U, 4U, 15U, 0U, 7U, 10U, 9U, 17U})
        go_to(target);
    go_to(3);
    desk.play(removed("a")); // another future
    EXPECT_EQ(Seen(desk.document()).names, (std::vector<std::string>{"b fixed", "c moving"}));
    desk.play(undo);
    EXPECT_EQ(Seen(desk.document()), seen[3]);
}

TEST(History, WhatItKeepsDoesNotGrowWithTheSteps) {
    Desk desk(bar());
    desk.document().keep_at_most({.shapes = 2, .samples = 4, .sample_bytes = 0});
    desk.play(set(R"("samples":"all")") + ends);
    std::vector<std::size_t> kept;
    for (int k = 0; k < 24; ++k) {
        desk.play(drag(turn('x', k)));
        kept.push_back(desk.document().kept_bytes());
    }
    EXPECT_GT(kept[3], kept[0]);
    for (std::size_t k = 4; k < kept.size(); ++k) EXPECT_EQ(kept[k], kept[3]) << "after drag " << k + 1;
    for (int k = 0; k < 24; ++k) {
        desk.play(undo).shape();
        EXPECT_LE(desk.document().kept_bytes(), kept[3]);
    }
}

TEST(History, NothingIsKeptOfWhatWasForgotten) {
    Desk desk(bar()), fresh(bar());
    desk.play(ends + bend + commit + twist + commit + bend + undo + undo + undo + undo + undo + twist);
    fresh.play(ends + twist);
    EXPECT_GT(fresh.document().kept_bytes(), 0U);
    EXPECT_EQ(desk.document().kept_bytes(), fresh.document().kept_bytes());
}

} // namespace
} // namespace knead
