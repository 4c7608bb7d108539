#include "solve/sparse_lu.h"

#include "base/require.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <slu_ddefs.h>

#include <cmath>
#include <numeric>
#include <optional>
#include <string>

// OpenBLAS's own; its header would bring all of BLAS.
extern "C" void openblas_set_num_threads(int threads);

namespace knead {

struct SparseFactor::Factors {
    int size = 0;
    bool factored = false;
    SuperMatrix lower{}, upper{};
    std::vector<int> column_order, row_order; // SuperLU's: position of each row and column in the factors
    std::vector<int> order;                   // ours: the row that comes i-th
    std::vector<double> permuted;             // work space of solve()
    SuperLUStat_t statistics{};

    Factors() { StatInit(&statistics); }
    Factors(const Factors&) = delete;
    Factors& operator=(const Factors&) = delete;
    ~Factors() {
        if (factored) {
            Destroy_SuperNode_Matrix(&lower);
            Destroy_CompCol_Matrix(&upper);
        }
        StatFree(&statistics);
    }
};

namespace {

// The matrix with rows and columns in `order`; rows of a column need not ascend for SuperLU.
SparseMatrix reordered(const SparseMatrix& matrix, std::span<const int> order) {
    const auto size = static_cast<std::size_t>(matrix.size());
    std::vector<int> position(size);
    for (std::size_t i = 0; i < size; ++i) position[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    SparseMatrix result;
    result.first.reserve(size + 1);
    result.row.reserve(matrix.row.size());
    result.value.reserve(matrix.value.size());
    result.first.push_back(0);
    for (const int column : order) {
        for (int at = matrix.first[static_cast<std::size_t>(column)];
             at < matrix.first[static_cast<std::size_t>(column) + 1]; ++at) {
            result.row.push_back(
                position[static_cast<std::size_t>(matrix.row[static_cast<std::size_t>(at)])]);
            result.value.push_back(matrix.value[static_cast<std::size_t>(at)]);
        }
        result.first.push_back(static_cast<int>(result.row.size()));
    }
    return result;
}

superlu_options_t symmetric_options() {
    superlu_options_t options;
    set_default_options(&options);
    options.SymmetricMode = YES;
    options.ColPerm = NATURAL;
    options.DiagPivotThresh = 0.0;
    options.Equil = NO;
    options.IterRefine = NOREFINE;
    options.PrintStat = NO;
    options.ConditionNumber = NO;
    return options;
}

FactorOutcome singular_at(int row, int size) {
    return {false, "the system of " + std::to_string(size) + " samples is singular at its row " +
                       std::to_string(row)};
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

// The first row whose pivot vanished, if there is one.
template<typename Factors>
std::optional<int> vanished_pivot(const Factors& factors, std::span<const double> diagonal) {
    const auto& blocks =
        *static_cast<const SCformat*>(factors.lower.Store); // pivots stand in the blocks of L
    const auto* values = static_cast<const double*>(blocks.nzval);
    for (std::size_t i = 0; i < diagonal.size(); ++i) {
        const int row = factors.order[i];
        const int column = factors.column_order[i];
        const int first_of_block = blocks.sup_to_col[blocks.col_to_sup[column]];
        const double pivot = values[blocks.nzval_colptr[column] + column - first_of_block];
        if (!(pivot > smallest_pivot * diagonal[static_cast<std::size_t>(row)])) return row;
    }
    return std::nullopt;
}

} // namespace

std::vector<int> minimum_degree_order(const SparseMatrix& pattern) {
    const int size = pattern.size();
    if (size == 0) return {};
    const Eigen::Map<const Eigen::SparseMatrix<double>> map(
        size, size, static_cast<Eigen::Index>(pattern.row.size()), pattern.first.data(), pattern.row.data(),
        pattern.value.data());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
    Eigen::AMDOrdering<int>()(map.selfadjointView<Eigen::Lower>(), permutation);
    return {permutation.indices().data(), permutation.indices().data() + size};
}

SparseFactor::SparseFactor() : factors_(std::make_unique<Factors>()) {}
SparseFactor::~SparseFactor() = default;
SparseFactor::SparseFactor(SparseFactor&&) noexcept = default;
SparseFactor& SparseFactor::operator=(SparseFactor&&) noexcept = default;

FactorOutcome SparseFactor::factorize(const SparseMatrix& matrix, std::span<const int> order) {
    factors_ = std::make_unique<Factors>();
    Factors& factors = *factors_;
    factors.size = matrix.size();
    if (factors.size == 0) return {};
    for (const double value : matrix.value)
        if (!std::isfinite(value)) return {false, "the system holds a number that is not finite"};

    // SuperLU reads outside its arrays where a column is empty.
    const std::vector<double> diagonal = diagonal_of(matrix);
    for (std::size_t row = 0; row < diagonal.size(); ++row)
        if (!(diagonal[row] > 0)) return singular_at(static_cast<int>(row), factors.size);

    openblas_set_num_threads(1); // its blocks are small, and more threads would change the rounding
    SparseMatrix ordered = reordered(matrix, order);
    const auto size = static_cast<std::size_t>(factors.size);
    factors.order.assign(order.begin(), order.end());
    factors.column_order.resize(size);
    std::iota(factors.column_order.begin(), factors.column_order.end(), 0);
    factors.row_order.resize(size);
    factors.permuted.resize(4 * size);

    SuperMatrix input{}, postordered{};
    dCreate_CompCol_Matrix(&input, factors.size, factors.size, static_cast<int>(ordered.value.size()),
                           ordered.value.data(), ordered.row.data(), ordered.first.data(), SLU_NC, SLU_D,
                           SLU_GE);
    superlu_options_t options = symmetric_options();
    std::vector<int> elimination_tree(size);
    sp_preorder(&options, &input, factors.column_order.data(), elimination_tree.data(), &postordered);
    GlobalLU_t memory{};
    int info = 0;
    dgstrf(&options, &postordered, sp_ienv(2), sp_ienv(1), elimination_tree.data(), nullptr, 0,
           factors.column_order.data(), factors.row_order.data(), &factors.lower, &factors.upper, &memory,
           &factors.statistics, &info);
    Destroy_CompCol_Permuted(&postordered);
    Destroy_SuperMatrix_Store(&input);
    if (info > factors.size)
        return {false, "there is not enough memory to factorise the system of " +
                           std::to_string(factors.size) + " samples"};
    factors.factored = true; // from here on there are factors to free, even where a pivot was zero
    if (const auto row = vanished_pivot(factors, diagonal)) return singular_at(*row, factors.size);
    return {};
}

void SparseFactor::solve(std::span<double> values, std::size_t columns) {
    Factors& factors = *factors_;
    const auto size = static_cast<std::size_t>(factors.size);
    require(values.size() == size * columns, "as many numbers as the system has rows");
    if (size == 0) return;
    require(factors.factored, "a system is factorised before it is solved");
    if (factors.permuted.size() < values.size()) factors.permuted.resize(values.size());
    for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t i = 0; i < size; ++i)
            factors.permuted[c * size + i] = values[c * size + static_cast<std::size_t>(factors.order[i])];

    SuperMatrix sides{};
    dCreate_Dense_Matrix(&sides, factors.size, static_cast<int>(columns), factors.permuted.data(),
                         factors.size, SLU_DN, SLU_D, SLU_GE);
    int info = 0;
    dgstrs(NOTRANS, &factors.lower, &factors.upper, factors.column_order.data(), factors.row_order.data(),
           &sides, &factors.statistics, &info);
    Destroy_SuperMatrix_Store(&sides);
    require(info == 0, "SuperLU refused its own factors");
    for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t i = 0; i < size; ++i)
            values[c * size + static_cast<std::size_t>(factors.order[i])] = factors.permuted[c * size + i];
}

std::size_t SparseFactor::fill() const {
    if (!factors_->factored) return 0;
    return static_cast<std::size_t>(static_cast<const SCformat*>(factors_->lower.Store)->nnz) +
           static_cast<std::size_t>(static_cast<const NCformat*>(factors_->upper.Store)->nnz);
}

} // namespace knead
