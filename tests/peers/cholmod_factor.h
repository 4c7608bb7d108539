#pragma once
// CHOLMOD behind the steps of solve/sparse_cholesky.h, for two matrices of one pattern.

#include "solve/sparse_cholesky.h"

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace knead::peers {

enum class CholmodKind { automatic, simplicial, supernodal };

// Ordered by CHOLMOD's own AMD, with its postordering; LLᵀ. Throws Error (numeric) where CHOLMOD fails.
class CholmodSystem {
public:
    explicit CholmodSystem(CholmodKind kind);
    ~CholmodSystem();

    // The ordering and the symbolic factorisation.
    void analyze(const SparseMatrix& pattern);

    // The number `which` (0 or 1) of the factors, from the analysis.
    void factorize(std::size_t which, const SparseMatrix& matrix);

    // For `columns` right-hand sides one after the other, which become the solutions.
    void solve(std::size_t which, std::span<double> values, std::size_t columns);

    bool is_supernodal() const; // after factorize()
    std::string version() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace knead::peers
