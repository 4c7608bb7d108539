// The upsampling kernel in plain C++: kernels/upsample.cl, operation by operation.

#include "base/workers.h"
#include "upsample/changed_blocks.h"
#include "upsample/checked_input.h"
#include "upsample/point_blocks.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <vector>

namespace knead {

namespace {

constexpr std::size_t blocks_per_chunk = 32;

struct Vector {
    float x, y, z;
};

Vector load(const float* from) {
    return {from[0], from[1], from[2]};
}

void store(Vector v, float* to) {
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}

float dot(Vector a, Vector b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

Vector cross(Vector a, Vector b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Four floats that the compiler keeps in one vector register (GCC and Clang, any processor). Left to itself
// it does not find them in the loops below, which are most of the work.
using Four = float __attribute__((vector_size(16)));
using Eight = float __attribute__((vector_size(32)));
using EightNarrow = std::uint16_t __attribute__((vector_size(16)));
using EightWide = std::uint32_t __attribute__((vector_size(32)));

Four load_four(const float* from) {
    Four four;
    std::memcpy(&four, from, sizeof four);
    return four;
}

// A blend of motions, as PackedMotion has them.
struct Blend {
    Four a0, a1, a2, b;
};

Blend one_motion(const PackedMotion& motion) {
    return {load_four(motion.column[0]), load_four(motion.column[1]), load_four(motion.column[2]),
            load_four(motion.column[3])};
}

void add(float weight, const PackedMotion& motion, Blend& sum) {
    const Blend one = one_motion(motion);
    sum.a0 += weight * one.a0;
    sum.a1 += weight * one.a1;
    sum.a2 += weight * one.a2;
    sum.b += weight * one.b;
}

// What the rows are read by.
struct Reading {
    Index first_handle; // numbers from here on are handles
    bool paper;         // whether the weights are the paper's
    const PackedMotion* motions;
};

template<typename Number>
bool has_handle(const SampleRow<Number>& row, Index first_handle) {
    return std::ranges::any_of(row.sample, [&](Number number) { return number >= first_handle; });
}

void add(const Blend& one, Blend& sum) {
    sum.a0 += one.a0;
    sum.a1 += one.a1;
    sum.a2 += one.a2;
    sum.b += one.b;
}

// What the handles of a row add to a blend for having no place: theirs is the point p itself.
template<typename Number, typename Weights>
Blend places_of_handles(const SampleRow<Number>& row, const Reading& how, const Weights& weight, Vector p) {
    const Vector half = {0.5F * p.x, 0.5F * p.y, 0.5F * p.z};
    Blend sum = {};
    for (std::size_t k = 0; k < influences_per_row && row.sample[k] != row.none; ++k) {
        if (row.sample[k] < how.first_handle) continue;
        const Blend handle = one_motion(how.motions[row.sample[k]]);
        Four turned = handle.a0 * half.x + handle.a1 * half.y + handle.a2 * half.z;
        turned[3] = half.z;
        sum.a1[3] += weight[k] * half.x;
        sum.a2[3] += weight[k] * half.y;
        sum.b += weight[k] * turned;
    }
    return sum;
}

// blended() for a row with empty places, equal distances, or a sample right at the point.
template<typename Number>
Blend rarely_blended(const SampleRow<Number>& row, const Reading& how, Vector p) {
    if (row.sample[0] == row.none) return {Four{0, 0, 0, 1}, Four{}, Four{}, Four{}};
    if (row.distance[0] == 0) return one_motion(how.motions[row.sample[0]]);
    const auto weight =
        weights_of(row, how.first_handle, how.paper ? InfluenceWeights::paper : InfluenceWeights::smooth);
    Blend sum = {};
    for (std::size_t k = 0; k < row.count(); ++k) add(weight[k], how.motions[row.sample[k]], sum);
    if (!how.paper) add(places_of_handles(row, how, weight, p), sum);
    return sum;
}

// Σ_s w_s [A_s | d_s] of one row at the point p, in a0[3] the sum of the weights, by which it is to be
// divided, and Σ_s w_s c_s.
template<typename Number>
Blend blended(const SampleRow<Number>& row, const Reading& how, Vector p) {
    const Number nearest = row.distance.front(), farthest = row.distance.back();
    if (row.sample.back() == row.none || nearest == 0 || nearest == farthest)
        return rarely_blended(row, how, p);
    // weights_of() a row without exceptions, all places at once.
    using Numbers = std::conditional_t<sizeof(Number) == 2, EightNarrow, EightWide>;
    Numbers distance;
    std::memcpy(&distance, row.distance.data(), sizeof distance);
    Eight weight = __builtin_convertvector(how.paper ? distance : farthest - distance, Eight);
    weight *= weight;
    if (how.paper) weight = 1.0F / weight;
    const bool near_handle = !how.paper && has_handle(row, how.first_handle);
    if (near_handle)
        for (std::size_t k = 0; k < influences_per_row; ++k)
            if (row.sample[k] >= how.first_handle) weight[k] *= growth_of_handle(row.distance[k], farthest);
    const Blend first = one_motion(how.motions[row.sample[0]]);
    Blend sum = {weight[0] * first.a0, weight[0] * first.a1, weight[0] * first.a2, weight[0] * first.b};
    for (std::size_t k = 1; k < influences_per_row - 1; ++k) add(weight[k], how.motions[row.sample[k]], sum);
    if (how.paper) add(weight[7], how.motions[row.sample.back()], sum);
    if (near_handle) add(places_of_handles(row, how, weight, p), sum);
    return sum;
}

// Where nothing is added, the coordinate is kept to the last bit, the sign of a zero included.
float plus(float coordinate, float displacement) {
    return displacement == 0.0F ? coordinate : coordinate + displacement;
}

// The same value, with the sign of `rest` if it is a zero.
float same_or(float rest, float value) {
    return value == rest ? rest : value;
}

Vector moved(Vector p, const Blend& map) {
    const float share = 1.0F / map.a0[3];
    const Vector q = {p.x - map.a1[3] * share, p.y - map.a2[3] * share, p.z - map.b[3] * share};
    const Four d = (map.a0 * q.x + map.a1 * q.y + map.a2 * q.z + map.b) * share;
    return {plus(p.x, d[0]), plus(p.y, d[1]), plus(p.z, d[2])};
}

// The cofactor matrix of I + A has the cross products of its columns for columns.
Vector turned(Vector n, const Blend& map) {
    const float share = 1.0F / map.a0[3];
    const Four a0 = map.a0 * share, a1 = map.a1 * share, a2 = map.a2 * share;
    const Vector a = {a0[0] + 1.0F, a0[1], a0[2]};
    const Vector b = {a1[0], a1[1] + 1.0F, a1[2]};
    const Vector c = {a2[0], a2[1], a2[2] + 1.0F};
    const Vector u = cross(b, c);
    const Vector v = cross(c, a);
    const Vector w = cross(a, b);
    const Vector t = {u.x * n.x + v.x * n.y + w.x * n.z, u.y * n.x + v.y * n.y + w.y * n.z,
                      u.z * n.x + v.z * n.y + w.z * n.z};
    // Zero, infinite or not a number: there is no length to restore, and the normal stays as it is.
    const float ratio = dot(n, n) / dot(t, t);
    if (!(ratio > 0.0F && ratio <= FLT_MAX)) return n;
    const float scale = std::sqrt(ratio);
    return {same_or(n.x, t.x * scale), same_or(n.y, t.y * scale), same_or(n.z, t.z * scale)};
}

class ReferenceUpsampler final : public Upsampler {
public:
    explicit ReferenceUpsampler(Workers& workers) : workers_(workers) {}

    std::string device() const override { return "reference"; }

    void prepare(const UpsampleInput& input, std::size_t motions) override {
        require_valid_input(input, motions, workers_);
        input_ = input;
        packed_.assign(motions, {});
        changes_.prepare(input, motions, workers_);
    }

    std::span<const Index> run(std::span<const Motion> motions, std::span<float> positions,
                               std::span<float> normals, Held held) override {
        require_valid_frame(input_, packed_.size(), motions, positions, normals);
        pack_motions(motions, input_.weights, packed_);
        const std::span<const Index> blocks = changes_.of_frame(packed_, positions, normals, held);
        if (input_.rows)
            std::visit([&](const auto& rows) { move(blocks, rows, positions, normals); }, input_.rows->rows);
        changes_.note_written();
        return blocks;
    }

private:
    template<typename Number>
    void move(std::span<const Index> blocks, const std::vector<SampleRow<Number>>& rows,
              std::span<float> positions, std::span<float> normals) {
        const Reading how{input_.rows->first_handle, input_.weights == InfluenceWeights::paper,
                          packed_.data()};
        workers_.for_each(blocks.size(), blocks_per_chunk, [&](std::size_t at) {
            const PointRange own = points_of(blocks[at], input_.mover.size());
            for (std::size_t i = own.first; i < own.end; ++i) {
                const std::size_t mover = input_.mover[i];
                const Vector p = load(&input_.positions[3 * i]);
                const Blend blend = mover < rows.size() ? blended(rows[mover], how, p)
                                                        : one_motion(how.motions[mover - rows.size()]);
                store(moved(p, blend), &positions[3 * i]);
                if (!normals.empty()) store(turned(load(&input_.normals[3 * i]), blend), &normals[3 * i]);
            }
        });
    }

    Workers& workers_;
    UpsampleInput input_;
    std::vector<PackedMotion> packed_;
    ChangedBlocks changes_;
};

} // namespace

std::unique_ptr<Upsampler> make_reference_upsampler(Workers& workers) {
    return std::make_unique<ReferenceUpsampler>(workers);
}

} // namespace knead
