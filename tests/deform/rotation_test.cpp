#include "deform/rotation.h"

#include "graph/clouds.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include <cmath>
#include <limits>
#include <numbers>

namespace knead {
namespace {

Quatd random_rotation(std::mt19937& random) {
    std::normal_distribution<double> normal;
    const double w = normal(random);
    const double x = normal(random);
    const double y = normal(random);
    return Quatd(w, x, y, normal(random)).normalized();
}

Mat3d random_matrix(std::mt19937& random) {
    Mat3d matrix;
    for (int column = 0; column < 3; ++column) matrix.col(column) = test::random_vector(random);
    return matrix;
}

// The yardstick: U diag(1, 1, ±1) Vᵀ.
Mat3d by_svd(const Mat3d& a) {
    const Eigen::JacobiSVD<Mat3d> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Vec3d signs(1, 1, 1);
    if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) signs.z() = -1;
    return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

// How well the maximum is determined: the sum of the two smallest singular values, the last one counted
// negative under a reflection, over the largest.
double firmness(const Mat3d& a) {
    const Eigen::JacobiSVD<Mat3d> svd(a);
    const Vec3d values = svd.singularValues();
    return (values[1] + std::copysign(values[2], a.determinant())) / values[0];
}

void expect_unit_and_near(const Quatd& found, const Quatd& near) {
    EXPECT_NEAR(found.norm(), 1, 1e-14); // rounding
    EXPECT_GE(found.dot(near), -1e-15);  // at 180° rounding decides
}

// Newton's method ends with a step of less than 1e-7.
constexpr double close_enough = 1e-6;

void expect_as_svd(const Mat3d& a, const Quatd& near) {
    const Quatd found = nearest_rotation(a, near);
    expect_unit_and_near(found, near);
    EXPECT_LT((found.toRotationMatrix() - by_svd(a)).norm(), close_enough) << a;
}

TEST(NearestRotation, IsThatOfTheSingularValues) {
    std::mt19937 random(1);
    int reflected = 0;
    for (int i = 0; i < 5000; ++i) {
        const Mat3d a = random_matrix(random);
        if (firmness(a) < 1e-3) continue;
        if (a.determinant() < 0) ++reflected;
        expect_as_svd(a, random_rotation(random));
    }
    EXPECT_GT(reflected, 1000) << "half of random matrices reflect";
}

TEST(NearestRotation, IsFoundFromCloseBy) {
    // What an iteration meets: the neighbourhood turned a little further, and stretched.
    std::mt19937 random(2);
    for (int i = 0; i < 2000; ++i) {
        const Quatd near = random_rotation(random);
        const Vec3d further = 0.3 * test::random_vector(random);
        const Quatd target = near * Quatd(Eigen::AngleAxisd(further.norm(), further.normalized()));
        Mat3d spread = random_matrix(random);
        spread = spread * spread.transpose() + 0.1 * Mat3d::Identity();
        const Quatd found = nearest_rotation(target.toRotationMatrix() * spread, near);
        expect_unit_and_near(found, near);
        EXPECT_LT(found.angularDistance(target), close_enough);
    }
}

TEST(NearestRotation, IsFoundFromAPlane) {
    std::mt19937 random(3);
    for (int i = 0; i < 2000; ++i) {
        Mat3d flat = random_matrix(random);
        flat.col(2) = flat.col(0) * test::random_vector(random).x();
        flat = flat * random_rotation(random).toRotationMatrix(); // rank 2, in any plane
        if (firmness(flat) < 1e-3) continue;
        expect_as_svd(flat, random_rotation(random));
    }
}

TEST(NearestRotation, IsFoundFromTheOtherSide) {
    // 180° away tr(Rᵀ A) is stationary as well, but at no maximum.
    std::mt19937 random(4);
    for (int i = 0; i < 500; ++i) {
        const Quatd target = random_rotation(random);
        const Vec3d axis = test::random_vector(random).normalized();
        const Quatd opposite = target * Quatd(0, axis.x(), axis.y(), axis.z());
        expect_as_svd(target.toRotationMatrix(), opposite);
        const Mat3d stretched = target.toRotationMatrix() * Vec3d(1, 2, 0.5).asDiagonal();
        expect_as_svd(stretched, opposite);
        for (int k = 0; k < 3; ++k) {
            const Vec3d principal = Vec3d::Unit(k);
            expect_as_svd(stretched, target * Quatd(0, principal.x(), principal.y(), principal.z()));
        }
    }
}

TEST(NearestRotation, LeavesTheTurnAboutALineAsItWas) {
    std::mt19937 random(5);
    for (int i = 0; i < 1000; ++i) {
        const Vec3d before = test::random_vector(random);
        const Vec3d now = test::random_vector(random);
        const Quatd near = random_rotation(random);
        const Quatd found = nearest_rotation(now * before.transpose(), near);
        expect_unit_and_near(found, near);
        // A line is turned onto a line, on the shortest way from `near`.
        EXPECT_LT((found * before.normalized() - now.normalized()).norm(), close_enough);
        const Quatd shortest = Quatd::FromTwoVectors(near * before, now) * near;
        const double turn =
            std::acos(std::clamp((near * before.normalized()).dot(now.normalized()), -1.0, 1.0));
        if (turn > 3) continue; // nearly opposite: every way is as short
        // Of the rounding, 1e-15, over the preference, 1e-6, that a rotation so far from `near` still has.
        const double tolerance = 2e-9 / std::pow(std::cos(turn / 2), 2);
        EXPECT_LT(found.angularDistance(shortest), tolerance) << "turn of " << turn;
    }
}

TEST(NearestRotation, IsNotToldByTheNoiseOfFloatsHowALineTurns) {
    std::mt19937 random(6);
    for (int i = 0; i < 1000; ++i) {
        const Vec3d line = test::random_vector(random);
        Mat3d a = line * line.transpose();
        for (int edge = 0; edge < 3; ++edge) { // of points on it, as floats have them
            const Vec3d off = 1e-7 * line.norm() * test::random_vector(random).normalized();
            a += (line + off) *
                 (line + 1e-7 * line.norm() * test::random_vector(random).normalized()).transpose();
        }
        EXPECT_LT(nearest_rotation(a, Quatd::Identity()).angularDistance(Quatd::Identity()), 1e-5);
    }
}

TEST(NearestRotation, OfNothingIsTheOneBefore) {
    std::mt19937 random(6);
    const Quatd near = random_rotation(random);
    EXPECT_EQ(nearest_rotation(Mat3d::Zero(), near).coeffs(), near.coeffs());
    const double nan = std::nan("");
    EXPECT_EQ(nearest_rotation(Mat3d::Constant(nan), near).coeffs(), near.coeffs());
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(nearest_rotation(Mat3d::Constant(infinite), near).coeffs(), near.coeffs());
}

TEST(NearestRotation, KeepsWhatIsStationaryToTheLastBit) {
    std::mt19937 random(7);
    for (int i = 0; i < 500; ++i) {
        Mat3d symmetric = Mat3d::Zero();
        for (int edge = 0; edge < 6; ++edge) {
            const Vec3d e = test::random_vector(random);
            symmetric += e * e.transpose();
        }
        EXPECT_EQ(nearest_rotation(symmetric, Quatd::Identity()).coeffs(), Quatd::Identity().coeffs());
        const Quatd other(-1, 0, 0, 0);
        EXPECT_EQ(nearest_rotation(symmetric, other).coeffs(), other.coeffs());
    }
}

TEST(NearestRotation, DoesNotDependOnTheUnit) {
    std::mt19937 random(8);
    for (int i = 0; i < 200; ++i) {
        const Mat3d a = random_matrix(random);
        if (firmness(a) < 1e-3) continue;
        const Quatd near = random_rotation(random);
        for (const double unit : {1e-60, 1e60})
            EXPECT_LT((nearest_rotation(unit * a, near).toRotationMatrix() - by_svd(a)).norm(), close_enough);
    }
}

TEST(NearestRotations, AreEachAsItIsByItself) {
    std::mt19937 random(11);
    for (const std::size_t count : {0U, 1U, 3U, 4U, 5U, 16U, 257U}) {
        std::vector<Mat3d> a(count);
        std::vector<Quatd> near(count);
        for (std::size_t i = 0; i < count; ++i) {
            near[i] = random_rotation(random);
            a[i] = random_matrix(random); // most of them far away
            if (i % 3 == 0) a[i] = random_rotation(random).slerp(0.9, near[i]).toRotationMatrix();
            if (i % 7 == 3) a[i].setZero();
            if (i % 7 == 5) a[i].setConstant(std::nan(""));
            if (i % 7 == 6) a[i](1, 2) = std::numeric_limits<double>::infinity();
            if (i % 5 == 4) near[i].setIdentity(), a[i] = (a[i] * a[i].transpose()).eval(); // stays
        }
        std::vector<Quatd> together = near;
        nearest_rotations(a, together);
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_EQ(together[i].coeffs(), nearest_rotation(a[i], near[i]).coeffs()) << i << " of " << count;
    }
}

TEST(TurnOf, IsTheRotationLessTheIdentity) {
    std::mt19937 random(9);
    for (int i = 0; i < 200; ++i) {
        const Quatd q = random_rotation(random);
        EXPECT_LT((turn_of(q) - (q.toRotationMatrix() - Mat3d::Identity())).norm(), 1e-14); // rounding
    }
    EXPECT_EQ(turn_of(Quatd::Identity()), Mat3d::Zero());
    EXPECT_EQ(turn_of(Quatd(-1, 0, 0, 0)), Mat3d::Zero());
}

} // namespace
} // namespace knead
