// The upsampling kernel in plain C++: kernels/upsample.cl, operation by operation, none of them fused.

#include "base/workers.h"
#include "upsample/changed_blocks.h"
#include "upsample/checked_input.h"
#include "upsample/influence_groups.h"
#include "upsample/point_blocks.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
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

// Adds w [A | d] and w c.
void add(float weight, const PackedMotion& motion, Blend& sum) {
    const Blend one = one_motion(motion);
    sum.a0 += weight * one.a0;
    sum.a1 += weight * one.a1;
    sum.a2 += weight * one.a2;
    sum.b += weight * one.b;
}

// Adds what a handle has for its place: the point itself.
void add_place(float weight, const PackedMotion& motion, Vector p, Blend& sum) {
    const Blend one = one_motion(motion);
    const Vector half_way = {weight * (0.5F * p.x), weight * (0.5F * p.y), weight * (0.5F * p.z)};
    Four turned = one.a0 * half_way.x + one.a1 * half_way.y + one.a2 * half_way.z;
    turned[3] = half_way.z;
    sum.a1[3] += half_way.x;
    sum.a2[3] += half_way.y;
    sum.b += turned;
}

float weight_of(int share) {
    return static_cast<float>(share) * (1.0F / whole_share);
}

// What moves one point of a group.
struct OnePoint {
    std::span<const Index> motion;        // of its group's entries
    const std::uint16_t* share = nullptr; // of the first of them; of the next ones, points_in_group on
    Index others_leave = 0;               // its motion has what these leave
    int share_of(std::size_t entry) const { return share[points_in_group * entry]; }
};

OnePoint one_point(const InfluenceGroups& influences, std::size_t point) {
    const InfluenceGroup& group = influences.groups()[point / points_in_group];
    return {influences.motion().subspan(group.first, group.count),
            influences.share().data() + points_in_group * group.first + point % points_in_group,
            group.motion};
}

// Those of its handles, which come last.
void add_places(const OnePoint& point, Index first_handle, std::span<const PackedMotion> motions, Vector p,
                Blend& sum) {
    std::size_t entry = point.motion.size();
    int left = whole_share;
    for (; entry > 0 && point.motion[entry - 1] >= first_handle; --entry) {
        const int share = point.share_of(entry - 1);
        left -= share;
        add_place(weight_of(share), motions[point.motion[entry - 1]], p, sum);
    }
    if (point.others_leave >= first_handle) add_place(weight_of(left), motions[point.others_leave], p, sum);
}

// Adds Σ_s w_s [A_s | d_s], and Σ_s w_s c_s.
void add_motions(const OnePoint& point, std::span<const PackedMotion> motions, Blend& sum) {
    int left = whole_share;
    for (std::size_t e = 0; e < point.motion.size(); ++e) {
        const int share = point.share_of(e);
        left -= share;
        add(weight_of(share), motions[point.motion[e]], sum);
    }
    add(weight_of(left), motions[point.others_leave], sum);
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
    const Vector q = {p.x - map.a1[3], p.y - map.a2[3], p.z - map.b[3]};
    const Four d = map.b + map.a0 * q.x + map.a1 * q.y + map.a2 * q.z;
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
    std::size_t influence_bytes() const override { return influences_.bytes(); }

    void prepare(const UpsampleInput& input, std::size_t motions) override {
        require_valid_input(input, motions, workers_);
        input_ = input;
        packed_.assign(motions + 1, {});
        pack_motions(std::vector<Motion>(packed_.size()), input.weights, {},
                     packed_); // and the first one stays
        if (input.mover.empty()) influences_ = {};
        if (!input.mover.empty()) influences_.prepare(input, workers_);
        changes_.prepare(input, motions, workers_);
    }

    std::span<const Index> run(std::span<const Motion> motions, std::span<float> positions,
                               std::span<float> normals, Held held) override {
        require_valid_frame(input_, packed_.size() - 1, motions, positions, normals);
        pack_motions(motions, input_.weights, input_.places, std::span(packed_).subspan(1));
        const std::span<const Index> blocks =
            changes_.of_frame(std::span(packed_).subspan(1), positions, normals, held);
        move(blocks, positions, normals);
        changes_.note_written();
        return blocks;
    }

private:
    void move(std::span<const Index> blocks, std::span<float> positions, std::span<float> normals) {
        if (blocks.empty()) return;
        const Index first_handle = first_without_place(input_);
        workers_.for_each(blocks.size(), blocks_per_chunk, [&](std::size_t at) {
            const PointRange own = points_of(blocks[at], input_.mover.size());
            for (std::size_t i = own.first; i < own.end; ++i) {
                const Vector p = load(&input_.positions[3 * i]);
                const OnePoint point = one_point(influences_, i);
                Blend blend = {};
                add_places(point, first_handle, packed_, p, blend);
                add_motions(point, packed_, blend);
                store(moved(p, blend), &positions[3 * i]);
                if (!normals.empty()) store(turned(load(&input_.normals[3 * i]), blend), &normals[3 * i]);
            }
        });
    }

    Workers& workers_;
    UpsampleInput input_;
    std::vector<PackedMotion> packed_; // one that moves nothing, and the motions
    InfluenceGroups influences_;
    ChangedBlocks changes_;
};

} // namespace

std::unique_ptr<Upsampler> make_reference_upsampler(Workers& workers) {
    return std::make_unique<ReferenceUpsampler>(workers);
}

} // namespace knead
