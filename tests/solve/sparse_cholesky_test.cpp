#include "solve/sparse_cholesky.h"
#include "solve/systems.h"

#include "base/require.h"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>

#include <cmath>
#include <limits>
#include <numeric>

namespace knead {
namespace {

using Eigen::MatrixXd;

std::vector<int> natural_order(int size) {
    std::vector<int> order(static_cast<std::size_t>(size));
    std::iota(order.begin(), order.end(), 0);
    return order;
}

FactorOutcome factorized(SparseFactor& factor, const MatrixXd& dense) {
    const SparseMatrix matrix = test::sparse_of(dense);
    return factor.factorize(matrix, minimum_degree_order(matrix));
}

MatrixXd solved(SparseFactor& factor, const MatrixXd& sides) {
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = sides;
    Workers workers(2);
    factor.solve({rows.data(), static_cast<std::size_t>(rows.size())}, static_cast<std::size_t>(rows.cols()),
                 workers);
    return rows;
}

// Rounding, 1e-16, times the condition of these systems, which is below 1e6 for chains of some hundreds.
constexpr double rounding = 1e-10;

TEST(SparseFactor, SolvesAsADenseFactorisationDoes) {
    for (const int size : {1, 2, 3, 10, 100, 400}) {
        for (unsigned seed = 1; seed <= 3; ++seed) {
            const MatrixXd matrix = test::random_system(size, 2 * size, seed);
            SparseFactor factor;
            const FactorOutcome outcome = factorized(factor, matrix);
            ASSERT_TRUE(outcome.solved) << outcome.words;
            EXPECT_TRUE(outcome.words.empty());
            for (const int columns : {1, 2, 3, 4, 7, 8}) {
                const MatrixXd sides = MatrixXd::Random(size, columns);
                const MatrixXd found = solved(factor, sides);
                EXPECT_LT((matrix * found - sides).norm(), rounding * sides.norm());
                const MatrixXd expected = matrix.ldlt().solve(sides);
                EXPECT_LT((found - expected).norm(), rounding * expected.norm());
            }
        }
    }
}

TEST(SparseFactor, SolvesInAnyOrder) {
    const MatrixXd matrix = test::random_system(60, 120, 4);
    const MatrixXd sides = MatrixXd::Random(60, 2);
    const MatrixXd expected = matrix.ldlt().solve(sides);
    std::vector<int> order = natural_order(60);
    std::mt19937 random(1);
    for (int time = 0; time < 5; ++time) {
        SparseFactor factor;
        ASSERT_TRUE(factor.factorize(test::sparse_of(matrix), order).solved);
        EXPECT_LT((solved(factor, sides) - expected).norm(), rounding * expected.norm());
        std::ranges::shuffle(order, random);
    }
}

TEST(SparseFactor, SolvesTheSameTwice) {
    const MatrixXd matrix = test::random_system(300, 600, 5);
    const MatrixXd sides = MatrixXd::Random(300, 4);
    SparseFactor one;
    SparseFactor other;
    ASSERT_TRUE(factorized(one, matrix).solved);
    ASSERT_TRUE(factorized(other, matrix).solved);
    const MatrixXd first = solved(one, sides);
    EXPECT_EQ(first, solved(one, sides));
    EXPECT_EQ(first, solved(other, sides));
}

TEST(SparseFactor, ForgetsTheMatrixBefore) {
    SparseFactor factor;
    for (const int size : {50, 200, 7}) {
        const MatrixXd matrix = test::random_system(size, size, 6);
        ASSERT_TRUE(factorized(factor, matrix).solved);
        const MatrixXd sides = MatrixXd::Random(size, 3);
        EXPECT_LT((matrix * solved(factor, sides) - sides).norm(), rounding * sides.norm());
    }
    ASSERT_FALSE(factorized(factor, MatrixXd::Constant(2, 2, std::nan(""))).solved);
    ASSERT_TRUE(factorized(factor, MatrixXd::Identity(3, 3) * 2).solved);
    EXPECT_EQ(solved(factor, MatrixXd::Ones(3, 1)), MatrixXd::Constant(3, 1, 0.5));
}

TEST(SparseFactor, KeepsItsFactorsWhenMoved) {
    SparseFactor factor;
    ASSERT_TRUE(factorized(factor, MatrixXd::Identity(4, 4) * 4).solved);
    SparseFactor moved = std::move(factor);
    EXPECT_EQ(solved(moved, MatrixXd::Ones(4, 2)), MatrixXd::Constant(4, 2, 0.25));
}

TEST(SparseFactor, AcceptsAnEmptyMatrix) {
    Workers workers(1);
    SparseFactor factor;
    EXPECT_TRUE(factor.factorize({}, {}).solved);
    EXPECT_TRUE(factor.factorize({{0}, {}, {}}, {}).solved);
    factor.solve({}, 4, workers);
    EXPECT_EQ(factor.fill(), 0U);
}

void expect_refused(const FactorOutcome& outcome) {
    EXPECT_FALSE(outcome.solved);
    EXPECT_FALSE(outcome.words.empty());
}

TEST(SparseFactor, RefusesASingularMatrixInWords) {
    SparseFactor factor;
    expect_refused(factorized(factor, MatrixXd::Zero(1, 1)));
    MatrixXd two(2, 2);
    two << 1, -1, -1, 1;
    expect_refused(factorized(factor, two));
    // Laplacians without anything held: singular, but for rounding.
    for (const int size : {3, 10, 100, 400}) {
        for (unsigned seed = 1; seed <= 5; ++seed) {
            SCOPED_TRACE(size);
            expect_refused(factorized(factor, test::random_laplacian(size, 2 * size, seed)));
        }
    }
}

TEST(SparseFactor, RefusesManySingularPartsAtOnce) {
    // Links of weight 1 in many parts: every part ends with a pivot of exactly zero.
    MatrixXd matrix = MatrixXd::Zero(120, 120);
    for (int part = 0; part < 120; part += 4)
        matrix.block(part, part, 4, 4) = 4 * MatrixXd::Identity(4, 4) - MatrixXd::Ones(4, 4);
    SparseFactor factor;
    expect_refused(factorized(factor, matrix));
}

TEST(SparseFactor, RefusesAMatrixWithoutADiagonal) {
    SparseFactor factor;
    expect_refused(factor.factorize({{0, 0}, {}, {}}, natural_order(1)));
    expect_refused(factor.factorize({{0, 1, 1, 2}, {0, 2}, {1, 1}}, natural_order(3)));
    expect_refused(factor.factorize({{0, 1}, {0}, {0}}, natural_order(1)));
    expect_refused(factor.factorize({{0, 1}, {0}, {-1}}, natural_order(1)));
}

TEST(SparseFactor, IsNotSolvedAfterABadOutcomeOfItsNumbers) {
    Workers workers(1);
    SparseFactor factor;
    expect_refused(factorized(factor, MatrixXd::Constant(3, 3, std::nan(""))));
    std::vector<double> values(3);
    EXPECT_THROW(factor.solve(values, 1, workers), BrokenInvariant);
}

TEST(SparseFactor, RefusesAMatrixThatIsNotPositiveDefinite) {
    MatrixXd saddle(2, 2);
    saddle << 1, 2, 2, 1;
    SparseFactor factor;
    expect_refused(factorized(factor, saddle));
}

TEST(SparseFactor, RefusesAMatrixOfWhichOnePartIsSingular) {
    MatrixXd matrix = MatrixXd::Zero(60, 60);
    matrix.topLeftCorner(30, 30) = test::random_system(30, 40, 7);
    matrix.bottomRightCorner(30, 30) = test::random_laplacian(30, 40, 8);
    SparseFactor factor;
    expect_refused(factorized(factor, matrix));
}

TEST(SparseFactor, RefusesNumbersThatAreNotFinite) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity()}) {
        MatrixXd matrix = test::random_system(20, 30, 9);
        matrix(7, 7) = bad;
        SparseFactor factor;
        expect_refused(factorized(factor, matrix));
    }
}

TEST(SparseFactor, AcceptsALongChainHeldAtOneEnd) {
    // The hardest that a proper system comes: its smallest pivot is 1/size of the largest number.
    constexpr int size = 100000;
    SparseMatrix chain;
    chain.first.push_back(0);
    for (int i = 0; i < size; ++i) {
        if (i > 0) {
            chain.row.push_back(i - 1);
            chain.value.push_back(-1);
        }
        chain.row.push_back(i);
        chain.value.push_back(i + 1 < size ? 2 : 1);
        if (i + 1 < size) {
            chain.row.push_back(i + 1);
            chain.value.push_back(-1);
        }
        chain.first.push_back(static_cast<int>(chain.row.size()));
    }
    SparseFactor factor;
    const FactorOutcome outcome = factor.factorize(chain, minimum_degree_order(chain));
    ASSERT_TRUE(outcome.solved) << outcome.words;
    std::vector<double> side(size, 0);
    Workers workers(2);
    side[size - 1] = 1; // pulled by 1 at the free end: x_i = i + 1
    factor.solve(side, 1, workers);
    for (int i = 0; i < size; i += 999) // condition 1e10
        EXPECT_NEAR(side[static_cast<std::size_t>(i)], i + 1, 1e-5 * (i + 1));
}

TEST(SparseFactor, SolvesAlikeForAnyNumberOfWorkers) {
    const SparseMatrix matrix = test::grid_system(160);
    SparseFactor factor;
    ASSERT_TRUE(factor.factorize(matrix, minimum_degree_order(matrix)).solved);
    EXPECT_GE(factor.fill(), SparseFactor::shared_fill) << "too small for workers to share it";
    for (const std::size_t columns : {1U, 2U, 3U, 4U, 7U}) {
        std::vector<double> alone(columns * static_cast<std::size_t>(matrix.size()));
        for (std::size_t i = 0; i < alone.size(); ++i) alone[i] = std::sin(static_cast<double>(i));
        std::vector<double> shared = alone;
        Workers one(1), several(3);
        factor.solve(alone, columns, one);
        factor.solve(shared, columns, several);
        EXPECT_EQ(alone, shared) << columns << " columns";
    }
}

TEST(SparseFactor, AcceptsWeightsOfAnyUnit) {
    for (const double unit : {1e-30, 1e30}) {
        const MatrixXd matrix = unit * test::random_system(100, 200, 10);
        SparseFactor factor;
        ASSERT_TRUE(factorized(factor, matrix).solved);
        const MatrixXd sides = MatrixXd::Random(100, 1);
        EXPECT_LT((matrix * solved(factor, sides) - sides).norm(), rounding * sides.norm());
    }
}

TEST(SparseFactor, IsNotSolvedBeforeItIsFactorised) {
    Workers workers(1);
    SparseFactor factor;
    std::vector<double> values(4);
    EXPECT_THROW(factor.solve(values, 1, workers), BrokenInvariant);
    ASSERT_TRUE(factorized(factor, MatrixXd::Identity(4, 4)).solved);
    EXPECT_THROW(factor.solve(values, 2, workers), BrokenInvariant);
}

TEST(MinimumDegreeOrder, IsAPermutation) {
    for (const int size : {1, 2, 50, 300}) {
        std::vector<int> order = minimum_degree_order(test::sparse_of(test::random_system(size, size, 11)));
        std::ranges::sort(order);
        EXPECT_EQ(order, natural_order(size));
    }
    EXPECT_TRUE(minimum_degree_order({}).empty());
}

TEST(MinimumDegreeOrder, DependsOnThePatternAlone) {
    SparseMatrix matrix = test::grid_system(20);
    const std::vector<int> order = minimum_degree_order(matrix);
    for (double& value : matrix.value) value *= value;
    EXPECT_EQ(minimum_degree_order(matrix), order);
}

TEST(CanBeOrdered, TellsWhatEigenCannotCount) {
    EXPECT_TRUE(can_be_ordered(0, 0).solved);
    EXPECT_TRUE(can_be_ordered(100'000'000, 1'600'000'000).solved);
    constexpr std::pair<std::size_t, std::size_t> too_many[] = {{100'000'000, 1'700'000'000},
                                                                {200'000'000, 1'500'000'000},
                                                                {1'100'000'000, 1'100'000'000},
                                                                {10, 5'000'000'000},
                                                                {5'000'000'000, 10}};
    for (const auto& [rows, entries] : too_many) {
        const FactorOutcome outcome = can_be_ordered(rows, entries);
        EXPECT_FALSE(outcome.solved) << rows << " rows, " << entries << " entries";
        EXPECT_NE(outcome.words.find(std::to_string(rows)), std::string::npos) << outcome.words;
    }
}

std::size_t fill_of(const SparseMatrix& matrix, const std::vector<int>& order) {
    SparseFactor factor;
    EXPECT_TRUE(factor.factorize(matrix, order).solved);
    return factor.fill();
}

TEST(MinimumDegreeOrder, KeepsTheFactorsSparse) {
    const SparseMatrix grid = test::grid_system(100);
    const std::vector<int> order = minimum_degree_order(grid);
    const std::size_t fill = fill_of(grid, order);
    EXPECT_LT(fill, fill_of(grid, natural_order(grid.size())) / 3);

    // Applied the wrong way round it is as bad as any order.
    std::vector<int> wrong(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        wrong[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    EXPECT_LT(fill, fill_of(grid, wrong) / 3);

    // As Eigen's own ordering by AMD leaves it.
    const Eigen::SparseMatrix<double> matrix = Eigen::Map<const Eigen::SparseMatrix<double>>(
        grid.size(), grid.size(), static_cast<int>(grid.row.size()), grid.first.data(), grid.row.data(),
        grid.value.data());
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt(matrix); // orders by AMD
    const auto cholesky = static_cast<std::size_t>(ldlt.matrixL().nestedExpression().nonZeros());
    EXPECT_LT(fill, cholesky + cholesky / 10 + static_cast<std::size_t>(grid.size()));
}

} // namespace
} // namespace knead
