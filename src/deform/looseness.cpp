#include "deform/looseness.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace knead {

namespace {

constexpr double of_pushes = 2.5;     // where targets follow as strains do
constexpr double most_yielding = 1.6; // of what gives way to volume alone, from -0.73 down, less is seen
constexpr double most_given = 0.6;
constexpr int steps = 20;
constexpr double damping = 0.6; // of Jacobi's steps

// Of Σ w |e|²: where one link has nearly all the weight, how it leans says nothing.
constexpr double most_leaning = 0.5;

bool moves(const SampleSystem& system, std::size_t sample) {
    return system.unknown[sample] < system.moving_rows;
}

// m = Σ w e / Σ w of each sample; 0 of a leaf, which leans on nothing.
std::vector<Vec3d> find_lean(const SampleSystem& system, Workers& workers) {
    const SampleRest& rest = system.rest;
    std::vector<Vec3d> lean(rest.graph.size(), Vec3d(0, 0, 0));
    workers.for_each(lean.size(), 256, [&](std::size_t i) {
        double weight = 0;
        for (Index link = rest.graph.first[i]; link < rest.graph.first[i + 1]; ++link) {
            weight += rest.weight[link];
            lean[i] += system.weighted_edge[link];
        }
        if (weight > 0) lean[i] /= weight;
        if (is_leaf(rest, static_cast<Index>(i))) lean[i].setZero();
    });
    return lean;
}

// f of each sample, 0 where it does not move.
std::vector<Vec3d> find_pushes(const SampleSystem& system, Workers& workers) {
    const SampleRest& rest = system.rest;
    const std::vector<Vec3d> lean = find_lean(system, workers);
    std::vector<Vec3d> push(lean.size(), Vec3d(0, 0, 0));
    workers.for_each(lean.size(), 256, [&](std::size_t i) {
        if (!moves(system, i) || is_leaf(rest, static_cast<Index>(i))) return;
        Vec3d around = Vec3d::Zero();
        double weight = 0, spread = 0, count = 0; // Σ w, Σ w |e|²
        for (Index link = rest.graph.first[i]; link < rest.graph.first[i + 1]; ++link) {
            if (is_leaf(rest, rest.graph.neighbor[link])) continue;
            around += lean[rest.graph.neighbor[link]];
            weight += rest.weight[link];
            spread += system.weighted_edge[link].squaredNorm() / rest.weight[link];
            ++count;
        }
        if (!(spread > 0)) return;
        const Vec3d alone = lean[i] - around / count;
        const double leaning = alone.squaredNorm() * weight / spread;
        push[i] = weight * std::min(1.0, std::sqrt(most_leaning / leaning)) * alone;
    });
    return push;
}

// One step of Jacobi's method for a sample that moves; those that do not have u = 0.
Vec3d step_of(const SampleSystem& system, std::size_t i, const Vec3d& push, std::span<const Vec3d> way) {
    const SampleRest& rest = system.rest;
    Vec3d residual = push;
    double diagonal = 0;
    for (Index link = rest.graph.first[i]; link < rest.graph.first[i + 1]; ++link) {
        diagonal += rest.weight[link];
        residual += rest.weight[link] * (way[rest.graph.neighbor[link]] - way[i]);
    }
    const PointEnergy& energy = rest.energy;
    if (!energy.first.empty())
        for (Index at = energy.first[i]; at < energy.first[i + 1]; ++at) {
            if (energy.body[at] >= energy.samples) continue;
            if (energy.body[at] == i) diagonal += energy.pair[at].way;
            residual -= energy.pair[at].way * way[energy.body[at]];
        }
    return diagonal > 0 ? Vec3d(way[i] + damping / diagonal * residual) : Vec3d(Vec3d::Zero());
}

// f·u of each sample.
std::vector<double> find_given(const SampleSystem& system, Workers& workers) {
    const std::vector<Vec3d> push = find_pushes(system, workers);
    std::vector<Vec3d> way(push.size(), Vec3d(0, 0, 0)), next = way;
    for (int step = 0; step < steps; ++step) {
        workers.for_each(push.size(), 256, [&](std::size_t i) {
            if (moves(system, i)) next[i] = step_of(system, i, push[i], way);
        });
        std::swap(way, next);
    }
    std::vector<double> given(push.size());
    for (std::size_t i = 0; i < given.size(); ++i) given[i] = push[i].dot(way[i]);
    return given;
}

} // namespace

void find_looseness(SampleSystem& system, Workers& workers) {
    const SampleRest& rest = system.rest;
    const double poisson = rest.poisson;
    const double yielding = std::min(most_yielding, (1 / (1 + poisson) + 2 / (1 - poisson)) / 3);
    const std::vector<double> given = find_given(system, workers);
    workers.for_each(system.free_sample.size(), 256, [&](std::size_t row) {
        double gives = 0, holds = 0; // of the sample and those around it
        const auto add = [&](Index s) {
            if (system.unknown[s] == no_index) return;
            gives += given[s];
            holds += system.spread[system.unknown[s]].trace();
            if (!system.with_points.empty()) holds += rest.energy.spread[s].trace();
        };
        const Index i = system.free_sample[row];
        add(i);
        for (const Index j : rest.graph.row(i))
            if (!is_leaf(rest, j)) add(j);
        const double part = holds > 0 ? std::clamp(of_pushes * yielding * gives / holds, 0.0, most_given) : 0;
        const double looseness = part / (1 - part);
        system.surroundings[row].looseness = looseness;
        if (!system.with_points.empty()) system.with_points[row].looseness = looseness;
    });
}

} // namespace knead
