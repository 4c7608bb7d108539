#include "graph/balanced_weights.h"

#include <Eigen/Core>

#include <cmath>
#include <numeric>

namespace knead {

namespace {

using Lanes = Eigen::Array<float, influences_per_row, 1>;

// The inverse of a matrix, times v, by cofactors: the matrix is small, symmetric and far from singular.
Vec3f solved(float xx, float xy, float xz, float yy, float yz, float zz, const Vec3f& v) {
    const float a = yy * zz - yz * yz, b = xz * yz - xy * zz, c = xy * yz - xz * yy;
    const float d = xx * zz - xz * xz, e = xy * xz - xx * yz, f = xx * yy - xy * xy;
    const float scale = 1.0F / (xx * a + xy * b + xz * c);
    return scale * Vec3f(a * v.x() + b * v.y() + c * v.z(), b * v.x() + d * v.y() + e * v.z(),
                         c * v.x() + e * v.y() + f * v.z());
}

} // namespace

void balance(const SampleOffsets& offsets, std::array<float, influences_per_row>& weight) {
    using Read = Eigen::Map<const Lanes>;
    Eigen::Map<Lanes> w(weight.data());
    Lanes x = Read(offsets.x.data()), y = Read(offsets.y.data()), z = Read(offsets.z.data());
    const float square_reach = (x * x + y * y + z * z).sum() / float{influences_per_row}; // r²
    if (!std::isnormal(square_reach)) return;
    const float to_reach = 1.0F / std::sqrt(square_reach), to_one = 1.0F / w.sum();
    x *= to_reach, y *= to_reach, z *= to_reach;
    const Lanes share = w * to_one;
    const Vec3f mean((share * x).sum(), (share * y).sum(), (share * z).sum()); // (p̄ - p) / r
    x -= mean.x(), y -= mean.y(), z -= mean.z();
    const Lanes wx = share * x, wy = share * y, wz = share * z;
    const float ridge = balance_ridge + balance_caution * mean.squaredNorm();
    const Vec3f lean = solved((wx * x).sum() + ridge, (wx * y).sum(), (wx * z).sum(), (wy * y).sum() + ridge,
                              (wy * z).sum(), (wz * z).sum() + ridge, -0.5F * mean);
    const Lanes factor = (1.0F + lean.x() * x + lean.y() * y + lean.z() * z).max(0.0F);
    w = share * factor * factor;
}

Influence influence_of(const WideRow& row, Index first_handle, InfluenceWeights weights,
                       const SampleOffsets& offsets) {
    Influence result = influence_of(row, first_handle, weights);
    if (weights != InfluenceWeights::smooth || result.count == 0) return result;
    balance(offsets, result.weight);
    const float sum = std::accumulate(result.weight.begin(), result.weight.end(), 0.0F);
    for (float& weight : result.weight) weight /= sum;
    return result;
}

Influence influence_of(const InfluenceRows& rows, InfluenceWeights weights, std::span<const Vec3d> places,
                       Index number, const Vec3d& p) {
    if (number >= rows.size()) return influence_of(rows, weights, number);
    const WideRow row = rows[number];
    return influence_of(row, rows.first_handle, weights, offsets_from(p, row, places));
}

} // namespace knead
