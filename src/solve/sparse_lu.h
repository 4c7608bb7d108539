#pragma once
// Sparse symmetric positive definite systems by SuperLU: ordered once, factorised once, solved many times.
//
// SuperLU is called directly and in its symmetric mode (diagonal pivots, no equilibration, no refinement),
// with an approximate minimum degree ordering of the symmetric matrix applied beforehand: 3 to 6 times faster
// than through its expert driver, and the fill is that of a Cholesky factor.

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace knead {

// A square matrix in compressed columns with both triangles present; rows ascend within a column.
struct SparseMatrix {
    std::vector<int> first; // n + 1
    std::vector<int> row;
    std::vector<double> value;

    int size() const { return first.empty() ? 0 : static_cast<int>(first.size()) - 1; }
};

// A fill-reducing ordering: order[i] is the row that comes i-th. It depends on the pattern alone, so one
// ordering serves all matrices of that pattern.
std::vector<int> minimum_degree_order(const SparseMatrix& pattern);

// How a factorisation ended.
struct FactorOutcome {
    bool solved = true;
    std::string words; // what failed, for the user; empty if nothing did
};

// A factorised matrix.
class SparseFactor {
public:
    SparseFactor();
    ~SparseFactor();
    SparseFactor(SparseFactor&&) noexcept;
    SparseFactor& operator=(SparseFactor&&) noexcept;

    // Factorises `matrix`, replacing what was here. A singular or badly scaled matrix, or too little memory,
    // is an outcome with words; solve() may be called only after a good one. An empty matrix is fine.
    FactorOutcome factorize(const SparseMatrix& matrix, std::span<const int> order);

    // Solves for `columns` right-hand sides at once; `values` holds them one after the other, `size` numbers
    // each, and receives the solutions.
    void solve(std::span<double> values, std::size_t columns);

    // Numbers in the two factors: the measure of an ordering.
    std::size_t fill() const;

private:
    struct Factors;
    std::unique_ptr<Factors> factors_;
};

} // namespace knead
