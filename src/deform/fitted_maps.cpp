#include "deform/fitted_maps.h"

#include "base/new_processors.h"
#include "deform/sample_system.h"

#include <algorithm>
#include <numeric>

namespace knead {

namespace {

constexpr double of_turns = 0.1;    // λ
constexpr double usual = 0.03;      // κ; of most samples it is 0.03 to 0.1
constexpr double least_share = 0.5; // q, below which λ/q⁴ leaves next to nothing to be fitted
constexpr int steps = 2;
constexpr std::size_t rows_a_task = 16;

double dot_of(const Columns& a, const Columns& b) {
    return knead::dot_of(a.of[0], b.of[0]) + knead::dot_of(a.of[1], b.of[1]) +
           knead::dot_of(a.of[2], b.of[2]);
}

// Adds this many times as much.
void add_times(double times, const Columns& what, Columns& sum) {
    for (int column = 0; column < 3; ++column) sum.of[column] += times * what.of[column];
}

// The block of a sample's own, of its row of pairs.
Mat3d own_block(const PointEnergy& energy, Index sample) {
    const auto begin = energy.body.begin() + energy.first[sample];
    const auto end = energy.body.begin() + energy.first[sample + 1];
    const auto own = std::lower_bound(begin, end, sample);
    return energy.map_products[static_cast<std::size_t>(own - energy.body.begin())];
}

// Σ_s X_s Σ ω H_s H_tᵀ of the samples that a sample has met.
KNEAD_FOR_NEW_PROCESSORS_TOO
Columns product_of(const BodiesAround& around, std::span<const Columns> step) {
    Columns product;
    for (std::size_t at = 0; at < around.body.size(); ++at)
        if (around.body[at] < step.size())
            add_product(step[around.body[at]], around.map_products[at], product);
    return product;
}

// Visits all rows, and sums up what visit(row) returns: the same for any number of workers.
template<typename Visit>
double sum_over_rows(MapFit& fit, Visit&& visit, Workers& workers) {
    workers.for_chunks(fit.found.size(), rows_a_task, [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t row = begin; row < end; ++row) sum += visit(row);
        fit.sums[begin / rows_a_task] = sum;
    });
    return std::accumulate(fit.sums.begin(), fit.sums.end(), 0.0);
}

// What is left times the inverse of a row's own block.
Columns eased(const MapFit& fit, std::size_t row) {
    Columns result;
    add_product(fit.residual[row], fit.inverse[row], result);
    return result;
}

} // namespace

void prepare_fit(SampleSystem& system) {
    const PointEnergy& energy = system.rest.energy;
    MapFit& fit = system.fit;
    const std::size_t maps = energy.first.empty() ? 0 : system.free_sample.size();
    system.stretch.assign(maps, Mat3d::Zero());
    const std::size_t rows = energy.share < least_share ? 0 : maps;
    fit.preference.assign(rows, 0);
    fit.inverse.assign(rows, Mat3d::Zero());
    fit.found.assign(rows, Columns{});
    fit.residual = fit.product = fit.found;
    fit.step.assign(rows == 0 ? 0 : energy.samples, Columns{});
    fit.sums.assign((rows + rows_a_task - 1) / rows_a_task, 0);
    const double preference = of_turns / (3 * energy.share * energy.share * energy.share * energy.share);
    for (std::size_t row = 0; row < rows; ++row) {
        const Mat3d block = own_block(energy, system.free_sample[row]);
        if (!(block.trace() > 0)) continue; // no point tells
        fit.preference[row] =
            preference * std::max(block.trace(), usual * energy.spread[system.free_sample[row]].trace());
        fit.inverse[row] = (block + fit.preference[row] * Mat3d::Identity()).inverse();
    }
}

void fit_maps(SampleSystem& system, const SampleState& state, Workers& workers) {
    MapFit& fit = system.fit;
    if (fit.found.empty()) return;
    const auto around = [&](std::size_t row) {
        return bodies_around(system.rest.energy, system.body, system.free_sample[row]);
    };
    double left = sum_over_rows(
        fit,
        [&](std::size_t row) {
            fit.found[row] = {};
            fit.residual[row] = misfit_of(around(row));
            const Columns step = eased(fit, row);
            fit.step[system.free_sample[row]] = step;
            return dot_of(fit.residual[row], step);
        },
        workers);
    for (int k = 0; k < steps && left > 0; ++k) {
        const double bent = sum_over_rows(
            fit,
            [&](std::size_t row) {
                const Columns& step = fit.step[system.free_sample[row]];
                fit.product[row] = product_of(around(row), fit.step);
                add_times(fit.preference[row], step, fit.product[row]);
                return dot_of(step, fit.product[row]);
            },
            workers);
        if (!(bent > 0)) break;
        const double far = left / bent;
        const double before = left;
        left = sum_over_rows(
            fit,
            [&](std::size_t row) {
                add_times(far, fit.step[system.free_sample[row]], fit.found[row]);
                add_times(-far, fit.product[row], fit.residual[row]);
                return dot_of(fit.residual[row], eased(fit, row));
            },
            workers);
        const double on = left / before;
        workers.for_each(fit.found.size(), rows_a_task, [&](std::size_t row) {
            Columns step = eased(fit, row);
            add_times(on, fit.step[system.free_sample[row]], step);
            fit.step[system.free_sample[row]] = step;
        });
    }
    workers.for_each(fit.found.size(), rows_a_task, [&](std::size_t row) {
        const Quatd& turn = state.rotation[system.free_sample[row]];
        system.stretch[row] += turn.conjugate() * matrix_of(fit.found[row]);
    });
}

} // namespace knead
