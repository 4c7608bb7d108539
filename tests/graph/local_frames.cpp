#include "graph/local_frames.h"

#include <Eigen/Eigenvalues>

namespace knead {

namespace {

Quatd frame_at(const Graph& graph, std::span<const float> positions, std::size_t v) {
    const auto row = graph.row(v);
    if (row.empty()) return Quatd::Identity();
    Vec3d mean = point_at(positions, v);
    for (const Index u : row) mean += point_at(positions, u);
    mean /= static_cast<double>(row.size() + 1);
    Mat3d spread = Mat3d::Zero();
    const auto add = [&](std::size_t u) {
        const Vec3d away = point_at(positions, u) - mean;
        spread.noalias() += away * away.transpose();
    };
    add(v);
    for (const Index u : row) add(u);

    const Eigen::SelfAdjointEigenSolver<Mat3d> solver(spread); // smallest first
    Mat3d axes;
    axes.col(0) = solver.eigenvectors().col(2);
    axes.col(1) = solver.eigenvectors().col(1);
    axes.col(2) = axes.col(0).cross(axes.col(1)); // right-handed, whatever the signs
    return Quatd(axes).normalized();
}

} // namespace

std::vector<Quatd> local_frames(const Graph& graph, std::span<const float> positions, Workers& workers) {
    std::vector<Quatd> frames(graph.size());
    workers.for_each(graph.size(), 1024, [&](std::size_t v) { frames[v] = frame_at(graph, positions, v); });
    return frames;
}

} // namespace knead
