#include "peers/cgal_deformation.h"

#include "base/stopwatch.h"
#include "bench/deviation.h"
#include "bench/statistics.h"
#include "edit/handle_motion.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

#include <memory>

namespace knead::peers {

namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

constexpr double at_rest = 1e-7; // over D: what the floats of a pose tell apart

// About the cloud's origin. Words where CGAL takes a face for the end of a manifold.
std::string make_mesh(const PointCloud& cloud, std::span<const Triangle> triangles, Mesh& mesh) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const Vec3f place = cloud.position(i);
        mesh.add_vertex(Point(place.x(), place.y(), place.z()));
    }
    for (const Triangle& corners : triangles)
        if (mesh.add_face(Mesh::Vertex_index(corners[0]), Mesh::Vertex_index(corners[1]),
                          Mesh::Vertex_index(corners[2])) == Mesh::null_face())
            return "CGAL refuses the mesh: it is no oriented manifold";
    return "";
}

std::vector<float> positions_of(const Mesh& mesh) {
    std::vector<float> positions;
    positions.reserve(3 * mesh.number_of_vertices());
    for (const Mesh::Vertex_index vertex : mesh.vertices())
        for (int axis = 0; axis < 3; ++axis)
            positions.push_back(static_cast<float>(mesh.point(vertex)[axis]));
    return positions;
}

template<typename Deformation>
void set_targets(const DeformationTask& task, const Mesh& mesh, Deformation& deformation) {
    const HandleMotion motion = motion_of(task.pose, task.pivot, task.cloud.origin, {});
    for (const Index held : task.handle) {
        const Point& rest = mesh.point(Mesh::Vertex_index(held));
        const Vec3d target = motion.linear * Vec3d(rest.x(), rest.y(), rest.z()) + motion.offset;
        deformation.set_target_position(Mesh::Vertex_index(held), Point(target.x(), target.y(), target.z()));
    }
}

template<typename Deformation>
bool prepare(const DeformationTask& task, Mesh& mesh, std::size_t repeats,
             std::unique_ptr<Deformation>& deformation, double& median_seconds) {
    std::vector<double> seconds;
    bool good = true;
    for (std::size_t r = 0; r < repeats && good; ++r) {
        deformation.reset();
        const Stopwatch clock;
        deformation = std::make_unique<Deformation>(mesh);
        const auto all = mesh.vertices();
        deformation->insert_roi_vertices(all.begin(), all.end());
        for (const auto& handle : {task.fixed, task.handle})
            for (const Index held : handle) deformation->insert_control_vertex(Mesh::Vertex_index(held));
        good = deformation->preprocess();
        seconds.push_back(clock.seconds());
    }
    median_seconds = summarize(seconds).median;
    return good;
}

template<CGAL::Deformation_algorithm_tag energy>
void descend(const DeformationTask& task, Mesh& mesh, std::size_t most_iterations, std::size_t repeats,
             Descent& descent) {
    using Deformation = CGAL::Surface_mesh_deformation<Mesh, CGAL::Default, CGAL::Default, energy>;
    std::unique_ptr<Deformation> deformation;
    if (!prepare(task, mesh, repeats, deformation, descent.preparation)) {
        descent.trouble = "CGAL cannot factorise the system";
        return;
    }
    set_targets(task, mesh, *deformation);
    const double diagonal = bounds_of(task.cloud).diagonal();
    std::vector<float> before;
    std::vector<double> iterations;
    double seconds = 0;
    for (std::size_t i = 1; i <= most_iterations && !descent.at_rest; ++i) {
        const Stopwatch clock;
        deformation->deform(1, 0.0); // goes on from where it is; without the energy, which nobody asks for
        iterations.push_back(clock.seconds());
        seconds += iterations.back();
        std::vector<float> now = positions_of(mesh);
        descent.at_rest = i > 1 && deviation_between(now, before, diagonal).largest <= at_rest;
        if (is_stop(i) || descent.at_rest || i == most_iterations) descent.stops.push_back({i, seconds, now});
        before = std::move(now);
    }
    descent.iteration = summarize(iterations).median;
}

} // namespace

Descent descend_with_cgal(const DeformationTask& task, std::span<const Triangle> triangles, CgalEnergy energy,
                          std::size_t most_iterations, std::size_t repeats) {
    Descent descent;
    descent.name = energy == CgalEnergy::spokes_and_rims ? "CGAL, spokes and rims" : "CGAL, smooth rotations";
    descent.samples = task.cloud.size();
    Mesh mesh;
    descent.trouble = make_mesh(task.cloud, triangles, mesh);
    if (!descent.trouble.empty()) return descent;
    if (energy == CgalEnergy::spokes_and_rims)
        descend<CGAL::SPOKES_AND_RIMS>(task, mesh, most_iterations, repeats, descent);
    else
        descend<CGAL::SRE_ARAP>(task, mesh, most_iterations, repeats, descent);
    return descent;
}

} // namespace knead::peers
