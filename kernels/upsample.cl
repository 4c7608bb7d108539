// Moves every point by the motions of the samples around it: src/upsample/upsample.h holds the formulas, and
// src/upsample/reference.cpp the same arithmetic in C++, operation by operation. Both give the same bits but
// for one thing: what moves points, which is most of the work, fuses products and sums here (one rounding)
// where the device can.
//
// Built with -D POINTS_IN_BLOCK=256, -D POINTS_IN_GROUP=16 and -D WHOLE_SHARE=65535; with -D SIXTEEN for a
// CPU, without for a GPU. Motions are packed by columns, 16 floats each, [A column 0 | A column 1 | A column 2
// | d] with a fourth row of 0 c0 c1 c2 (src/upsample/packed_motions.h); what moves which point comes by groups
// of sixteen points (src/upsample/influence_groups.h, src/upsample/shares.h). A CPU's item moves such groups,
// with a point in every lane; a GPU's moves one point.
//
// A group of items moves one block of 256 points (src/upsample/point_blocks.h), of those that a frame has to.

#pragma OPENCL FP_CONTRACT OFF

#ifdef SIXTEEN
#define POINTS_AT_ONCE 16
#define POINTS_PER_ITEM POINTS_IN_BLOCK
typedef float16 real;
typedef int16 truth;
#else
#define POINTS_AT_ONCE 1
#define POINTS_PER_ITEM 1
typedef float real;
typedef int truth;
#endif

typedef struct {
    real x, y, z;
} vector;

#ifdef SIXTEEN
// Floats as they lie in memory: those of `count` points, and zeros.
__attribute__((always_inline)) inline vector load(__global const float* from, size_t count) {
    float16 a, b, c;
    if (count == 16) {
        a = vload16(0, from), b = vload16(1, from), c = vload16(2, from);
    } else {
        float some[48];
        for (size_t i = 0; i < 48; ++i) some[i] = i < 3 * count ? from[i] : 0.0f;
        a = vload16(0, some), b = vload16(1, some), c = vload16(2, some);
    }
    vector v;
    v.x = (float16)(a.s0369, a.scf, b.s258b, b.se, c.s147a, c.sd);
    v.y = (float16)(a.s147a, a.sd, b.s0369, b.scf, c.s258b, c.se);
    v.z = (float16)(a.s258b, a.se, b.s147a, b.sd, c.s0369, c.scf);
    return v;
}

// x y z of sixteen points as they lie in memory, from two vectors at a time, which is a single instruction each. Written
// out by elements, LLVM 14 makes some fifty of it.
__attribute__((always_inline)) inline void store(vector v, __global float* to, size_t count) {
    const float16 axy = __builtin_shufflevector(v.x, v.y, 0, 16, -1, 1, 17, -1, 2, 18, -1, 3, 19, -1, 4, 20, -1, 5);
    const float16 a = __builtin_shufflevector(axy, v.z, 0, 1, 16, 3, 4, 17, 6, 7, 18, 9, 10, 19, 12, 13, 20, 15);
    const float16 bxy = __builtin_shufflevector(v.x, v.y, 21, -1, 6, 22, -1, 7, 23, -1, 8, 24, -1, 9, 25, -1, 10, 26);
    const float16 b = __builtin_shufflevector(bxy, v.z, 0, 21, 2, 3, 22, 5, 6, 23, 8, 9, 24, 11, 12, 25, 14, 15);
    const float16 cxy = __builtin_shufflevector(v.x, v.y, -1, 11, 27, -1, 12, 28, -1, 13, 29, -1, 14, 30, -1, 15, 31, -1);
    const float16 c = __builtin_shufflevector(cxy, v.z, 26, 1, 2, 27, 4, 5, 28, 7, 8, 29, 10, 11, 30, 13, 14, 31);
    if (count == 16) {
        vstore16(a, 0, to), vstore16(b, 1, to), vstore16(c, 2, to);
    } else {
        float all[48];
        vstore16(a, 0, all), vstore16(b, 1, all), vstore16(c, 2, all);
        for (size_t i = 0; i < 3 * count; ++i) to[i] = all[i];
    }
}

// The shares of an entry in the points of its group.
__attribute__((always_inline)) inline truth share_of(__global const ushort* share, size_t entry, size_t lane) {
    return convert_int16(vload16(entry, share));
}

__attribute__((always_inline)) inline real as_real(truth whole) {
    return convert_float16(whole);
}
#else
inline vector load(__global const float* from, size_t count) {
    const vector v = {from[0], from[1], from[2]};
    return v;
}

inline void store(vector v, __global float* to, size_t count) {
    to[0] = v.x, to[1] = v.y, to[2] = v.z;
}

__attribute__((always_inline)) inline truth share_of(__global const ushort* share, size_t entry, size_t lane) {
    return share[POINTS_IN_GROUP * entry + lane];
}

inline real as_real(truth whole) {
    return (float)whole;
}
#endif

// What moves sixteen points.
typedef struct {
    uint motion; // has what the others leave
    uint first_entry, entries;
} influence_group;

// What they are read by.
typedef struct {
    __global const influence_group* group;
    __global const uint* motion; // of each entry
    __global const ushort* share;
    uint first_handle; // motions from here on are handles, and all that have no place
    __global const float* motions;
} reading;

#pragma OPENCL FP_CONTRACT ON

// Adds w [A | d] to the blend, number c of them to blend[c], and w c.
__attribute__((always_inline)) inline void add_motion(__global const float* motion, real weight, real* blend) {
#pragma unroll
    for (int c = 0; c < 16; ++c)
        if (c != 3) blend[c] += weight * motion[c];
}

// Adds what a handle has for a place: the points themselves.
__attribute__((always_inline)) inline void add_place(__global const float* motion, real weight, vector p,
                                                     real* blend) {
    const vector half_way = {weight * (0.5f * p.x), weight * (0.5f * p.y), weight * (0.5f * p.z)};
    blend[7] += half_way.x;
    blend[11] += half_way.y;
    blend[15] += half_way.z;
#pragma unroll
    for (int row = 0; row < 3; ++row)
        blend[12 + row] +=
            motion[row] * half_way.x + motion[4 + row] * half_way.y + motion[8 + row] * half_way.z;
}

inline real weight_of(truth share) {
    return as_real(share) * (1.0f / WHOLE_SHARE);
}

// Σ_s w_s [A_s | d_s] at the points p, and Σ_s w_s c_s.
__attribute__((always_inline)) inline void blend_motions(reading how, size_t group, size_t lane, vector p,
                                                         real* blend) {
    const influence_group own = how.group[group];
    const uint end = own.first_entry + own.entries;
    truth left = WHOLE_SHARE;
#pragma unroll
    for (int c = 0; c < 16; ++c) blend[c] = 0.0f;
    for (uint entry = own.first_entry; entry < end; ++entry) {
        const truth share = share_of(how.share, entry, lane);
        left -= share;
        add_motion(how.motions + 16 * (size_t)how.motion[entry], weight_of(share), blend);
    }
    __global const float* const others_leave = how.motions + 16 * (size_t)own.motion;
    add_motion(others_leave, weight_of(left), blend);
    // Handles come last.
    for (uint entry = end; entry-- > own.first_entry && how.motion[entry] >= how.first_handle;)
        add_place(how.motions + 16 * (size_t)how.motion[entry], weight_of(share_of(how.share, entry, lane)), p,
                  blend);
    if (own.motion >= how.first_handle) add_place(others_leave, weight_of(left), p, blend);
}

// Where nothing is added, the coordinate is kept to the last bit, the sign of a zero included.
inline real plus(real coordinate, real displacement) {
    return select(coordinate + displacement, coordinate, displacement == 0.0f);
}

inline vector moved(vector p, const real* a) {
    const vector q = {p.x - a[7], p.y - a[11], p.z - a[15]};
    const vector result = {plus(p.x, a[12] + a[0] * q.x + a[4] * q.y + a[8] * q.z),
                           plus(p.y, a[13] + a[1] * q.x + a[5] * q.y + a[9] * q.z),
                           plus(p.z, a[14] + a[2] * q.x + a[6] * q.y + a[10] * q.z)};
    return result;
}

#pragma OPENCL FP_CONTRACT OFF

inline real dot_in_order(vector a, vector b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline vector cross_in_order(vector a, vector b) {
    const vector result = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    return result;
}

// The same value, with the sign of `rest` if it is a zero; `rest` where it is not to be had.
inline real scaled_or(real rest, real value, real scale, truth is_good) {
    const real scaled = value * scale;
    return select(rest, scaled, is_good && scaled != rest);
}

// The cofactor matrix of I + A has the cross products of its columns for columns.
inline vector turned(vector n, const real* blend) {
    const vector a = {blend[0] + 1.0f, blend[1], blend[2]};
    const vector b = {blend[4], blend[5] + 1.0f, blend[6]};
    const vector c = {blend[8], blend[9], blend[10] + 1.0f};
    const vector u = cross_in_order(b, c), v = cross_in_order(c, a), w = cross_in_order(a, b);
    const vector t = {u.x * n.x + v.x * n.y + w.x * n.z, u.y * n.x + v.y * n.y + w.y * n.z,
                      u.z * n.x + v.z * n.y + w.z * n.z};
    // Zero, infinite or not a number: there is no length to restore, and the normal stays as it is.
    const real ratio = dot_in_order(n, n) / dot_in_order(t, t);
    const truth is_good = ratio > 0.0f && ratio <= FLT_MAX;
    const real scale = sqrt(ratio);
    const vector result = {scaled_or(n.x, t.x, scale, is_good), scaled_or(n.y, t.y, scale, is_good),
                           scaled_or(n.z, t.z, scale, is_good)};
    return result;
}

// Moves this group's block of those listed. `normals` is null, or `moved_normals` has room for them.
__attribute__((always_inline)) inline void
upsample(ulong points, __global const uint* block, __global const float* positions, reading how,
         __global float* moved_positions, __global const float* normals, __global float* moved_normals) {
    const size_t begin =
        POINTS_IN_BLOCK * (size_t)block[get_group_id(0)] + POINTS_PER_ITEM * get_local_id(0);
    const size_t end = min(begin + POINTS_PER_ITEM, (size_t)points);
    for (size_t first = begin; first < end; first += POINTS_AT_ONCE) {
        const size_t count = min((size_t)POINTS_AT_ONCE, end - first);
        const vector p = load(positions + 3 * first, count);
        real blend[16];
        blend_motions(how, first / POINTS_IN_GROUP, first % POINTS_IN_GROUP, p, blend);
        store(moved(p, blend), moved_positions + 3 * first, count);
        if (normals) store(turned(load(normals + 3 * first, count), blend), moved_normals + 3 * first, count);
    }
}

__kernel void upsample_positions(const ulong points, __global const uint* block,
                                 __global const float* positions, __global const influence_group* group,
                                 __global const uint* motion, __global const ushort* share,
                                 const uint first_handle, __global const float* motions,
                                 __global float* moved_positions) {
    const reading how = {group, motion, share, first_handle, motions};
    upsample(points, block, positions, how, moved_positions, 0, 0);
}

__kernel void upsample_positions_and_normals(const ulong points, __global const uint* block,
                                             __global const float* positions, __global const influence_group* group,
                                             __global const uint* motion, __global const ushort* share,
                                             const uint first_handle, __global const float* motions,
                                             __global float* moved_positions, __global const float* normals,
                                             __global float* moved_normals) {
    const reading how = {group, motion, share, first_handle, motions};
    upsample(points, block, positions, how, moved_positions, normals, moved_normals);
}
