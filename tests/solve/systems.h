#pragma once
// Systems like those of a deformation: weighted graph Laplacians, some with a diagonal added.

#include "solve/sparse_cholesky.h"

#include <Eigen/Dense>

#include <random>
#include <utility>
#include <vector>

namespace knead::test {

inline SparseMatrix sparse_of(const Eigen::MatrixXd& dense) {
    SparseMatrix matrix;
    matrix.first.push_back(0);
    for (int column = 0; column < dense.cols(); ++column) {
        for (int row = 0; row < dense.rows(); ++row) {
            if (dense(row, column) == 0) continue;
            matrix.row.push_back(row);
            matrix.value.push_back(dense(row, column));
        }
        matrix.first.push_back(static_cast<int>(matrix.row.size()));
    }
    return matrix;
}

// The Laplacian of a connected random graph: a chain in random order, and some `chords` more, with weights
// of 1/8 … 8, as isotropic_weights() gives them.
inline Eigen::MatrixXd random_laplacian(int size, int chords, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> exponent(-3, 3);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    const auto link = [&](int a, int b) {
        if (a == b || matrix(a, b) != 0) return;
        const double weight = std::exp2(exponent(random));
        matrix(a, b) = matrix(b, a) = -weight;
        matrix(a, a) += weight;
        matrix(b, b) += weight;
    };
    std::vector<int> chain(static_cast<std::size_t>(size));
    for (int i = 0; i < size; ++i) chain[static_cast<std::size_t>(i)] = i;
    std::ranges::shuffle(chain, random);
    for (std::size_t i = 1; i < chain.size(); ++i) link(chain[i - 1], chain[i]);
    const auto any = [&] { return static_cast<int>(random() % static_cast<unsigned>(size)); };
    for (int chord = 0; chord < chords; ++chord) {
        const int a = any();
        link(a, any());
    }
    return matrix;
}

// The same with a few vertices held, whose links stay on the diagonal.
inline Eigen::MatrixXd random_system(int size, int chords, unsigned seed) {
    Eigen::MatrixXd matrix = random_laplacian(size, chords, seed);
    for (int held = 0; held < size; held += 37) matrix(held, held) += 1;
    return matrix;
}

// A square grid of edge² vertices, four links each; those at the rim are linked to held ones beyond.
inline SparseMatrix grid_system(int edge) {
    SparseMatrix matrix;
    matrix.first.push_back(0);
    for (int y = 0; y < edge; ++y) {
        for (int x = 0; x < edge; ++x) {
            const auto put = [&](int other_x, int other_y, double value) {
                if (other_x < 0 || other_x >= edge || other_y < 0 || other_y >= edge) return;
                matrix.row.push_back(other_y * edge + other_x);
                matrix.value.push_back(value);
            };
            put(x, y - 1, -1);
            put(x - 1, y, -1);
            put(x, y, 4);
            put(x + 1, y, -1);
            put(x, y + 1, -1);
            matrix.first.push_back(static_cast<int>(matrix.row.size()));
        }
    }
    return matrix;
}

} // namespace knead::test
