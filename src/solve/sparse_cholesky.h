#pragma once
// Sparse symmetric positive definite systems by Cholesky's factors A = L D Lᵀ: ordered once, factorised once,
// solved many times.
//
// Eigen orders (approximate minimum degree) and factorises (up-looking, row by row). The systems of a surface
// leave so little fill that this is several times faster than the dense blocks of a supernodal solver;
// tests/peers/peer_factors prints the figures. The solving is knead's own, since it is what every frame waits
// for: all right-hand sides at once and side by side, so that each number of L is read once for all of them;
// large factors are read by several workers, each for two of the sides.

#include "base/workers.h"

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

// How a factorisation ended, or that it cannot begin.
struct FactorOutcome {
    bool solved = true;
    std::string words;         // what failed, for the user; empty if nothing did
    bool lacks_memory = false; // which is no matter of the system: another time it may be solved
};

// Whether a matrix of so many rows, with so many entries, can be ordered: Eigen counts entries by int, and
// needs room for a fifth more of them and two a row.
FactorOutcome can_be_ordered(std::size_t rows, std::size_t entries);

// A fill-reducing ordering: order[i] is the row that comes i-th. It depends on the pattern alone, so one
// ordering serves all matrices of that pattern. Only where can_be_ordered().
std::vector<int> minimum_degree_order(const SparseMatrix& pattern);

// A factorised matrix.
class SparseFactor {
public:
    // So many numbers in a factor keep a core busy for some tenths of a millisecond: solve() shares them.
    static constexpr std::size_t shared_fill = 1 << 18;

    SparseFactor();
    ~SparseFactor();
    SparseFactor(SparseFactor&&) noexcept;
    SparseFactor& operator=(SparseFactor&&) noexcept;

    // Factorises `matrix`, replacing what was here. A matrix that is not positive definite, singular or badly
    // scaled, or too little memory, is an outcome with words; solve() may be called only after a good one. An
    // empty matrix is fine.
    FactorOutcome factorize(const SparseMatrix& matrix, std::span<const int> order);

    // Solves for `columns` right-hand sides at once: `values` holds, row by row, `columns` numbers each, and
    // receives the solutions in the same places. Allocates nothing for up to 4 columns.
    // With factors of at least `shared_fill` numbers two columns are a worker's work at a time. No column
    // knows of the others, so this changes no bit.
    void solve(std::span<double> values, std::size_t columns, Workers& workers);

    // Numbers in the factors L and D: the measure of an ordering.
    std::size_t fill() const;

private:
    FactorOutcome factorize_in_memory(const SparseMatrix& matrix, std::span<const int> order);

    struct Factors;
    std::unique_ptr<Factors> factors_;
};

} // namespace knead
