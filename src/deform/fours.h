#pragma once
// Vectors and matrices of three in the four numbers that processors compute with at once.

#include "base/types.h"

namespace knead {

// The three numbers of a vector, and one more that is 0, in the vectors of GCC and Clang.
using Four = double __attribute__((vector_size(32)));

// A matrix, column by column.
struct alignas(32) Columns { // which GCC does not see to by itself where the processor may be an old one
    Four of[3] = {};
};

// All of these are inlined into functions that are compiled for several processors (base/new_processors.h).

[[gnu::always_inline]] inline void set_four(const Vec3d& vector, Four& four) {
    four = Four{vector[0], vector[1], vector[2], 0};
}

[[gnu::always_inline]] inline void set_columns(const Mat3d& matrix, Columns& columns) {
    for (int column = 0; column < 3; ++column)
        columns.of[column] = Four{matrix(0, column), matrix(1, column), matrix(2, column), 0};
}

[[gnu::always_inline]] inline Vec3d vector_of(const Four& four) {
    return {four[0], four[1], four[2]};
}

[[gnu::always_inline]] inline Mat3d matrix_of(const Columns& columns) {
    Mat3d matrix;
    for (int column = 0; column < 3; ++column) matrix.col(column) = vector_of(columns.of[column]);
    return matrix;
}

[[gnu::always_inline]] inline double dot_of(const Four& a, const Four& b) {
    const Four products = a * b;
    return products[0] + products[1] + products[2];
}

// Adds matrix · by, a column of a product or all of it.
template<typename Three> // Vec3d or Four
[[gnu::always_inline]] inline void add_product(const Columns& matrix, const Three& by, Four& sum) {
    sum += matrix.of[0] * by[0] + matrix.of[1] * by[1] + matrix.of[2] * by[2];
}
[[gnu::always_inline]] inline void add_product(const Columns& matrix, const Mat3d& by, Columns& sum) {
    for (int column = 0; column < 3; ++column)
        sum.of[column] +=
            matrix.of[0] * by(0, column) + matrix.of[1] * by(1, column) + matrix.of[2] * by(2, column);
}

// Adds left · rightᵀ.
[[gnu::always_inline]] inline void add_outer(const Four& left, const Vec3d& right, Columns& sum) {
    for (int column = 0; column < 3; ++column) sum.of[column] += left * right[column];
}

} // namespace knead
