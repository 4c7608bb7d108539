// A region of interest: only what lies in it is moved again, and no bit is different.

#include "edit/editing.h"

#include <algorithm>
#include <sstream>

namespace knead::test {
namespace {

// Moves all points in every frame.
class WholeFrames final : public Upsampler {
public:
    explicit WholeFrames(std::unique_ptr<Upsampler> inner) : inner_(std::move(inner)) {}
    std::string device() const override { return inner_->device(); }
    std::size_t influence_bytes() const override { return inner_->influence_bytes(); }
    void prepare(const UpsampleInput& input, std::size_t motions) override {
        inner_->prepare(input, motions);
    }
    std::span<const Index> run(std::span<const Motion> motions, std::span<float> positions,
                               std::span<float> normals, Held /*held*/) override {
        return inner_->run(motions, positions, normals, Held::nothing);
    }

private:
    std::unique_ptr<Upsampler> inner_;
};

UpsamplerChoice whole_frames(const std::string& device, Workers& workers, unsigned threads) {
    UpsamplerChoice choice = make_upsampler(device, workers, threads);
    choice.upsampler = std::make_unique<WholeFrames>(std::move(choice.upsampler));
    return choice;
}

const std::string forget_region = R"({"op":"delete","handle":"region"})"
                                  "\n";

// A desk whose upsampler holds what rests, and one whose does not, with the shapes of all frames so far.
class Twins {
public:
    Twins(const PointCloud& cloud, const Settings& settings, const std::string& device)
        : holding_(cloud, settings, 2, device),
          whole_(cloud, settings, 2, device, Document::Mode::real, whole_frames) {
        holding_.document().on_frame = [this] { note(holding_, frames_[0]); };
        whole_.document().on_frame = [this] { note(whole_, frames_[1]); };
    }

    // Line by line; after each both have the same shape, and had it in each frame.
    void play(const std::string& lines) {
        std::istringstream text(lines);
        for (std::string line; std::getline(text, line);) {
            for (auto& frames : frames_) frames.clear();
            for (Desk* desk : {&holding_, &whole_}) desk->play(line);
            ASSERT_EQ(frames_[0].size(), frames_[1].size());
            for (std::size_t i = 0; i < frames_[0].size(); ++i)
                ASSERT_TRUE(same_bits(frames_[0][i], frames_[1][i])) << line << ", shape " << i;
            ASSERT_TRUE(same_bits(holding_.shape(), whole_.shape())) << line;
            ASSERT_TRUE(same_bits(holding_.normals(), whole_.normals())) << line;
            SilentProgress silent;
            ASSERT_TRUE(same_bits(holding_.document().rotations(silent), whole_.document().rotations(silent)))
                << line;
        }
    }

    const Pipeline& pipeline() const { return holding_.pipeline(); }

private:
    static void note(const Desk& desk, std::vector<LineArray<float>>& frames) {
        frames.push_back(desk.pipeline().posed().positions);
        frames.push_back(desk.pipeline().posed().normals);
    }

    Desk holding_, whole_;
    std::vector<LineArray<float>> frames_[2];
};

PointCloud bar_of_splats(std::size_t points) {
    PointCloud cloud = bar(points);
    const std::vector<float> zero(cloud.size(), 0.0F), one(cloud.size(), 1.0F);
    for (const char* name : {"scale_0", "scale_1", "scale_2", "rot_1", "rot_2", "rot_3"})
        add_attribute(cloud, name, zero);
    add_attribute(cloud, "rot_0", one);
    return cloud;
}

std::string some_frames(char axis) {
    return turn(axis, 10) + "," + turn(axis, 20, "[0.1,0,0]") + "," + turn(axis, 25, "[0.2,0,0.1]");
}

// The share of the blocks that the last frame wrote.
double share_written(const Pipeline& pipeline) {
    const auto written = std::ranges::count(pipeline.written(), pipeline.upsampled());
    return static_cast<double>(written) / static_cast<double>(pipeline.written().size());
}

class Region : public ::testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        if (GetParam() != std::string("reference") && list_devices().empty())
            GTEST_SKIP() << "there is no OpenCL device";
    }
};
INSTANTIATE_TEST_SUITE_P(, Region, ::testing::Values("reference", "0"), [](const auto& tested) {
    return std::string(tested.param) == "reference" ? "Reference" : "Device";
});

void play_every_act(Twins& twins) {
    twins.play(foot + above("region", 1) + above("top", 2, "moving") + drag(some_frames('x')) + settle(5) +
               drag(some_frames('y')) + undo + redo + undo + undo + undo + redo + redo);
    twins.play(commit + drag(some_frames('z')) + commit + drag(some_frames('x')));
    twins.play(undo + undo + undo + undo + redo + redo + redo + redo + commit);
    twins.play(above("region", -1) + drag(some_frames('y')) + settle(3) + commit); // another region
    twins.play(above("cap", 2.4, "fixed") + drag(some_frames('y')) + undo + undo + drag(some_frames('z')));
    twins.play(commit + forget_region + drag(some_frames('x')) + commit + undo + undo + undo +
               drag(some_frames('z')) + set(R"("weights":"paper")") + drag(some_frames('y')));
    twins.play(set(R"("stiffness":0.05)") + settle(4) + commit + drag(some_frames('x')));
}

TEST_P(Region, OfInterestChangesNoBitInAnyAct) {
    for (const char* samples : {"300", "all"}) {
        Settings settings;
        settings.samples = samples == std::string("all") ? std::nullopt : std::optional<std::uint64_t>(300);
        Twins twins(bar_of_splats(samples == std::string("all") ? 2500 : 12'000), settings, GetParam());
        play_every_act(twins);
    }
}

TEST_P(Region, OfInterestIsAllThatIsWritten) {
    Settings settings;
    settings.samples = 300;
    Twins twins(bar(30'000), settings, GetParam());
    twins.play(above("top", 2, "moving") + above("region", 1.5) + drag(turn('x', 10)));
    EXPECT_EQ(share_written(twins.pipeline()), 1) << "in the first frame of an edit all is";
    twins.play(drag(turn('x', 20)));
    const double small = share_written(twins.pipeline());
    EXPECT_GT(small, 0.2); // a fifth of the bar
    EXPECT_LT(small, 0.3);
    twins.play(drag(turn('x', 20)) + settle(3));
    EXPECT_LT(share_written(twins.pipeline()), small) << "the handle rests, and moves its points no more";
    twins.play(commit + above("region", 0) + drag(turn('x', 10)) + drag(turn('x', 20)));
    EXPECT_GT(share_written(twins.pipeline()), 0.5);
    twins.play(commit + forget_region + drag(turn('x', 10)) + drag(turn('x', 20)));
    EXPECT_EQ(share_written(twins.pipeline()), 1);

    Twins without_region(bar(30'000), settings, GetParam());
    const std::string quarter =
        R"({"op":"handle","name":"quarter","role":"fixed","region":{"box":{"min":[-9,-9,-9],"max":[9,9,-1.25]}}})"
        "\n";
    without_region.play(quarter + top + drag(turn('x', 10)) + drag(turn('x', 20)));
    EXPECT_NEAR(share_written(without_region.pipeline()), 0.75, 0.03) << "a fixed handle rests";
}

// Parts that nothing moves rest, and those that are carried go along.
TEST_P(Region, OfFrozenPartsRestsAndOfCarriedOnesMoves) {
    for (const char* strays : {"freeze", "carry"}) {
        const PointCloud near = bar(20'000);
        std::vector<float> both;
        for (const float far : {0.0F, 20.0F})
            for (std::size_t i = 0; i < near.positions.size(); ++i)
                both.push_back(near.positions[i] + (i % 3 == 0 ? far : 0));
        Settings settings;
        settings.samples = 300;
        settings.strays = strays == std::string("carry") ? Strays::carry : Strays::freeze;
        Twins twins(make_cloud(both), settings, GetParam());
        const std::string near_top =
            R"({"op":"handle","name":"top","role":"moving","region":{"box":{"min":[-9,-9,2],"max":[9,9,9]}}})"
            "\n";
        twins.play(near_top + drag(turn('x', 10)) + drag(turn('x', 20)));
        EXPECT_NEAR(share_written(twins.pipeline()), strays == std::string("carry") ? 1 : 0.5, 0.02);
        twins.play(commit + set(R"("strays":"carry")") + drag(turn('y', 10)) + drag(turn('y', 20)));
        EXPECT_EQ(share_written(twins.pipeline()), 1);
    }
}

} // namespace
} // namespace knead::test
