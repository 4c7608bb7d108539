#pragma once
// What a turn makes of a Gaussian splat's rotation and of its view-dependent colour.

#include "cloud/splats.h"

#include <cstddef>
#include <span>
#include <vector>

namespace knead {

// How spherical harmonics of one band change when the function on the sphere that they stand for is turned:
// f'(d) = f(R⁻¹ d). The basis is that of the splats' files: for a direction (x, y, z), up to a factor a band,
//     1    -y, z, -x
//     2    xy, -yz, (2z² - x² - y²)/(2√3), -xz, (x² - y²)/2
//     3    -y(3x² - y²), √24 xyz, -√(3/5) y(4z² - x² - y²), √(2/5) z(2z² - 3x² - 3y²),
//          -√(3/5) x(4z² - x² - y²), √6 z(x² - y²), -x(x² - 3y²)
// A band is closed under turns, so the new coefficients are found exactly from the values in a few
// directions, spread over the sphere.
class TurnedHarmonics {
public:
    // Small enough to need no memory of their own.
    using Values = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 7, 1>;
    using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 7, 7>;

    explicit TurnedHarmonics(std::size_t band); // 1 … 3

    // The matrix, 2 band + 1 square, that turns a column of coefficients.
    Square matrix(const Mat3d& turn) const;

    // The basis functions at a direction of length 1.
    static Values basis(std::size_t band, const Vec3d& direction);

private:
    // More directions than any band has functions, so that the fit is well posed.
    static constexpr int directions = 16;
    using Fit = Eigen::Matrix<double, Eigen::Dynamic, directions, 0, 7, directions>;
    using Sampled = Eigen::Matrix<double, directions, Eigen::Dynamic, 0, directions, 7>;

    static Vec3d direction(int k);

    std::size_t band_;
    Fit fit_; // from the values in these directions to coefficients
};

// The turned values of a cloud's splats, one splat at a time; asked for in the order of the splats, each is
// computed once. The cloud and the turns must outlive it. One thread at a time.
class TurnedSplats {
public:
    // `turns`: 4n, w x y z, unit quaternions.
    TurnedSplats(const PointCloud& cloud, const SplatColumns& columns, std::span<const float> turns);

    // The new value of the column number `slot` of columns(), for splat i. Where nothing turns, the file's.
    double value(std::size_t i, std::size_t slot);

    // Places in the cloud's attributes: the rotation's four, then the harmonics.
    const std::vector<std::size_t>& columns() const { return columns_; }

private:
    void turn(std::size_t i);
    void turn_harmonics(const Mat3d& turn);

    const PointCloud& cloud_;
    std::span<const float> turns_;
    std::size_t bands_;
    std::vector<std::size_t> columns_;
    std::vector<TurnedHarmonics> harmonics_; // of each band
    std::size_t splat_;                      // whose values these are
    std::vector<double> values_;             // one a column
};

} // namespace knead
