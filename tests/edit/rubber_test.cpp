// Rubber on surfaces whose points lie as chance has it, as scanners leave them: it thins where it is pulled,
// and comes to rest.

#include "edit/editing.h"
#include "shapes/point_columns.h"

#include <optional>
#include <random>

namespace knead {
namespace {

using namespace knead::test;

constexpr double radius = 0.5, length = 10;

// Six thousand points anywhere on a tube of 1 : 10 along z, about the origin.
PointCloud random_tube(unsigned seed) {
    std::mt19937 numbers(seed);
    const auto share = [&] { return static_cast<double>(numbers()) / 4294967296.0; };
    PointColumns columns = make_columns(6000, WithNormals::no, WithColours::no);
    for (std::size_t point = 0; point < 6000; ++point) {
        const double angle = 2 * std::numbers::pi * share(), z = length * (share() - 0.5);
        put_point(columns, point, {radius * std::cos(angle), radius * std::sin(angle), z}, Vec3d::Zero());
    }
    return finish(std::move(columns));
}

// How far a point is from the axis that is farthest.
double widest(std::span<const float> shape) {
    double most = 0;
    for (std::size_t i = 0; i < shape.size(); i += 3)
        most = std::max(most, std::hypot(static_cast<double>(shape[i]), static_cast<double>(shape[i + 1])));
    return most;
}

// The rms radius of the middle fifth, which goes half as far as the end.
double waist(std::span<const float> shape) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < shape.size(); i += 3) {
        const double x = static_cast<double>(shape[i]), y = static_cast<double>(shape[i + 1]);
        if (std::abs(static_cast<double>(shape[i + 2]) - 1.5) > 0.13 * length) continue;
        sum += x * x + y * y;
        ++count;
    }
    return std::sqrt(sum / count);
}

// The tube pulled by 30 %, settled.
std::vector<float> pulled(unsigned seed, double poisson, const std::optional<std::uint64_t>& samples) {
    Settings settings;
    settings.poisson = poisson;
    settings.samples = samples;
    Desk desk(random_tube(seed), settings);
    desk.play(
        R"({"op":"handle","name":"low","role":"fixed","region":{"halfspace":{"point":[0,0,-4.5],"normal":[0,0,-1]}}})"
        "\n"
        R"({"op":"handle","name":"high","role":"moving","region":{"halfspace":{"point":[0,0,4.5],"normal":[0,0,1]}}})"
        "\n"
        R"({"op":"drag","handle":"high","frames":[{"translate":[0,0,1]},{"translate":[0,0,2]},{"translate":[0,0,3]}]})");
    desk.play(settle(1000));
    return desk.shape();
}

// The middle is a third longer.
double asked_waist(double poisson) {
    return radius * std::pow(4.0 / 3, -poisson);
}

TEST(Rubber, SwellsNowhereOnPointsAnywhere) {
    for (const unsigned seed : {1U, 2U, 3U, 4U}) {
        SCOPED_TRACE(seed);
        const std::vector<float> shape = pulled(seed, 0.49, 200);
        EXPECT_NEAR(waist(shape), asked_waist(0.49), 0.04 * radius);
        EXPECT_LT(widest(shape), 1.02 * radius) << "it swells into lumps";
    }
}

// Links between such points lean to one side, and give way to that: the ratio was 0.22 for 0.3.
TEST(Rubber, ThinsAsAskedWithManySamples) {
    struct Choice {
        std::optional<std::uint64_t> samples; // none: every point
        double tolerance;                     // of the radius
    };
    for (const double poisson : {-0.5, 0.3})
        for (const Choice& choice : {Choice{1000, 0.015}, Choice{2000, 0.02}, Choice{{}, 0.015}}) {
            SCOPED_TRACE(std::to_string(poisson) + ", " + std::to_string(choice.samples.value_or(6000)) +
                         " samples");
            EXPECT_NEAR(waist(pulled(1, poisson, choice.samples)), asked_waist(poisson),
                        choice.tolerance * radius);
        }
}

} // namespace
} // namespace knead
