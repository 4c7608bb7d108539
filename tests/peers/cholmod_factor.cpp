#include "peers/cholmod_factor.h"

#include "base/error.h"

#include <cholmod.h>

#include <algorithm>
#include <array>

namespace knead::peers {

namespace {

// CHOLMOD's view of a matrix; it only reads it.
cholmod_sparse view_of(const SparseMatrix& matrix) {
    cholmod_sparse view{};
    view.nrow = view.ncol = static_cast<std::size_t>(matrix.size());
    view.nzmax = matrix.value.size();
    view.p = const_cast<int*>(matrix.first.data());
    view.i = const_cast<int*>(matrix.row.data());
    view.x = const_cast<double*>(matrix.value.data());
    view.stype = -1; // symmetric: the lower triangle counts, the upper is passed over
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
    return view;
}

} // namespace

struct CholmodSystem::State {
    cholmod_common common{};
    cholmod_factor* analysis = nullptr;
    std::array<cholmod_factor*, 2> factor{};
    cholmod_dense *result = nullptr, *work1 = nullptr, *work2 = nullptr;

    State() { cholmod_start(&common); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        forget_factors();
        cholmod_free_dense(&result, &common);
        cholmod_free_dense(&work1, &common);
        cholmod_free_dense(&work2, &common);
        cholmod_finish(&common);
    }

    void forget_factors() {
        cholmod_free_factor(&analysis, &common);
        for (cholmod_factor*& each : factor) cholmod_free_factor(&each, &common);
    }

    void check(bool good, const char* step) const {
        if (!good || common.status < CHOLMOD_OK || common.status == CHOLMOD_NOT_POSDEF)
            throw Error(Trouble::numeric, "", std::string("CHOLMOD fails to ") + step);
    }
};

CholmodSystem::CholmodSystem(CholmodKind kind) : state_(std::make_unique<State>()) {
    cholmod_common& common = state_->common;
    common.supernodal = kind == CholmodKind::automatic    ? CHOLMOD_AUTO
                        : kind == CholmodKind::simplicial ? CHOLMOD_SIMPLICIAL
                                                          : CHOLMOD_SUPERNODAL;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_AMD;
    common.final_ll = 1;
    common.print = 0;
}

CholmodSystem::~CholmodSystem() = default;

void CholmodSystem::analyze(const SparseMatrix& pattern) {
    state_->forget_factors();
    cholmod_sparse view = view_of(pattern);
    state_->analysis = cholmod_analyze(&view, &state_->common);
    state_->check(state_->analysis != nullptr, "analyse a matrix");
}

void CholmodSystem::factorize(std::size_t which, const SparseMatrix& matrix) {
    cholmod_factor*& factor = state_->factor.at(which);
    cholmod_free_factor(&factor, &state_->common);
    factor = cholmod_copy_factor(state_->analysis, &state_->common);
    state_->check(factor != nullptr, "copy its analysis");
    cholmod_sparse view = view_of(matrix);
    state_->check(cholmod_factorize(&view, factor, &state_->common) != 0, "factorise a matrix");
}

void CholmodSystem::solve(std::size_t which, std::span<double> values, std::size_t columns) {
    cholmod_dense sides{};
    sides.nrow = sides.d = values.size() / columns;
    sides.ncol = columns;
    sides.nzmax = values.size();
    sides.x = values.data();
    sides.xtype = CHOLMOD_REAL;
    sides.dtype = CHOLMOD_DOUBLE;
    const int good = cholmod_solve2(CHOLMOD_A, state_->factor.at(which), &sides, nullptr, &state_->result,
                                    nullptr, &state_->work1, &state_->work2, &state_->common);
    state_->check(good != 0, "solve");
    std::copy_n(static_cast<const double*>(state_->result->x), values.size(), values.data());
}

bool CholmodSystem::is_supernodal() const {
    return state_->factor[0] != nullptr && state_->factor[0]->is_super != 0;
}

std::string CholmodSystem::version() const {
    return std::to_string(CHOLMOD_MAIN_VERSION) + "." + std::to_string(CHOLMOD_SUB_VERSION) + "." +
           std::to_string(CHOLMOD_SUBSUB_VERSION);
}

} // namespace knead::peers
