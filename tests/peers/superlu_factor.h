#pragma once
// SuperLU behind the steps of solve/sparse_cholesky.h: in symmetric mode (diagonal pivots, no equilibration,
// no refinement), called directly, after the same ordering.

#include "solve/sparse_cholesky.h"

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace knead::peers {

class SuperLuFactor {
public:
    SuperLuFactor();
    ~SuperLuFactor();

    // Throws Error (numeric) where SuperLU fails.
    void factorize(const SparseMatrix& matrix, std::span<const int> order);

    // For `columns` right-hand sides one after the other, which become the solutions.
    void solve(std::span<double> values, std::size_t columns);

private:
    struct Factors;
    std::unique_ptr<Factors> factors_;
};

} // namespace knead::peers
