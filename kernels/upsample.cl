// Moves every point by the motions of the samples around it: src/upsample/upsample.h holds the formulas, and
// src/upsample/reference.cpp the same arithmetic in C++, operation by operation, so that both give the same bits.
//
// Built with -D POINTS_IN_BLOCK=256 and -D HANDLE_REACH=0.2f (src/graph/influences.h); with -D WIDE for wide rows of
// influences, without for narrow ones; with -D SIXTEEN for a CPU, without for a GPU. Motions are packed by columns, 16
// floats each, [A column 0 | A column 1 | A column 2 | d] with a fourth row of 1 c0 c1 c2
// (src/upsample/packed_motions.h): blending one is then a single vector operation, and the weights are summed on the
// way.
// A GPU's item moves one point. A CPU's takes sixteen at once: it blends the motions of each, and transposes
// the sixteen, so that what follows is the same arithmetic with a point in every lane.
//
// A group of items moves one block of 256 points (src/upsample/point_blocks.h), of those that a frame has to.

#pragma OPENCL FP_CONTRACT OFF

#ifdef WIDE
typedef uint number;
typedef uint8 number8;
#define NONE UINT_MAX
#else
typedef ushort number;
typedef ushort8 number8;
#define NONE USHRT_MAX
#endif

// What the rows are read by.
typedef struct {
    uint first_handle; // numbers from here on are handles
    uint paper;        // whether the weights are the paper's
} reading;

// weights_of() in src/graph/influences.h, of one place that is not empty.
__attribute__((always_inline)) inline float weight_of(number sample, number distance, number nearest,
                                                      number farthest, bool is_full, reading how) {
    if (is_full && nearest == farthest) return 1.0f;
    if (how.paper) return 1.0f / ((float)distance * (float)distance);
    float nearness = (float)(number)(farthest - distance);
    if (!is_full) nearness += (float)farthest;
    const float weight = nearness * nearness;
    return sample >= how.first_handle ? weight * (HANDLE_REACH * (float)farthest / (float)distance) : weight;
}

// What the handles of a row add to a blend for having no place: theirs is the point p itself.
__attribute__((always_inline)) inline float16 places_of_handles(__global const number* row, reading how,
                                                                const float* weight, int count,
                                                                __global const float* motions, float3 p) {
    const float3 half_way = 0.5f * p;
    float16 sum = (float16)(0.0f);
    for (int k = 0; k < count; ++k) {
        if (row[k] < how.first_handle) continue;
        const float16 handle = vload16(row[k], motions);
        float4 turned = handle.s0123 * half_way.x + handle.s4567 * half_way.y + handle.s89ab * half_way.z;
        turned.w = half_way.z;
        sum.s7 += weight[k] * half_way.x;
        sum.sb += weight[k] * half_way.y;
        sum.scdef += weight[k] * turned;
    }
    return sum;
}

// blended() for a row with empty places, equal distances, or a sample right at the point. Kept out of the way
// of all others.
__attribute__((noinline)) float16 rarely_blended(__global const number* row, reading how,
                                                 __global const float* motions, float3 p) {
    if (row[0] == NONE) return (float16)(0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f,
                                         0.0f, 0.0f, 0.0f, 0.0f);
    if (row[8] == 0) return vload16(row[0], motions);
    int count = 1;
    while (count < 8 && row[count] != NONE) ++count;
    float weight[8];
    float16 sum = (float16)(0.0f);
    for (int k = 0; k < count; ++k) {
        weight[k] = weight_of(row[k], row[8 + k], row[8], row[7 + count], count == 8, how);
        sum += weight[k] * vload16(row[k], motions);
    }
    return how.paper ? sum : sum + places_of_handles(row, how, weight, count, motions, p);
}

// Σ_s w_s [A_s | d_s] of one row at the point p, in .s3 the sum of the weights, by which it is to be divided, and
// Σ_s w_s c_s.
__attribute__((always_inline)) inline float16 blended(__global const number* row, reading how,
                                                      __global const float* motions, float3 p) {
    const number nearest = row[8], farthest = row[15];
    if (row[7] == NONE || nearest == 0 || nearest == farthest) return rarely_blended(row, how, motions, p);
    const number8 distance = vload8(1, row);
    float weight[8]; // in memory: from there they are multiplied with all of a motion at once
    bool near_handle = false;
    if (how.paper) {
        const float8 d = convert_float8(distance);
        vstore8(1.0f / (d * d), 0, weight);
    } else {
        const float8 nearness = convert_float8((number8)(farthest) - distance);
        float8 all = nearness * nearness;
        const uint8 sample = convert_uint8(vload8(0, row));
        near_handle = any(sample >= how.first_handle);
        if (near_handle) {
            const float8 grown = all * (HANDLE_REACH * (float)farthest / convert_float8(distance));
            all = select(all, grown, sample >= how.first_handle);
        }
        vstore8(all, 0, weight);
    }
    float16 sum = weight[0] * vload16(row[0], motions);
#pragma unroll
    for (int k = 1; k < 7; ++k) sum += weight[k] * vload16(row[k], motions);
    if (how.paper) sum += weight[7] * vload16(row[7], motions); // else it is the farthest, and weighs nothing
    if (near_handle) sum += places_of_handles(row, how, weight, 7, motions, p);
    return sum;
}

// What moves a point: one of the rows, or from their number on one motion alone.
__attribute__((always_inline)) inline float16 map_of(uint mover, ulong rows, __global const number* row,
                                                     reading how, __global const float* motions,
                                                     __global const float* p) {
    if (mover >= rows) return vload16(mover - rows, motions);
    return blended(row + 16 * (size_t)mover, how, motions, vload3(0, p));
}

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
inline float16 first_halves_shuffled(float16 a, float16 b) {
    return (float16)(a.s0, b.s0, a.s1, b.s1, a.s2, b.s2, a.s3, b.s3, a.s4, b.s4, a.s5, b.s5, a.s6, b.s6, a.s7,
                     b.s7);
}

inline float16 second_halves_shuffled(float16 a, float16 b) {
    return (float16)(a.s8, b.s8, a.s9, b.s9, a.sa, b.sa, a.sb, b.sb, a.sc, b.sc, a.sd, b.sd, a.se, b.se, a.sf,
                     b.sf);
}

// The transpose: a shuffle of the first half of all 256 numbers with the second, as of cards, turns the digits of
// their places by one, so four of them swap row and column.
__attribute__((always_inline)) inline void transpose(float16* rows) {
#pragma unroll
    for (int round = 0; round < 4; ++round) {
        float16 next[16];
#pragma unroll
        for (int i = 0; i < 8; ++i) {
            next[2 * i] = first_halves_shuffled(rows[i], rows[i + 8]);
            next[2 * i + 1] = second_halves_shuffled(rows[i], rows[i + 8]);
        }
#pragma unroll
        for (int i = 0; i < 16; ++i) rows[i] = next[i];
    }
}

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

__attribute__((always_inline)) inline void store(vector v, __global float* to, size_t count) {
    const float16 x = v.x, y = v.y, z = v.z;
    const float16 a = (float16)(x.s0, y.s0, z.s0, x.s1, y.s1, z.s1, x.s2, y.s2, z.s2, x.s3, y.s3, z.s3, x.s4,
                                y.s4, z.s4, x.s5);
    const float16 b = (float16)(y.s5, z.s5, x.s6, y.s6, z.s6, x.s7, y.s7, z.s7, x.s8, y.s8, z.s8, x.s9, y.s9,
                                z.s9, x.sa, y.sa);
    const float16 c = (float16)(z.sa, x.sb, y.sb, z.sb, x.sc, y.sc, z.sc, x.sd, y.sd, z.sd, x.se, y.se, z.se,
                                x.sf, y.sf, z.sf);
    if (count == 16) {
        vstore16(a, 0, to), vstore16(b, 1, to), vstore16(c, 2, to);
    } else {
        float all[48];
        vstore16(a, 0, all), vstore16(b, 1, all), vstore16(c, 2, all);
        for (size_t i = 0; i < 3 * count; ++i) to[i] = all[i];
    }
}

// The blends of `count` points: number c of all of them in blend[c].
__attribute__((always_inline)) inline void load_blends(__global const uint* mover, size_t count, ulong rows,
                                                       __global const number* row, reading how,
                                                       __global const float* motions,
                                                       __global const float* positions, real* blend) {
    for (size_t i = 0; i < 16; ++i) {
        const size_t point = min(i, count - 1);
        blend[i] = map_of(mover[point], rows, row, how, motions, positions + 3 * point);
    }
    transpose(blend);
}
#else
inline vector load(__global const float* from, size_t count) {
    const vector v = {from[0], from[1], from[2]};
    return v;
}

inline void store(vector v, __global float* to, size_t count) {
    to[0] = v.x, to[1] = v.y, to[2] = v.z;
}

inline void load_blends(__global const uint* mover, size_t count, ulong rows, __global const number* row,
                        reading how, __global const float* motions, __global const float* positions,
                        real* blend) {
    vstore16(map_of(*mover, rows, row, how, motions, positions), 0, blend);
}
#endif

// Where nothing is added, the coordinate is kept to the last bit, the sign of a zero included.
inline real plus(real coordinate, real displacement) {
    return select(coordinate + displacement, coordinate, displacement == 0.0f);
}

inline vector moved(vector p, const real* a) {
    const real share = 1.0f / a[3];
    const vector q = {p.x - a[7] * share, p.y - a[11] * share, p.z - a[15] * share};
    const vector result = {plus(p.x, (a[0] * q.x + a[4] * q.y + a[8] * q.z + a[12]) * share),
                           plus(p.y, (a[1] * q.x + a[5] * q.y + a[9] * q.z + a[13]) * share),
                           plus(p.z, (a[2] * q.x + a[6] * q.y + a[10] * q.z + a[14]) * share)};
    return result;
}

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
    const real share = 1.0f / blend[3];
    const vector a = {blend[0] * share + 1.0f, blend[1] * share, blend[2] * share};
    const vector b = {blend[4] * share, blend[5] * share + 1.0f, blend[6] * share};
    const vector c = {blend[8] * share, blend[9] * share, blend[10] * share + 1.0f};
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
upsample(ulong points, __global const uint* block, __global const float* positions, __global const uint* mover,
         ulong rows, __global const number* row, reading how, __global const float* motions,
         __global float* moved_positions, __global const float* normals, __global float* moved_normals) {
    const size_t begin =
        POINTS_IN_BLOCK * (size_t)block[get_group_id(0)] + POINTS_PER_ITEM * get_local_id(0);
    const size_t end = min(begin + POINTS_PER_ITEM, (size_t)points);
    for (size_t first = begin; first < end; first += POINTS_AT_ONCE) {
        const size_t count = min((size_t)POINTS_AT_ONCE, end - first);
        real blend[16];
        load_blends(mover + first, count, rows, row, how, motions, positions + 3 * first, blend);
        store(moved(load(positions + 3 * first, count), blend), moved_positions + 3 * first, count);
        if (normals) store(turned(load(normals + 3 * first, count), blend), moved_normals + 3 * first, count);
    }
}

__kernel void upsample_positions(const ulong points, __global const uint* block,
                                 __global const float* positions, __global const uint* mover,
                                 const ulong rows, __global const number* row, const uint first_handle,
                                 const uint paper, __global const float* motions, __global float* moved_positions) {
    const reading how = {first_handle, paper};
    upsample(points, block, positions, mover, rows, row, how, motions, moved_positions, 0, 0);
}

__kernel void upsample_positions_and_normals(const ulong points, __global const uint* block,
                                             __global const float* positions, __global const uint* mover,
                                             const ulong rows, __global const number* row,
                                             const uint first_handle, const uint paper,
                                             __global const float* motions, __global float* moved_positions,
                                             __global const float* normals, __global float* moved_normals) {
    const reading how = {first_handle, paper};
    upsample(points, block, positions, mover, rows, row, how, motions, moved_positions, normals,
             moved_normals);
}
