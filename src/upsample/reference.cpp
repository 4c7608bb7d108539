// The upsampling kernel in plain C++: kernels/upsample.cl, operation by operation.

#include "base/workers.h"
#include "upsample/packed_motions.h"

#include <cfloat>
#include <cmath>
#include <cstring>
#include <vector>

namespace knead {

namespace {

constexpr std::size_t points_per_chunk = 8192;

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
// it does not find them in the loop below, which is most of the work.
using Four = float __attribute__((vector_size(16)));

Four load_four(const float* from) {
    Four four;
    std::memcpy(&four, from, sizeof four);
    return four;
}

// A blend of motions, by columns.
struct Blend {
    Four a0, a1, a2, b;
};

Blend blended(const Index* sample, const float* weight, const float* motions) {
    Blend sum = {};
    for (std::size_t k = 0; k < influences_per_row; ++k) {
        const float* motion = motions + packed_motion_floats * sample[k];
        sum.a0 += weight[k] * load_four(motion);
        sum.a1 += weight[k] * load_four(motion + 4);
        sum.a2 += weight[k] * load_four(motion + 8);
        sum.b += weight[k] * load_four(motion + 12);
    }
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
    const Four d = map.a0 * p.x + map.a1 * p.y + map.a2 * p.z + map.b;
    return {plus(p.x, d[0]), plus(p.y, d[1]), plus(p.z, d[2])};
}

// The cofactor matrix of I + A has the cross products of its columns for columns.
Vector turned(Vector n, const Blend& map) {
    const Vector a = {map.a0[0] + 1.0F, map.a0[1], map.a0[2]};
    const Vector b = {map.a1[0], map.a1[1] + 1.0F, map.a1[2]};
    const Vector c = {map.a2[0], map.a2[1], map.a2[2] + 1.0F};
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
        require_valid_input(input, motions);
        input_ = input;
        packed_.assign(motions * packed_motion_floats, 0.0F);
    }

    void run(std::span<const Motion> motions, std::span<float> positions, std::span<float> normals) override {
        require_valid_frame(input_, packed_.size() / packed_motion_floats, motions, positions, normals);
        pack_motions(motions, packed_.data());
        workers_.for_each(input_.row.size(), points_per_chunk, [&](std::size_t i) {
            const std::size_t first = influences_per_row * input_.row[i];
            const Blend blend = blended(input_.rows->sample.data() + first,
                                        input_.rows->weight.data() + first, packed_.data());
            store(moved(load(&input_.positions[3 * i]), blend), &positions[3 * i]);
            if (!normals.empty()) store(turned(load(&input_.normals[3 * i]), blend), &normals[3 * i]);
        });
    }

private:
    Workers& workers_;
    UpsampleInput input_;
    std::vector<float> packed_;
};

} // namespace

std::unique_ptr<Upsampler> make_reference_upsampler(Workers& workers) {
    return std::make_unique<ReferenceUpsampler>(workers);
}

} // namespace knead
