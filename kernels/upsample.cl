// Moves every point by the motions of the samples around it: src/upsample/upsample.h holds the formulas, and
// src/upsample/reference.cpp the same arithmetic in C++, operation by operation. Both give the same bits but
// for one thing: what moves points, which is most of the work, fuses products and sums here (one rounding)
// where the device can.
//
// Built with -D POINTS_IN_BLOCK=256, -D POINTS_IN_GROUP=16, -D WHOLE_SHARE=65535, and with -D LANES=16 for a CPU or
// -D LANES=4 for a GPU. Motions are packed by columns, 16 floats each, [A column 0 | A column 1 | A column 2 | d] with
// a fourth row of 0 c0 c1 c2 (src/upsample/packed_motions.h); what moves which point comes by groups of sixteen points
// (src/upsample/influence_groups.h, src/upsample/shares.h). There is a point in every lane: a CPU's item moves a
// block of 256 points, a group after the other; a GPU's moves a quarter of a group, for which a motion is read once.
//
// A group of items moves one block of 256 points (src/upsample/point_blocks.h), of those that a frame has to.

#pragma OPENCL FP_CONTRACT OFF

// From so many points on, no cache holds the moved ones until they are looked at.
#define STREAMED_POINTS 750000

#define CONCATENATED(a, b) a##b
#define VECTOR_OF(type, lanes) CONCATENATED(type, lanes)
typedef VECTOR_OF(float, LANES) real;
typedef VECTOR_OF(int, LANES) truth;
typedef VECTOR_OF(ushort, LANES) shares;

#if LANES == 16
#define POINTS_PER_ITEM POINTS_IN_BLOCK
#else
#define POINTS_PER_ITEM LANES
#endif

typedef struct {
    real x, y, z;
} vector;

#if LANES == 16
// x, y and z of sixteen points from how they lie in memory.
__attribute__((always_inline)) inline vector apart(const float16* m) {
    const float16 a = m[0], b = m[1], c = m[2];
    const vector v = {(float16)(a.s0369, a.scf, b.s258b, b.se, c.s147a, c.sd),
                      (float16)(a.s147a, a.sd, b.s0369, b.scf, c.s258b, c.se),
                      (float16)(a.s258b, a.se, b.s147a, b.sd, c.s0369, c.scf)};
    return v;
}

// And back, from two vectors at a time, which is a single instruction each. Written out by elements, LLVM 14 makes some
// fifty of it.
__attribute__((always_inline)) inline void together(vector v, float16* m) {
    const float16 axy = __builtin_shufflevector(v.x, v.y, 0, 16, -1, 1, 17, -1, 2, 18, -1, 3, 19, -1, 4, 20, -1, 5);
    m[0] = __builtin_shufflevector(axy, v.z, 0, 1, 16, 3, 4, 17, 6, 7, 18, 9, 10, 19, 12, 13, 20, 15);
    const float16 bxy = __builtin_shufflevector(v.x, v.y, 21, -1, 6, 22, -1, 7, 23, -1, 8, 24, -1, 9, 25, -1, 10, 26);
    m[1] = __builtin_shufflevector(bxy, v.z, 0, 21, 2, 3, 22, 5, 6, 23, 8, 9, 24, 11, 12, 25, 14, 15);
    const float16 cxy = __builtin_shufflevector(v.x, v.y, -1, 11, 27, -1, 12, 28, -1, 13, 29, -1, 14, 30, -1, 15, 31, -1);
    m[2] = __builtin_shufflevector(cxy, v.z, 26, 1, 2, 27, 4, 5, 28, 7, 8, 29, 10, 11, 30, 13, 14, 31);
}

__attribute__((always_inline)) inline void read_whole(__global const float* from, real* m) {
    m[0] = vload16(0, from), m[1] = vload16(1, from), m[2] = vload16(2, from);
}

// vstore16() comes out as three narrow stores each, and what waits to be written then fills the processor's queue.
typedef float16 __attribute__((aligned(4))) float16_anywhere;

// `streamed`: past the caches, whole lines of them. These stores are seen by others after the next locked instruction,
// and no device tells that an item is done without one.
__attribute__((always_inline)) inline void write_whole(const real* m, __global float* to, bool streamed) {
    __global float16_anywhere* const t = (__global float16_anywhere*)to;
    if (streamed && (size_t)to % sizeof(float16) == 0) {
        __global float16* const lines = (__global float16*)to;
        for (int k = 0; k < 3; ++k) __builtin_nontemporal_store(m[k], lines + k);
    } else {
        t[0] = m[0], t[1] = m[1], t[2] = m[2];
    }
}

// The shares of an entry in the points of its group.
__attribute__((always_inline)) inline shares share_of(__global const ushort* share, size_t entry, uint lane) {
    return vload16(entry, share);
}

__attribute__((always_inline)) inline real as_real(shares whole) {
    return convert_float16(convert_int16(whole));
}

__attribute__((always_inline)) inline shares without(shares all, shares some) {
    return all - some;
}
#else
// What is read and written at once lies at multiples of its size.
inline vector apart(const float4* m) {
    const float4 a = m[0], b = m[1], c = m[2];
    const vector v = {(float4)(a.s03, b.s2, c.s1), (float4)(a.s1, b.s03, c.s2), (float4)(a.s2, b.s1, c.s03)};
    return v;
}

inline void together(vector v, float4* m) {
    m[0] = (float4)(v.x.s0, v.y.s0, v.z.s0, v.x.s1);
    m[1] = (float4)(v.y.s1, v.z.s1, v.x.s2, v.y.s2);
    m[2] = (float4)(v.z.s2, v.x.s3, v.y.s3, v.z.s3);
}

inline void read_whole(__global const float* from, real* m) {
    __global const float4* const f = (__global const float4*)from;
    m[0] = f[0], m[1] = f[1], m[2] = f[2];
}

inline void write_whole(const real* m, __global float* to, bool streamed) {
    __global float4* const t = (__global float4*)to;
    t[0] = m[0], t[1] = m[1], t[2] = m[2];
}

inline shares share_of(__global const ushort* share, size_t entry, uint lane) {
    return *(__global const ushort4*)(share + POINTS_IN_GROUP * entry + lane);
}

inline real as_real(shares whole) {
    return convert_float4(whole);
}

// Two at a time: none has less than it is to lose.
inline shares without(shares all, shares some) {
    return as_ushort4(as_uint2(all) - as_uint2(some));
}
#endif

// Floats as they lie in memory: those of `count` points, and zeros.
__attribute__((always_inline)) inline vector load(__global const float* from, uint count) {
    real whole[3];
    if (count == LANES) {
        read_whole(from, whole);
    } else {
        float* const some = (float*)whole;
#pragma unroll
        for (uint i = 0; i < 3 * LANES; ++i) some[i] = i < 3 * count ? from[i] : 0.0f;
    }
    return apart(whole);
}

__attribute__((always_inline)) inline void store(vector v, __global float* to, uint count, bool streamed) {
    real whole[3];
    together(v, whole);
    if (count == LANES) {
        write_whole(whole, to, streamed);
    } else {
        const float* const all = (const float*)whole;
#pragma unroll
        for (uint i = 0; i < 3 * LANES; ++i)
            if (i < 3 * count) to[i] = all[i];
    }
}

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

// So many are read before the first of them is used: a GPU waits for them together. More cost registers, and so does
// whatever else is kept while motions are added: fewer items then run at once.
#if LANES == 16
#define ENTRIES_AT_ONCE 1
#else
#define ENTRIES_AT_ONCE 2
#endif

#pragma OPENCL FP_CONTRACT ON

// Adds w [A | d] to the blend, number c of them to blend[c], and w c.
__attribute__((always_inline)) inline void add_motion(__global const float* motion, real weight, real* blend) {
#if LANES == 16
#pragma unroll
    for (int c = 0; c < 16; ++c)
        if (c != 3) blend[c] += weight * motion[c];
#else
    __global const float4* const columns = (__global const float4*)motion;
#pragma unroll
    for (int c = 0; c < 4; ++c) {
        const float4 column = columns[c];
        blend[4 * c] += weight * column.x;
        blend[4 * c + 1] += weight * column.y;
        blend[4 * c + 2] += weight * column.z;
        if (c > 0) blend[4 * c + 3] += weight * column.w;
    }
#endif
}

inline real weight_of(shares share) {
    return as_real(share) * (1.0f / WHOLE_SHARE);
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

// Those of a group's handles, which come last.
__attribute__((always_inline)) inline void add_places(reading how, influence_group own, uint lane,
                                                      __global const float* points, uint count, real* blend) {
    uint entry = own.first_entry + own.entries;
    if ((own.entries > 0 ? how.motion[entry - 1] : own.motion) < how.first_handle) return;
    const vector p = load(points, count);
    shares left = WHOLE_SHARE;
    for (; entry > own.first_entry && how.motion[entry - 1] >= how.first_handle; --entry) {
        const shares share = share_of(how.share, entry - 1, lane);
        left = without(left, share);
        add_place(how.motions + 16 * (size_t)how.motion[entry - 1], weight_of(share), p, blend);
    }
    if (own.motion >= how.first_handle)
        add_place(how.motions + 16 * (size_t)own.motion, weight_of(left), p, blend);
}

// Adds Σ_s w_s [A_s | d_s], and Σ_s w_s c_s.
__attribute__((always_inline)) inline void add_motions(reading how, influence_group own, uint lane, real* blend) {
    const uint end = own.first_entry + own.entries;
    shares left = WHOLE_SHARE;
    for (uint entry = own.first_entry; entry < end; entry += ENTRIES_AT_ONCE) {
        uint motion[ENTRIES_AT_ONCE];
        shares share[ENTRIES_AT_ONCE];
#pragma unroll
        for (uint k = 0; k < ENTRIES_AT_ONCE; ++k)
            if (k == 0 || entry + k < end) {
                motion[k] = how.motion[entry + k];
                share[k] = share_of(how.share, entry + k, lane);
            }
#pragma unroll
        for (uint k = 0; k < ENTRIES_AT_ONCE; ++k)
            if (k == 0 || entry + k < end) {
                left = without(left, share[k]);
                add_motion(how.motions + 16 * (size_t)motion[k], weight_of(share[k]), blend);
            }
    }
    add_motion(how.motions + 16 * (size_t)own.motion, weight_of(left), blend);
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

#if LANES == 4
// A GPU's item waits for memory more than it computes: what it will read is asked for at the start. (NVIDIA's compiler
// makes nothing of prefetch().)
inline void ask_for(__global const void* from) {
#ifdef __NV_CL_C_VERSION
    asm volatile("prefetch.global.L2 [%0];" : : "l"(from));
#else
    prefetch((__global const char*)from, 1);
#endif
}

// The shares of a group are asked for by the items that move its points, a line of memory each.
#define SHARES_IN_LINE 64

inline void ask_for_shares(reading how, influence_group own, uint lane) {
    const size_t ahead = SHARES_IN_LINE * (lane / LANES);
    if (ahead < POINTS_IN_GROUP * (size_t)own.entries)
        ask_for(how.share + POINTS_IN_GROUP * (size_t)own.first_entry + ahead);
}
#endif

// Moves `count` points from `first` on, at most as many as there are lanes.
__attribute__((always_inline)) inline void
move_points(uint first, uint count, bool streamed, __global const float* positions, reading how,
            __global float* moved_positions, __global const float* normals, __global float* moved_normals) {
    const size_t at = 3 * (size_t)first;
    const uint lane = first % POINTS_IN_GROUP;
    const influence_group own = how.group[first / POINTS_IN_GROUP];
#if LANES == 4
    ask_for_shares(how, own, lane);
    ask_for(positions + at);
    if (normals) ask_for(normals + at);
#endif
    real blend[16];
#pragma unroll
    for (int c = 0; c < 16; ++c) blend[c] = 0.0f;
    add_places(how, own, lane, positions + at, count, blend);
    add_motions(how, own, lane, blend);
    const vector p = load(positions + at, count); // again: kept, it would take registers
    const vector n = normals ? load(normals + at, count) : p; // no compiler moves a read across what is written
    store(moved(p, blend), moved_positions + at, count, streamed);
    if (normals) store(turned(n, blend), moved_normals + at, count, streamed);
}

// Moves this group's block of those listed. `normals` is null, or `moved_normals` has room for them.
__attribute__((always_inline)) inline void
upsample(ulong points, __global const uint* block, __global const float* positions, reading how,
         __global float* moved_positions, __global const float* normals, __global float* moved_normals) {
    const uint begin = POINTS_IN_BLOCK * block[get_group_id(0)] + POINTS_PER_ITEM * (uint)get_local_id(0);
    if (begin >= points) return;
    const uint count = min((ulong)POINTS_PER_ITEM, points - begin);
    const bool streamed = points >= STREAMED_POINTS;
    for (uint done = 0; done < count; done += LANES)
        move_points(begin + done, min((uint)LANES, count - done), streamed, positions, how, moved_positions,
                    normals, moved_normals);
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

// Lowest and highest x, y, z of a group of items, and where they put them together.
typedef struct {
    float lowest[3], highest[3];
} box;

inline void add_point(__global const float* p, box* around) {
    // A difference with itself is 0 for finite numbers only.
    if (!(p[0] - p[0] + (p[1] - p[1]) + (p[2] - p[2]) == 0.0f)) return;
    for (int axis = 0; axis < 3; ++axis) {
        around->lowest[axis] = fmin(around->lowest[axis], p[axis]);
        around->highest[axis] = fmax(around->highest[axis], p[axis]);
    }
}

inline void add_box(__local const box* other, box* around) {
    for (int axis = 0; axis < 3; ++axis) {
        around->lowest[axis] = fmin(around->lowest[axis], other->lowest[axis]);
        around->highest[axis] = fmax(around->highest[axis], other->highest[axis]);
    }
}

// The box around the finite points of each block of those listed, in the order of the list.
__kernel void bound_blocks(const ulong points, __global const uint* block, __global const float* positions,
                           __global box* around) {
    const size_t begin = POINTS_IN_BLOCK * (size_t)block[get_group_id(0)];
    const size_t end = min(begin + POINTS_IN_BLOCK, (size_t)points);
    box own = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
    for (size_t point = begin + get_local_id(0); point < end; point += get_local_size(0))
        add_point(positions + 3 * point, &own);
    __local box boxes[POINTS_IN_BLOCK / POINTS_PER_ITEM];
    boxes[get_local_id(0)] = own;
    for (size_t rest = get_local_size(0) / 2; rest > 0; rest /= 2) {
        barrier(CLK_LOCAL_MEM_FENCE);
        if (get_local_id(0) < rest) {
            add_box(&boxes[get_local_id(0) + rest], &own);
            boxes[get_local_id(0)] = own;
        }
    }
    if (get_local_id(0) == 0) around[get_group_id(0)] = own;
}
