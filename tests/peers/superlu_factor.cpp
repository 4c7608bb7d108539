#include "peers/superlu_factor.h"

#include "base/error.h"

#include <slu_ddefs.h>

#include <numeric>
#include <vector>

namespace knead::peers {

struct SuperLuFactor::Factors {
    int size = 0;
    bool factored = false;
    SuperMatrix lower{}, upper{};
    std::vector<int> column_order, row_order; // SuperLU's: position of each row and column in the factors
    std::vector<int> order;                   // ours: the row that comes i-th
    std::vector<double> permuted;
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
    result.first.push_back(0);
    for (const int column : order) {
        const auto old = static_cast<std::size_t>(column);
        for (int at = matrix.first[old]; at < matrix.first[old + 1]; ++at) {
            const auto entry = static_cast<std::size_t>(at);
            result.row.push_back(position[static_cast<std::size_t>(matrix.row[entry])]);
            result.value.push_back(matrix.value[entry]);
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

} // namespace

SuperLuFactor::SuperLuFactor() : factors_(std::make_unique<Factors>()) {}
SuperLuFactor::~SuperLuFactor() = default;

void SuperLuFactor::factorize(const SparseMatrix& matrix, std::span<const int> order) {
    factors_ = std::make_unique<Factors>();
    Factors& factors = *factors_;
    factors.size = matrix.size();
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
    if (info <= factors.size) factors.factored = true; // beyond that it ran out of memory
    if (info != 0) throw Error(Trouble::numeric, "", "SuperLU fails to factorise a matrix");
}

void SuperLuFactor::solve(std::span<double> values, std::size_t columns) {
    Factors& factors = *factors_;
    const auto size = static_cast<std::size_t>(factors.size);
    factors.permuted.resize(values.size());
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
    if (info != 0) throw Error(Trouble::numeric, "", "SuperLU fails to solve");
    for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t i = 0; i < size; ++i)
            values[c * size + static_cast<std::size_t>(factors.order[i])] = factors.permuted[c * size + i];
}

} // namespace knead::peers
