// Moves every point by the motions of the samples around it: src/upsample/upsample.h holds the formulas, and
// src/upsample/reference.cpp the same arithmetic in C++, operation by operation, so that both give the same bits.
//
// Built with -D WIDE for wide rows of influences, without for narrow ones. One work item moves one point; what
// lies between items is one row's 8 samples and 8 distances, the point, and the result. Motions are packed by
// columns, 16 floats each, [A column 0 | A column 1 | A column 2 | b] with a fourth row of 1 0 0 0: blending
// one is then a single vector operation, applying it needs no sums across a vector, and the weights are
// summed on the way.

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

// weights_of() in src/graph/influences.h, of one place that is not empty.
inline float weight_of(number distance, number nearest, number farthest, uint paper) {
    if (nearest == farthest) return 1.0f;
    if (paper) return 1.0f / ((float)distance * (float)distance);
    const float nearness = (float)(number)(farthest - distance);
    return nearness * nearness;
}

// Σ_s w_s [A_s | b_s] of a row with empty places, equal distances, or a sample right at the point. Kept out
// of the way of all others.
__attribute__((noinline)) float16 rarely_blended(__global const number* row, uint paper,
                                                 __global const float* motions) {
    if (row[0] == NONE) return (float16)(0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f,
                                         0.0f, 0.0f, 0.0f, 0.0f);
    if (row[8] == 0) return vload16(row[0], motions);
    int count = 1;
    while (count < 8 && row[count] != NONE) ++count;
    float16 sum = (float16)(0.0f);
    for (int k = 0; k < count; ++k)
        sum += weight_of(row[8 + k], row[8], row[7 + count], paper) * vload16(row[k], motions);
    return sum;
}

// Σ_s w_s [A_s | b_s] of one row, and in .s3 the sum of the weights, by which it is to be divided.
__attribute__((always_inline)) inline float16 blended(__global const number* row, uint paper,
                                                      __global const float* motions) {
    const number nearest = row[8], farthest = row[15];
    if (row[7] == NONE || nearest == 0 || nearest == farthest) return rarely_blended(row, paper, motions);
    const number8 distance = vload8(1, row);
    float weight[8]; // in memory: from there they are multiplied with all of a motion at once
    if (paper) {
        const float8 d = convert_float8(distance);
        vstore8(1.0f / (d * d), 0, weight);
    } else {
        const float8 nearness = convert_float8((number8)(farthest) - distance);
        vstore8(nearness * nearness, 0, weight);
    }
    float16 sum = weight[0] * vload16(row[0], motions);
#pragma unroll
    for (int k = 1; k < 7; ++k) sum += weight[k] * vload16(row[k], motions);
    if (paper) sum += weight[7] * vload16(row[7], motions); // else it is the farthest, and weighs nothing
    return sum;
}

// What moves a point: one of the rows, or from their number on one motion alone.
__attribute__((always_inline)) inline float16 map_of(uint mover, ulong rows, __global const number* row,
                                                     uint paper, __global const float* motions) {
    if (mover >= rows) return vload16(mover - rows, motions);
    return blended(row + 16 * (size_t)mover, paper, motions);
}

// Where nothing is added, p is kept to the last bit, the sign of a zero included.
inline float3 moved(float3 p, float16 map) {
    const float3 d = (map.s012 * p.x + map.s456 * p.y + map.s89a * p.z + map.scde) * (1.0f / map.s3);
    return select(p + d, p, d == (float3)(0.0f));
}

inline float dot_in_order(float3 a, float3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// The cofactor matrix of I + A has the cross products of its columns for columns. With u × v written as
// (u v.yzx - u.yzx v).yzx, the outer turn of the components is done once for all three.
inline float3 turned(float3 n, float16 map) {
    const float share = 1.0f / map.s3;
    const float3 a = map.s012 * share + (float3)(1.0f, 0.0f, 0.0f);
    const float3 b = map.s456 * share + (float3)(0.0f, 1.0f, 0.0f);
    const float3 c = map.s89a * share + (float3)(0.0f, 0.0f, 1.0f);
    const float3 t = ((b * c.yzx - b.yzx * c) * n.x + (c * a.yzx - c.yzx * a) * n.y +
                      (a * b.yzx - a.yzx * b) * n.z)
                         .yzx;
    // Zero, infinite or not a number: there is no length to restore, and the normal stays as it is.
    const float ratio = dot_in_order(n, n) / dot_in_order(t, t);
    if (!(ratio > 0.0f && ratio <= FLT_MAX)) return n;
    const float3 result = t * sqrt(ratio);
    return select(result, n, result == n);
}

__kernel void upsample_positions(const ulong points, __global const float* positions,
                                 __global const uint* mover, const ulong rows, __global const number* row,
                                 const uint paper, __global const float* motions,
                                 __global float* moved_positions) {
    const size_t i = get_global_id(0);
    if (i >= points) return;
    const float16 map = map_of(mover[i], rows, row, paper, motions);
    vstore3(moved(vload3(i, positions), map), i, moved_positions);
}

__kernel void upsample_positions_and_normals(const ulong points, __global const float* positions,
                                             __global const uint* mover, const ulong rows,
                                             __global const number* row, const uint paper,
                                             __global const float* motions, __global float* moved_positions,
                                             __global const float* normals, __global float* moved_normals) {
    const size_t i = get_global_id(0);
    if (i >= points) return;
    const float16 map = map_of(mover[i], rows, row, paper, motions);
    vstore3(moved(vload3(i, positions), map), i, moved_positions);
    vstore3(turned(vload3(i, normals), map), i, moved_normals);
}
