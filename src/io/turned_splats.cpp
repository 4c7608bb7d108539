#include "io/turned_splats.h"

#include "base/require.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <limits>
#include <numbers>

namespace knead {

// Evenly over the sphere, along a spiral of the golden angle.
Vec3d TurnedHarmonics::direction(int k) {
    const double z = 1 - (2.0 * k + 1) / directions;
    const double around = k * std::numbers::pi * (3 - std::sqrt(5.0));
    const double radius = std::sqrt(1 - z * z);
    return {radius * std::cos(around), radius * std::sin(around), z};
}

TurnedHarmonics::Values TurnedHarmonics::basis(std::size_t band, const Vec3d& direction) {
    const double x = direction.x(), y = direction.y(), z = direction.z();
    const double xx = x * x, yy = y * y, zz = z * z;
    Values values(static_cast<Eigen::Index>(2 * band + 1));
    if (band == 1) values << -y, z, -x;
    if (band == 2) values << x * y, -y * z, (2 * zz - xx - yy) / (2 * std::sqrt(3.0)), -x * z, (xx - yy) / 2;
    if (band == 3)
        values << -y * (3 * xx - yy), std::sqrt(24.0) * x * y * z, -std::sqrt(0.6) * y * (4 * zz - xx - yy),
            std::sqrt(0.4) * z * (2 * zz - 3 * xx - 3 * yy), -std::sqrt(0.6) * x * (4 * zz - xx - yy),
            std::sqrt(6.0) * z * (xx - yy), -x * (xx - 3 * yy);
    return values;
}

TurnedHarmonics::TurnedHarmonics(std::size_t band) : band_(band) {
    require(band >= 1 && band <= 3, "harmonics of a band from 1 to 3");
    Sampled values(directions, static_cast<Eigen::Index>(2 * band + 1));
    for (int k = 0; k < directions; ++k) values.row(k) = basis(band, direction(k));
    const Square gram = values.transpose() * values;
    fit_ = gram.llt().solve(values.transpose());
}

TurnedHarmonics::Square TurnedHarmonics::matrix(const Mat3d& turn) const {
    Sampled before(directions, fit_.rows());
    for (int k = 0; k < directions; ++k) before.row(k) = basis(band_, turn.transpose() * direction(k));
    return fit_ * before;
}

TurnedSplats::TurnedSplats(const PointCloud& cloud, const SplatColumns& columns, std::span<const float> turns)
    : cloud_(cloud), turns_(turns), bands_(columns.bands),
      columns_(columns.rotation.begin(), columns.rotation.end()),
      splat_(std::numeric_limits<std::size_t>::max()) {
    require(turns.size() == 4 * cloud.size(), "a turn for each splat");
    columns_.insert(columns_.end(), columns.harmonics.begin(), columns.harmonics.end());
    for (std::size_t band = 1; band <= bands_; ++band) harmonics_.emplace_back(band);
    values_.resize(columns_.size());
}

double TurnedSplats::value(std::size_t i, std::size_t slot) {
    if (i != splat_) turn(i);
    return values_[slot];
}

void TurnedSplats::turn(std::size_t i) {
    splat_ = i;
    for (std::size_t c = 0; c < columns_.size(); ++c)
        values_[c] = value_at(cloud_.attributes[columns_[c]], i);
    const float* const q = turns_.data() + 4 * i;
    if (q[0] == 1 && q[1] == 0 && q[2] == 0 && q[3] == 0) return;
    const Quatd turn = Quatd(static_cast<double>(q[0]), static_cast<double>(q[1]), static_cast<double>(q[2]),
                             static_cast<double>(q[3]))
                           .normalized();
    const Quatd turned = turn * Quatd(values_[0], values_[1], values_[2], values_[3]);
    values_[0] = turned.w();
    values_[1] = turned.x();
    values_[2] = turned.y();
    values_[3] = turned.z();
    turn_harmonics(turn.toRotationMatrix());
}

// The columns of a channel hold band after band.
void TurnedSplats::turn_harmonics(const Mat3d& turn) {
    std::size_t first_of_band = 0;
    for (const TurnedHarmonics& band : harmonics_) {
        const TurnedHarmonics::Square matrix = band.matrix(turn);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const std::size_t first = 4 + channel * bands_ * (bands_ + 2) + first_of_band;
            Eigen::Map<TurnedHarmonics::Values> values(values_.data() + first, matrix.rows());
            values = (matrix * values).eval();
        }
        first_of_band += static_cast<std::size_t>(matrix.rows());
    }
}

} // namespace knead
