// Gaussian splats that turn: their quaternions and their view-dependent colours.

#include "io/lzf.h"
#include "io/ply_samples.h"
#include "io/through_files.h"
#include "io/turned_splats.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <set>

namespace knead::test {
namespace {

class Dice {
public:
    double number() { return normal_(engine_); }
    Vec3d direction() { return Vec3d(number(), number(), number()).normalized(); }
    Quatd turn() { return Quatd(number(), number(), number(), number()).normalized(); }

private:
    std::mt19937_64 engine_{1};
    std::normal_distribution<double> normal_;
};

TEST(TurnedHarmonics, AreTheSameFunctionTurned) {
    Dice dice;
    for (std::size_t band = 1; band <= 3; ++band) {
        const TurnedHarmonics turned(band);
        for (int time = 0; time < 20; ++time) {
            const Mat3d turn = dice.turn().toRotationMatrix();
            const Vec3d direction = dice.direction();
            TurnedHarmonics::Values before(static_cast<Eigen::Index>(2 * band + 1));
            for (double& value : before) value = dice.number();
            const TurnedHarmonics::Values after = turned.matrix(turn) * before;
            EXPECT_NEAR(after.dot(TurnedHarmonics::basis(band, turn * direction)),
                        before.dot(TurnedHarmonics::basis(band, direction)), 1e-12)
                << band;
        }
    }
}

// The functions of a band are equally large, so turning them is an orthogonal map; with a wrong factor before
// one of them it would not be.
TEST(TurnedHarmonics, KeepTheirSize) {
    Dice dice;
    for (std::size_t band = 1; band <= 3; ++band) {
        const TurnedHarmonics::Square turned = TurnedHarmonics(band).matrix(dice.turn().toRotationMatrix());
        EXPECT_LT((turned.transpose() * turned)
                      .eval()
                      .
                      operator-(TurnedHarmonics::Square::Identity(turned.rows(), turned.rows()))
                      .cwiseAbs()
                      .maxCoeff(),
                  1e-12)
            << band;
    }
}

// The reference program's formula for the colour, to the factor of each band, at one direction: looking along
// (0.48, 0.6, 0.64), worked out by hand from its source.
TEST(TurnedHarmonics, HaveTheSignsOfTheFiles) {
    const Vec3d direction(0.48, 0.6, 0.64);
    const TurnedHarmonics::Values one = TurnedHarmonics::basis(1, direction);
    EXPECT_DOUBLE_EQ(one[0], -0.6);
    EXPECT_DOUBLE_EQ(one[1], 0.64);
    EXPECT_DOUBLE_EQ(one[2], -0.48);
    const TurnedHarmonics::Values two = TurnedHarmonics::basis(2, direction);
    const double scale_two = two[0] / (1.0925484305920792 * 0.288);
    EXPECT_NEAR(two[1], scale_two * -1.0925484305920792 * 0.384, 1e-12);
    EXPECT_NEAR(two[2], scale_two * 0.31539156525252005 * (2 * 0.4096 - 0.2304 - 0.36), 1e-12);
    EXPECT_NEAR(two[3], scale_two * -1.0925484305920792 * 0.3072, 1e-12);
    EXPECT_NEAR(two[4], scale_two * 0.5462742152960396 * (0.2304 - 0.36), 1e-12);
    const TurnedHarmonics::Values three = TurnedHarmonics::basis(3, direction);
    const double scale_three = three[1] / (2.890611442640554 * 0.18432);
    EXPECT_GT(scale_three, 0);
    EXPECT_NEAR(three[0], scale_three * -0.5900435899266435 * 0.6 * (3 * 0.2304 - 0.36), 1e-12);
    EXPECT_NEAR(three[3], scale_three * 0.3731763325901154 * 0.64 * (0.8192 - 0.6912 - 1.08), 1e-12);
    EXPECT_NEAR(three[6], scale_three * -0.5900435899266435 * 0.48 * (0.2304 - 1.08), 1e-12);
}

// A file of three splats, as the reference program writes them, with so many columns f_rest_.
std::string splat_file(std::size_t harmonics, Dice& dice) {
    std::vector<std::string> names{"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2"};
    for (std::size_t k = 0; k < harmonics; ++k) names.push_back("f_rest_" + std::to_string(k));
    for (const char* name : {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
        names.emplace_back(name);
    std::string file = "ply\nformat binary_little_endian 1.0\nelement vertex 3\n";
    for (const std::string& name : names) file += "property float " + name + "\n";
    file += "end_header\n";
    for (std::size_t i = 0; i < 3 * names.size(); ++i) {
        const bool normal = i % names.size() >= 3 && i % names.size() < 6;
        const float value = normal ? 0.0F : static_cast<float>(dice.number());
        std::array<char, sizeof value> bytes{};
        std::memcpy(bytes.data(), &value, sizeof value);
        file.append(bytes.data(), bytes.size());
    }
    return file;
}

double value_of(const PointCloud& cloud, const std::string& name, std::size_t i) {
    return value_at(cloud.attributes[find_attribute(cloud, name).value()], i);
}

Quatd rotation_of(const PointCloud& cloud, std::size_t i) {
    return {value_of(cloud, "rot_0", i), value_of(cloud, "rot_1", i), value_of(cloud, "rot_2", i),
            value_of(cloud, "rot_3", i)};
}

// The view-dependent part of a colour channel, from a direction.
double colour_of(const PointCloud& cloud, std::size_t bands, std::size_t channel, std::size_t i,
                 const Vec3d& direction) {
    std::size_t at = channel * bands * (bands + 2);
    double sum = 0;
    for (std::size_t band = 1; band <= bands; ++band)
        for (const double basis : TurnedHarmonics::basis(band, direction))
            sum += basis * value_of(cloud, "f_rest_" + std::to_string(at++), i);
    return sum;
}

std::vector<float> as_floats(const std::vector<Quatd>& turns) {
    std::vector<float> result;
    for (const Quatd& turn : turns)
        for (const double part : {turn.w(), turn.x(), turn.y(), turn.z()})
            result.push_back(static_cast<float>(part));
    return result;
}

TEST(Splats, TurnWithTheirPoints) {
    for (std::size_t bands = 0; bands <= 3; ++bands) {
        Dice dice;
        const std::string file = splat_file(3 * bands * (bands + 2), dice);
        const PointCloud cloud = read_bytes(file);
        EXPECT_EQ(find_splats(cloud).value().bands, bands);
        const std::vector<Quatd> turns{dice.turn(), Quatd::Identity(), dice.turn()};
        const std::vector<float> rotations = as_floats(turns);
        const PointCloud turned = read_bytes(written(cloud, {{}, {}, {}, rotations}));
        for (std::size_t i = 0; i < 3; ++i) {
            const Quatd expected = turns[i] * rotation_of(cloud, i);
            EXPECT_LT((rotation_of(turned, i).coeffs() - expected.coeffs()).norm(), 1e-6) << "length kept";
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const Vec3d from = dice.direction();
                EXPECT_NEAR(colour_of(turned, bands, channel, i, turns[i] * from),
                            colour_of(cloud, bands, channel, i, from), 1e-5);
            }
        }
        // The one that did not turn keeps its bytes, and so does all that has no direction.
        for (const Attribute& column : cloud.attributes) {
            const Attribute& now = turned.attributes[find_attribute(turned, column.name).value()];
            const bool directed = column.name.starts_with("rot_") || column.name.starts_with("f_rest_");
            EXPECT_EQ(value_at(now, 1), value_at(column, 1)) << column.name;
            EXPECT_EQ(now.values == column.values, !directed) << column.name;
        }
    }
}

TEST(Splats, ThatDoNotTurnAreSavedToTheByte) {
    Dice dice;
    const std::string file = splat_file(45, dice);
    const PointCloud cloud = read_bytes(file);
    EXPECT_EQ(written(cloud, {}), file);
    EXPECT_EQ(written(cloud, {{}, {}, {}, as_floats({3, Quatd::Identity()})}), file);
}

TEST(Splats, AreKnownByTheirColumns) {
    Dice dice;
    EXPECT_FALSE(find_splats(read_bytes(sample({}))));
    EXPECT_EQ(find_splats(read_bytes(splat_file(0, dice))).value().other_harmonics, false);
    const auto odd = find_splats(read_bytes(splat_file(7, dice))).value();
    EXPECT_TRUE(odd.other_harmonics);
    EXPECT_EQ(odd.bands, 0U);
    EXPECT_TRUE(odd.harmonics.empty());
}

TEST(Splats, AreFoundWithAHundredThousandHarmonics) {
    PointCloud cloud = make_cloud(std::vector<float>{1, 2, 3});
    for (int i = 0; i < 100'000; ++i)
        add_attribute(cloud, "f_rest_" + std::to_string(i), std::vector<float>{1});
    for (const char* name : {"scale_0", "rot_0", "rot_1", "rot_2", "rot_3"})
        add_attribute(cloud, name, std::vector<float>{1});
    const SplatColumns splats = find_splats(cloud).value();
    EXPECT_TRUE(splats.other_harmonics);
    EXPECT_TRUE(splats.harmonics.empty());
}

// Hears of the stages that it is told of.
class Listener final : public Progress {
public:
    void report(std::string_view stage, double /*fraction*/) override { stages.insert(std::string(stage)); }
    bool cancelled() const override { return false; }
    std::set<std::string> stages;
};

TEST(Splats, TurnInCompressedFilesAsInOthers) {
    Dice dice;
    const PointCloud cloud = read_bytes(splat_file(45, dice));
    const std::string plain = written(cloud, {}, "out.pcd");
    std::string header = plain.substr(0, plain.find("DATA binary\n"));
    std::string body; // column by column; the fields are the cloud's columns
    for (const Attribute& column : cloud.attributes)
        body.append(reinterpret_cast<const char*>(column.values.data()), column.values.size());
    const auto packed = pack_lzf(std::as_bytes(std::span(body)));
    std::array<std::uint32_t, 2> lengths{static_cast<std::uint32_t>(packed.size()),
                                         static_cast<std::uint32_t>(body.size())};
    header.append("DATA binary_compressed\n").append(reinterpret_cast<const char*>(lengths.data()), 8);
    header.append(reinterpret_cast<const char*>(packed.data()), packed.size());
    const std::vector<float> turns = as_floats({dice.turn(), Quatd::Identity(), dice.turn()});
    const std::vector<float> far{1, 2, 3};
    const PosedShape shape{{}, {}, {{"far", far}}, turns};
    const PointCloud expected = read_bytes(written(read_bytes(plain, "a.pcd"), shape, "a.pcd"), "a.pcd");
    const ScratchFolder folder;
    Listener listener;
    (void)write_cloud(folder / "b.pcd", read_bytes(header, "b.pcd"), shape, listener);
    EXPECT_TRUE(listener.stages.contains("patching"));
    const PointCloud turned = read_cloud(folder / "b.pcd", listener);
    ASSERT_EQ(turned.attributes.size(), expected.attributes.size());
    for (std::size_t a = 0; a < expected.attributes.size(); ++a)
        EXPECT_EQ(turned.attributes[a].values, expected.attributes[a].values) << expected.attributes[a].name;
}

TEST(Splats, ThatAreNoNumbersStayAsTheyAre) {
    Dice dice;
    std::string file = splat_file(0, dice);
    const float nothing = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(file.data() + file.size() - 4, &nothing, 4); // rot_3 of the last splat
    const PointCloud cloud = read_bytes(file);
    const std::string saved = written(cloud, {{}, {}, {}, as_floats({3, dice.turn()})});
    EXPECT_EQ(saved.substr(saved.size() - 16), file.substr(file.size() - 16));
}

} // namespace
} // namespace knead::test
