#include "solve/sparse_cholesky.h"

#include "base/require.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numeric>

namespace knead {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

// Eigen's factorisation, which tells how much its factor will hold before there is one.
class Ldlt : public Eigen::SimplicialLDLT<Matrix, Eigen::Upper, Eigen::NaturalOrdering<int>> {
public:
    // Of L after analyzePattern(), its diagonal of ones left out.
    std::size_t entries() const {
        return std::accumulate(m_nonZerosPerCol.begin(), m_nonZerosPerCol.end(), std::size_t{0});
    }
    const Matrix& lower() const { return m_matrix; }
};

// The upper triangle of the matrix with rows and columns in `order`: entries are met by ascending new rows,
// so they ascend in each column too.
Matrix reordered_upper(const SparseMatrix& matrix, std::span<const int> order) {
    const int size = matrix.size();
    std::vector<int> position(order.size());
    for (int i = 0; i < size; ++i) position[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])] = i;
    const auto for_each_entry = [&](auto&& visit) { // (new row, new column, value)
        for (int i = 0; i < size; ++i) {
            const auto old = static_cast<std::size_t>(order[static_cast<std::size_t>(i)]);
            for (int at = matrix.first[old]; at < matrix.first[old + 1]; ++at) {
                const auto entry = static_cast<std::size_t>(at);
                const int column = position[static_cast<std::size_t>(matrix.row[entry])];
                if (column >= i) visit(i, column, matrix.value[entry]);
            }
        }
    };
    Matrix upper(size, size);
    int* first = upper.outerIndexPtr();
    for_each_entry([&](int, int column, double) { ++first[column + 1]; });
    std::partial_sum(first, first + size + 1, first);
    upper.resizeNonZeros(first[size]);
    std::vector<int> next(first, first + size);
    for_each_entry([&](int row, int column, double value) {
        const int at = next[static_cast<std::size_t>(column)]++;
        upper.innerIndexPtr()[at] = row;
        upper.valuePtr()[at] = value;
    });
    return upper;
}

FactorOutcome singular_at(int row, int size) {
    return {false, "the system of " + std::to_string(size) + " samples is singular at its row " +
                       std::to_string(row)};
}

FactorOutcome too_large(std::size_t size) {
    return {false,
            "there is not enough memory to factorise the system of " + std::to_string(size) + " samples"};
}

// The diagonal; zero where an entry is missing.
std::vector<double> diagonal_of(const SparseMatrix& matrix) {
    std::vector<double> diagonal(static_cast<std::size_t>(matrix.size()), 0);
    for (std::size_t column = 0; column < diagonal.size(); ++column)
        for (int at = matrix.first[column]; at < matrix.first[column + 1]; ++at)
            if (matrix.row[static_cast<std::size_t>(at)] == static_cast<int>(column))
                diagonal[column] = matrix.value[static_cast<std::size_t>(at)];
    return diagonal;
}

// A pivot of a positive definite matrix is part of its diagonal. What rounding leaves of a singular one is
// 1e-16 of it, and some more after many steps; of a chain of a million samples held at one end, 1e-6.
constexpr double smallest_pivot = 1e-11;

constexpr std::size_t columns_at_once = 4;

} // namespace

struct SparseFactor::Factors {
    std::vector<int> order; // the row that comes i-th
    Ldlt ldlt;
    std::vector<double> inverse_pivot; // 1/D; empty where there are no factors
    std::vector<double> permuted;      // work space of solve(): right-hand sides in order
};

FactorOutcome can_be_ordered(std::size_t rows, std::size_t entries) {
    constexpr std::size_t most = std::numeric_limits<int>::max();
    const bool fits = rows <= most && entries <= most && entries + entries / 5 + 2 * rows <= most;
    return fits ? FactorOutcome{} : too_large(rows);
}

std::vector<int> minimum_degree_order(const SparseMatrix& pattern) {
    const int size = pattern.size();
    if (size == 0) return {};
    require(can_be_ordered(pattern.first.size() - 1, pattern.row.size()).solved,
            "entries are counted by int");
    const Eigen::Map<const Matrix> map(size, size, static_cast<Eigen::Index>(pattern.row.size()),
                                       pattern.first.data(), pattern.row.data(), pattern.value.data());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
    Eigen::AMDOrdering<int>()(map.selfadjointView<Eigen::Lower>(), permutation);
    return {permutation.indices().data(), permutation.indices().data() + size};
}

SparseFactor::SparseFactor() : factors_(std::make_unique<Factors>()) {}
SparseFactor::~SparseFactor() = default;
SparseFactor::SparseFactor(SparseFactor&&) noexcept = default;
SparseFactor& SparseFactor::operator=(SparseFactor&&) noexcept = default;

FactorOutcome SparseFactor::factorize(const SparseMatrix& matrix, std::span<const int> order) {
    try {
        return factorize_in_memory(matrix, order);
    } catch (const std::bad_alloc&) {
        FactorOutcome outcome = too_large(order.size());
        outcome.lacks_memory = true;
        return outcome;
    }
}

FactorOutcome SparseFactor::factorize_in_memory(const SparseMatrix& matrix, std::span<const int> order) {
    factors_ = std::make_unique<Factors>();
    Factors& factors = *factors_;
    const int size = matrix.size();
    if (size == 0) return {};
    if (!std::ranges::all_of(matrix.value, [](double value) { return std::isfinite(value); }))
        return {false, "the system holds a number that is not finite"};
    const std::vector<double> diagonal = diagonal_of(matrix);
    for (std::size_t row = 0; row < diagonal.size(); ++row)
        if (!(diagonal[row] > 0)) return singular_at(static_cast<int>(row), size);

    const Matrix upper = reordered_upper(matrix, order);
    factors.ldlt.analyzePattern(upper);
    if (factors.ldlt.entries() > std::numeric_limits<int>::max()) return too_large(order.size());
    factors.ldlt.factorize(upper);
    factors.permuted.reserve(columns_at_once * static_cast<std::size_t>(size));
    // Where a pivot is exactly zero, Eigen stops there.
    factors.order.assign(order.begin(), order.end());
    std::vector<double> inverse(order.size());
    const auto& pivots = factors.ldlt.vectorD();
    for (std::size_t i = 0; i < inverse.size(); ++i) {
        const double pivot = pivots[static_cast<Eigen::Index>(i)];
        if (!(pivot > smallest_pivot * diagonal[static_cast<std::size_t>(order[i])]))
            return singular_at(order[i], size);
        inverse[i] = 1 / pivot;
    }
    factors.inverse_pivot = std::move(inverse);
    return {};
}

namespace {

// L y = b, y ← D⁻¹ y, Lᵀ x = y, in place, for `columns` numbers side by side in each of the rows.
template<int columns>
void substitute(const Matrix& lower, std::span<const double> inverse_pivot, double* values) {
    using Row = Eigen::Matrix<double, columns, 1>;
    const auto row = [&](int i) {
        return Eigen::Map<Row>(values + std::size_t{columns} * static_cast<std::size_t>(i));
    };
    const int* first = lower.outerIndexPtr();
    const int* below = lower.innerIndexPtr();
    const double* value = lower.valuePtr();
    const int size = static_cast<int>(inverse_pivot.size());
    for (int i = 0; i < size; ++i) {
        const Row known = row(i);
        for (int at = first[i]; at < first[i + 1]; ++at) row(below[at]) -= value[at] * known;
        row(i) = inverse_pivot[static_cast<std::size_t>(i)] * known;
    }
    for (int i = size - 1; i >= 0; --i) {
        Row sum = row(i);
        for (int at = first[i]; at < first[i + 1]; ++at) sum -= value[at] * row(below[at]);
        row(i) = sum;
    }
}

void substitute(const Matrix& lower, std::span<const double> inverse_pivot, std::size_t columns,
                double* values) {
    switch (columns) {
    case 1:
        return substitute<1>(lower, inverse_pivot, values);
    case 2:
        return substitute<2>(lower, inverse_pivot, values);
    case 3:
        return substitute<3>(lower, inverse_pivot, values);
    default:
        return substitute<columns_at_once>(lower, inverse_pivot, values);
    }
}

} // namespace

void SparseFactor::solve(std::span<double> values, std::size_t columns, Workers& workers) {
    Factors& factors = *factors_;
    const std::size_t size = factors.inverse_pivot.size();
    require(columns > 0 && values.size() % columns == 0, "whole rows");
    require(values.empty() || size > 0, "a system is factorised before it is solved");
    require(values.size() == size * columns, "as many rows as the system has");
    factors.permuted.resize(values.size());
    const bool shared = workers.threads() > 1 && fill() >= shared_fill;
    const std::size_t most = shared ? columns_at_once / 2 : columns_at_once;
    workers.for_chunks(columns, most, [&](std::size_t begin, std::size_t end) {
        const std::size_t width = end - begin;
        double* permuted = factors.permuted.data() + size * begin;
        const auto place = [&](std::size_t i) {
            return values.data() + columns * static_cast<std::size_t>(factors.order[i]) + begin;
        };
        for (std::size_t i = 0; i < size; ++i) std::copy_n(place(i), width, permuted + width * i);
        substitute(factors.ldlt.lower(), factors.inverse_pivot, width, permuted);
        for (std::size_t i = 0; i < size; ++i) std::copy_n(permuted + width * i, width, place(i));
    });
}

std::size_t SparseFactor::fill() const {
    const Factors& factors = *factors_;
    if (factors.inverse_pivot.empty()) return 0;
    return static_cast<std::size_t>(factors.ldlt.lower().nonZeros()) + factors.inverse_pivot.size();
}

} // namespace knead
