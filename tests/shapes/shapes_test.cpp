#include "base/error.h"
#include "shapes/made.h"
#include "shapes/profile.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace knead::test {

namespace {

constexpr double pi = std::numbers::pi;

// A point rounded to float32 is off by half a unit in the last place of its coordinates, below 4.
constexpr double rounding = 1e-6;

ShapeOptions options_of(std::size_t points, double noise = 0, double outliers = 0, double gradient = 1) {
    ShapeOptions options;
    options.points = points;
    options.noise = noise;
    options.outliers = outliers;
    options.gradient = gradient;
    return options;
}

struct OnSurface {
    double distance = 0;
    Vec3d normal = Vec3d::Zero();
};

OnSurface measure_box(const Vec3d& p, const Vec3d& half) {
    const Vec3d inside = half - p.cwiseAbs();
    Eigen::Index axis = 0;
    const double least = inside.minCoeff(&axis);
    OnSurface found{std::abs(least), Vec3d::Zero()};
    found.normal[axis] = p[axis] > 0 ? 1 : -1;
    return found;
}

OnSurface measure_knot(const Vec3d& p) {
    constexpr int steps = 400;
    const auto squared = [&](double t) { return (p - knot_spine(t)).squaredNorm(); };
    double t = 0;
    for (int i = 1; i < steps; ++i)
        if (squared(2 * pi * i / steps) < squared(t)) t = 2 * pi * i / steps;
    for (double step = pi / steps; step > 1e-9; step *= 0.5)
        t = squared(t - step) < squared(t) ? t - step : squared(t + step) < squared(t) ? t + step : t;
    const Vec3d offset = p - knot_spine(t);
    return {std::abs(offset.norm() - knot_tube_radius), offset.normalized()};
}

// How far a point is from the shape as shapes.h describes it, and the outward normal there.
OnSurface measure(Shape shape, const Vec3d& p) {
    const Vec3d flat(p.x(), p.y(), 0);
    switch (shape) {
    case Shape::plane:
        return {std::abs(p.z()), Vec3d::UnitZ()};
    case Shape::bar:
        return measure_box(p, {0.5, 0.5, 2.5});
    case Shape::cylinder:
        return {std::abs(flat.norm() - 0.5), flat.normalized()};
    case Shape::sphere:
        return {std::abs(p.norm() - 1), p.normalized()};
    case Shape::torus: {
        const Vec3d offset = p - flat.normalized();
        return {std::abs(offset.norm() - 0.35), offset.normalized()};
    }
    case Shape::knot:
        return measure_knot(p);
    case Shape::solid_bar:
    case Shape::creature:
        break;
    }
    return {};
}

double place_along(Shape shape, const Vec3d& p) {
    if (shape == Shape::plane) return p.x();
    if (shape == Shape::torus) return std::atan2(p.y(), p.x());
    return p.z();
}

std::size_t count_along(Shape shape, const PointCloud& cloud, double low, double high) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const double place = place_along(shape, cloud.file_position(i));
        if (place >= low && place < high) ++count;
    }
    return count;
}

} // namespace

TEST(Shapes, NamesLeadBackToTheirShapes) {
    for (const Shape shape : all_shapes) {
        EXPECT_EQ(shape_named(name_of(shape)), shape);
        EXPECT_NE(shape_names().find(name_of(shape)), std::string::npos);
    }
    EXPECT_FALSE(shape_named("teapot"));
    EXPECT_FALSE(shape_named(""));
}

TEST(Shapes, HaveExactlyThePointsAskedFor) {
    for (const Shape shape : all_shapes)
        for (const std::size_t points : {1U, 2U, 3U, 7U, 100U, 1009U, 12345U}) {
            const PointCloud cloud = made(shape, points);
            EXPECT_EQ(cloud.size(), points) << name_of(shape);
            EXPECT_EQ(bounds_of(cloud).finite_points, points) << name_of(shape);
            EXPECT_EQ(made(shape, options_of(points, 0.2, 0.3, 2)).size(), points) << name_of(shape);
        }
}

TEST(Shapes, HaveTheColumnsOfTheirKind) {
    for (const Shape shape : all_shapes) {
        const PointCloud cloud = made(shape, 50);
        EXPECT_EQ(find_normals(cloud).has_value(), shape != Shape::solid_bar) << name_of(shape);
        EXPECT_EQ(find_attribute(cloud, "red").has_value(), shape == Shape::creature) << name_of(shape);
        EXPECT_EQ(cloud.attributes[0].name, "x");
        for (const Attribute& attribute : cloud.attributes)
            EXPECT_EQ(attribute.values.size(), 50 * size_of(attribute.type));
    }
}

TEST(Shapes, DependOnTheSeedAndNotOnTheThreads) {
    for (const Shape shape : all_shapes) {
        ShapeOptions options = options_of(5000, 0.1, 0.01, 1.5);
        const PointCloud cloud = made(shape, options, 1);
        EXPECT_TRUE(same_values(cloud, made(shape, options, 3))) << name_of(shape);
        options.seed = 2;
        EXPECT_FALSE(same_values(cloud, made(shape, options))) << name_of(shape);
    }
}

TEST(Shapes, NoTwoPointsCoincide) {
    for (const Shape shape : all_shapes)
        EXPECT_EQ(distinct_positions(made(shape, 30000)), 30000U) << name_of(shape);
}

TEST(Shapes, PointsLieOnTheSurfaceWithItsUnitNormals) {
    for (const Shape shape :
         {Shape::plane, Shape::bar, Shape::cylinder, Shape::sphere, Shape::torus, Shape::knot}) {
        const PointCloud cloud = made(shape, 3000);
        const std::vector<float> normals = read_normals(cloud);
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            const OnSurface found = measure(shape, cloud.file_position(i));
            ASSERT_LT(found.distance, rounding) << name_of(shape) << " point " << i;
            ASSERT_NEAR(normal_of(normals, i).norm(), 1, 1e-6) << name_of(shape) << " point " << i;
            ASSERT_GT(normal_of(normals, i).dot(found.normal), 0.99999) << name_of(shape) << " point " << i;
        }
    }
}

TEST(Shapes, LieInTheBoxesThatTheHeaderSays) {
    const auto check = [](Shape shape, const Vec3d& lowest, const Vec3d& highest) {
        const Bounds bounds = bounds_of(made(shape, 20000));
        EXPECT_LT((bounds.lowest - lowest).cwiseAbs().maxCoeff(), 0.03) << name_of(shape);
        EXPECT_LT((bounds.highest - highest).cwiseAbs().maxCoeff(), 0.03) << name_of(shape);
    };
    check(Shape::plane, {0, 0, 0}, {1, 1, 0});
    check(Shape::bar, {-0.5, -0.5, -2.5}, {0.5, 0.5, 2.5});
    check(Shape::cylinder, {-0.5, -0.5, -2.5}, {0.5, 0.5, 2.5});
    check(Shape::sphere, {-1, -1, -1}, {1, 1, 1});
    check(Shape::torus, {-1.35, -1.35, -0.35}, {1.35, 1.35, 0.35});
    check(Shape::solid_bar, {-0.5, -0.5, -2.5}, {0.5, 0.5, 2.5});
}

TEST(Shapes, AMillionPointsOfThePlaneAreAThousandRowsOfAThousand) {
    const PointCloud cloud = made(Shape::plane, 1000000);
    for (const std::size_t i : {std::size_t{0}, std::size_t{999}, std::size_t{1000}, std::size_t{567890}}) {
        const Vec3d p = cloud.file_position(i);
        EXPECT_EQ(static_cast<std::size_t>(p.x() * 1000), i / 1000);
        EXPECT_EQ(static_cast<std::size_t>(p.y() * 1000), i % 1000);
    }
}

// Stratified points of a unit area fill each of 20 equal slices to within the points of a row.
TEST(Shapes, AreSampledEvenly) {
    constexpr std::size_t points = 40000;
    for (const Shape shape : {Shape::plane, Shape::cylinder, Shape::sphere, Shape::torus, Shape::solid_bar}) {
        const PointCloud cloud = made(shape, points);
        const double low = shape == Shape::plane    ? 0
                           : shape == Shape::torus  ? -pi
                           : shape == Shape::sphere ? -1
                                                    : -2.5;
        const double high = shape == Shape::plane ? 1 : -low;
        for (int slice = 0; slice < 20; ++slice) {
            const double begin = low + (high - low) * slice / 20;
            const std::size_t count = count_along(shape, cloud, begin, begin + (high - low) / 20);
            EXPECT_NEAR(static_cast<double>(count), points / 20.0, 0.1 * points / 20.0) << name_of(shape);
        }
    }
}

// Around the ring of the torus the outer half, 1 + 0.35 · 2/π of the mean girth, has more area than the
// inner.
TEST(Shapes, TheTorusIsEvenAroundItsTube) {
    const PointCloud cloud = made(Shape::torus, 40000);
    std::size_t outer = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const Vec3d p = cloud.file_position(i);
        if (std::hypot(p.x(), p.y()) > 1) ++outer;
    }
    EXPECT_NEAR(static_cast<double>(outer) / 40000, 0.5 + 0.35 / pi, 0.005);
}

TEST(Shapes, TheBarsSidesAndCapsGetTheirShares) {
    const PointCloud cloud = made(Shape::bar, 22000);
    const std::size_t below = count_along(Shape::bar, cloud, -3, -2.4999999);
    EXPECT_NEAR(static_cast<double>(below), 1000, 1);
    EXPECT_LT(cloud.file_position(0).z(), -2.4999999); // the lower cap comes first
}

TEST(Shapes, TheSolidBarIsFilledEvenly) {
    constexpr std::size_t points = 80000; // cells of 0.04 a side
    const PointCloud cloud = made(Shape::solid_bar, points);
    std::vector<std::size_t> counts(4 * 4 * 20);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const Vec3d p = cloud.file_position(i);
        const auto bin = [](double place, double low) { return static_cast<std::size_t>((place - low) * 4); };
        ++counts[bin(p.x(), -0.5) + 4 * bin(p.y(), -0.5) + 16 * bin(p.z(), -2.5)];
    }
    const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
    EXPECT_GT(*least, 200U); // of 250
    EXPECT_LT(*most, 300U);
}

// A slice's share is the integral of the exponential density over it.
TEST(Shapes, TheGradientIsDensestOverSparsest) {
    constexpr std::size_t points = 60000;
    constexpr double gradient = 8;
    const double slice = 0.1;
    const double expected_first = (std::pow(gradient, slice) - 1) / (gradient - 1) * points;
    for (const Shape shape : {Shape::plane, Shape::cylinder, Shape::sphere, Shape::solid_bar}) {
        const PointCloud cloud = made(shape, options_of(points, 0, 0, gradient));
        const double low = shape == Shape::plane ? 0 : shape == Shape::sphere ? -1 : -2.5;
        const double high = shape == Shape::plane ? 1 : -low;
        const double length = high - low;
        const auto first = static_cast<double>(count_along(shape, cloud, low, low + slice * length));
        const auto last = static_cast<double>(count_along(shape, cloud, high - slice * length, high + 1));
        EXPECT_NEAR(first, expected_first, 0.1 * expected_first) << name_of(shape);
        EXPECT_NEAR(last / first, std::pow(gradient, 1 - slice), 0.1 * gradient) << name_of(shape);
    }
}

TEST(Shapes, TheTorussGradientGoesAroundTheRing) {
    const PointCloud cloud = made(Shape::torus, options_of(100000, 0, 0, 5));
    const auto dense = static_cast<double>(count_along(Shape::torus, cloud, -0.2, 0.2));
    const auto sparse = static_cast<double>(count_along(Shape::torus, cloud, pi - 0.2, pi + 0.2) +
                                            count_along(Shape::torus, cloud, -pi - 0.2, -pi + 0.2));
    EXPECT_NEAR(dense / sparse, 5, 0.3);
}

TEST(Shapes, NoiseIsAFractionOfTheSpacing) {
    constexpr std::size_t points = 20000;
    for (const Shape shape : {Shape::plane, Shape::sphere}) {
        const PointCloud cloud = made(shape, options_of(points, 0.5));
        double sum = 0;
        for (std::size_t i = 0; i < points; ++i) {
            const double distance = measure(shape, cloud.file_position(i)).distance;
            sum += distance * distance;
        }
        const double area = shape == Shape::plane ? 1 : 4 * pi;
        // The standard deviation of 20,000 draws is known to 1/√(2n) = 0.5 %; five times that.
        EXPECT_NEAR(std::sqrt(sum / points) / std::sqrt(area / points), 0.5, 0.0125) << name_of(shape);
    }
}

TEST(Shapes, OutliersAreTheLastPoints) {
    constexpr std::size_t points = 5000;
    const PointCloud cloud = made(Shape::sphere, options_of(points, 0, 0.1));
    for (std::size_t i = 0; i < points; ++i) {
        const double distance = measure(Shape::sphere, cloud.file_position(i)).distance;
        if (i < 4500)
            ASSERT_LT(distance, rounding) << i;
        else
            ASSERT_GT(distance, rounding) << i;
    }
    const std::vector<float> normals = read_normals(cloud);
    for (std::size_t i = 0; i < points; ++i) ASSERT_NEAR(normal_of(normals, i).norm(), 1, 1e-6);
    const Bounds bounds = bounds_of(cloud);
    const double enlarged = 1 + 0.1 * std::sqrt(12.0);
    EXPECT_GT(bounds.highest.minCoeff(), 1.2);
    EXPECT_LT(bounds.highest.maxCoeff(), enlarged);
}

TEST(Shapes, TheKnotsStrandsComeAsCloseAsItSays) {
    constexpr int steps = 900;
    std::vector<Vec3d> spine;
    double length = 0;
    for (int i = 0; i < steps; ++i) {
        spine.push_back(knot_spine(2 * pi * i / steps));
        length += (knot_spine(2 * pi * (i + 1) / steps) - spine.back()).norm();
    }
    double closest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < i; ++j)
            if (std::min(i - j, steps - i + j) > steps / 8)
                closest = std::min(
                    closest,
                    (spine[static_cast<std::size_t>(i)] - spine[static_cast<std::size_t>(j)]).norm());
    EXPECT_NEAR(closest - 2 * knot_tube_radius, knot_gap, 1e-3);
    EXPECT_NEAR(length, 27.65, 0.01);
    const double spacing = std::sqrt(length * 2 * pi * knot_tube_radius / 20000);
    EXPECT_GT(knot_gap, 4 * spacing);
    EXPECT_LT(knot_gap, length / 50);
}

TEST(Shapes, RefuseOptionsOutOfTheirRange) {
    const double not_a_number = std::numeric_limits<double>::quiet_NaN();
    for (const ShapeOptions& wrong :
         {options_of(0), options_of(std::size_t{no_index}), options_of(10, -0.1),
          options_of(10, not_a_number), options_of(10, 0, -0.1), options_of(10, 0, 1),
          options_of(10, 0, not_a_number), options_of(10, 0, 0, 0.99), options_of(10, 0, 0, not_a_number)}) {
        try {
            made(Shape::plane, wrong);
            ADD_FAILURE() << "made it";
        } catch (const Error& error) {
            EXPECT_EQ(error.trouble(), Trouble::usage);
        }
    }
}

TEST(Shapes, StopWhenCancelled) {
    struct Stopped final : Progress {
        void report(std::string_view, double) override {}
        bool cancelled() const override { return true; }
    } progress;
    Workers workers(1);
    for (const Shape shape : all_shapes)
        EXPECT_THROW(make_shape(shape, options_of(1000), workers, progress), Cancelled) << name_of(shape);
}

TEST(CutIntoRows, IsEvenAndComplete) {
    for (const std::size_t points : {1U, 5U, 99U, 1001U}) {
        const std::vector<std::size_t> first = cut_into_rows(points, [](double) { return 10.0; });
        EXPECT_EQ(first.front(), 0U);
        EXPECT_EQ(first.back(), points);
        EXPECT_TRUE(std::is_sorted(first.begin(), first.end()));
        const double rows = std::max(1.0, std::round(static_cast<double>(points) / 10));
        EXPECT_EQ(first.size(), static_cast<std::size_t>(rows) + 1);
        for (std::size_t r = 0; r + 1 < first.size(); ++r)
            EXPECT_NEAR(static_cast<double>(first[r + 1] - first[r]), static_cast<double>(points) / rows,
                        1.01);
    }
}

} // namespace knead::test
