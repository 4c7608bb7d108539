// Moves every point by the motions of the samples around it: src/upsample/upsample.h holds the formulas, and
// src/upsample/reference.cpp the same arithmetic in C++, operation by operation, so that both give the same bits.
//
// Built with -D K=<influences per row>. One work item moves one point; what lies between items is one row's K
// indices and weights, the point, and the result. Motions are packed by columns, 16 floats each,
// [A column 0 | A column 1 | A column 2 | b] with a fourth, unused row: blending one is then a single vector
// operation and applying it needs no sums across a vector.

#pragma OPENCL FP_CONTRACT OFF

// Σ_s w_s [A_s | b_s] of one row. Tails of weight 0 repeat the row's first sample, which is at hand: adding
// them costs less than a branch for each would.
inline float16 blended(__global const uint* sample, __global const float* weight, __global const float* motions) {
    float16 sum = (float16)(0.0f);
#pragma unroll
    for (int k = 0; k < K; ++k) sum += weight[k] * vload16(sample[k], motions);
    return sum;
}

// Where nothing is added, p is kept to the last bit, the sign of a zero included.
inline float3 moved(float3 p, float16 map) {
    const float3 d = map.s012 * p.x + map.s456 * p.y + map.s89a * p.z + map.scde;
    return select(p + d, p, d == (float3)(0.0f));
}

inline float dot_in_order(float3 a, float3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// The cofactor matrix of I + A has the cross products of its columns for columns. With u × v written as
// (u v.yzx - u.yzx v).yzx, the outer turn of the components is done once for all three.
inline float3 turned(float3 n, float16 map) {
    const float3 a = map.s012 + (float3)(1.0f, 0.0f, 0.0f);
    const float3 b = map.s456 + (float3)(0.0f, 1.0f, 0.0f);
    const float3 c = map.s89a + (float3)(0.0f, 0.0f, 1.0f);
    const float3 t = ((b * c.yzx - b.yzx * c) * n.x + (c * a.yzx - c.yzx * a) * n.y +
                      (a * b.yzx - a.yzx * b) * n.z)
                         .yzx;
    // Zero, infinite or not a number: there is no length to restore, and the normal stays as it is.
    const float ratio = dot_in_order(n, n) / dot_in_order(t, t);
    if (!(ratio > 0.0f && ratio <= FLT_MAX)) return n;
    const float3 result = t * sqrt(ratio);
    return select(result, n, result == n);
}

__kernel void upsample_positions(const ulong points, __global const float* positions, __global const uint* row,
                                 __global const uint* sample, __global const float* weight,
                                 __global const float* motions, __global float* moved_positions) {
    const size_t i = get_global_id(0);
    if (i >= points) return;
    const size_t first = (size_t)row[i] * K;
    const float16 map = blended(sample + first, weight + first, motions);
    vstore3(moved(vload3(i, positions), map), i, moved_positions);
}

__kernel void upsample_positions_and_normals(const ulong points, __global const float* positions,
                                             __global const uint* row, __global const uint* sample,
                                             __global const float* weight, __global const float* motions,
                                             __global float* moved_positions, __global const float* normals,
                                             __global float* moved_normals) {
    const size_t i = get_global_id(0);
    if (i >= points) return;
    const size_t first = (size_t)row[i] * K;
    const float16 map = blended(sample + first, weight + first, motions);
    vstore3(moved(vload3(i, positions), map), i, moved_positions);
    vstore3(turned(vload3(i, normals), map), i, moved_normals);
}
