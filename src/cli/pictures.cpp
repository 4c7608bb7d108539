#include "cli/pictures.h"

#include "base/error.h"
#include "cli/picture_options.h"

#ifdef KNEAD_HAS_EDITOR

#include "graph/local_spacing.h"
#include "graph/neighbors.h"
#include "graph/shading_normals.h"
#include "render/png.h"
#include "view/framing.h"

namespace knead {

namespace {
constexpr std::size_t neighbors = 8; // that a normal is estimated from, and how far apart points lie
}

struct PictureMaker::State {
    PictureOptions options;
    Workers& workers;
    double room;
    Viewport viewport;
    ColorBy color;
    PointLook look;
    HeadlessContext context;
    PointRenderer renderer;
    std::optional<Camera> camera; // since the first shape
    Graph graph;
    std::vector<float> unit_normals, displacement;
    std::vector<std::uint32_t> colors;
    Picture picture;

    State(const PictureOptions& given, Workers& with, double farther)
        : options(given), workers(with), room(farther), viewport(parse_size(given.size, largest_picture)),
          color(parse_color(given.color)), look(look_of(given)) {
        camera_for(given, {}, {}, Vec3d::Zero(), viewport); // refuses a bad view before the work
    }

    static PointLook look_of(const PictureOptions& given) {
        PointLook look;
        look.eye_dome = !given.flat;
        if (given.point_size > 0) {
            look.size_by_distance = false;
            look.pixels = static_cast<float>(given.point_size);
        }
        if (!given.background.empty())
            look.background_top = look.background_bottom = parse_background(given.background);
        return look;
    }

    void begin(const PictureShape& shape, Progress& progress);
    void take_normals(const PictureShape& shape);
    void estimate_normals(const PictureShape& shape);
    void take_colors(const PictureShape& shape);
};

// The camera, and what stays the same from picture to picture. Neighbours are those of the shape as opened,
// so that what only touches when posed stays apart.
void PictureMaker::State::begin(const PictureShape& shape, Progress& progress) {
    if (options.color == "rgb" && own_colors(shape.cloud) != OwnColors::rgb)
        throw Error(Trouble::usage, "",
                    "--color rgb: the cloud has no colours of its own; leave it out to see the shape alone");
    camera = camera_for(options, shape.positions, shape.opened, shape.cloud.origin, viewport);
    camera->distance *= room;
    color.up = camera->up;
    graph =
        neighbor_graph(vertex_positions(shape.order, shape.opened, workers), neighbors, workers, progress);
    renderer.set_points(shape.positions.size() / 3, usual_spacing(shape.opened));
    renderer.set_spacings(spacing_of_points(shape.order, graph, shape.opened, workers));
}

void PictureMaker::State::take_normals(const PictureShape& shape) {
    if (shape.normals.empty()) {
        estimate_normals(shape);
    } else {
        unit_normals.assign(shape.normals.begin(), shape.normals.end());
        for (std::size_t i = 0; i + 2 < unit_normals.size(); i += 3) {
            const glm::vec3 n(unit_normals[i], unit_normals[i + 1], unit_normals[i + 2]);
            const float length = glm::length(n);
            for (std::size_t c = 0; c < 3; ++c)
                unit_normals[i + c] = length > 0 ? n[static_cast<int>(c)] / length : 0;
        }
    }
    renderer.set_normals(unit_normals);
}

void PictureMaker::State::estimate_normals(const PictureShape& shape) {
    const std::vector<float> vertices = vertex_positions(shape.order, shape.positions, workers);
    unit_normals = spread_to_points(shading_normals(graph, vertices, workers), shape.order.vertex);
}

void PictureMaker::State::take_colors(const PictureShape& shape) {
    const std::size_t n = shape.positions.size() / 3;
    if (color.kind == ColorBy::Kind::values) {
        displacement.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            const auto at = [i](std::span<const float> p) {
                return glm::vec3(p[3 * i], p[3 * i + 1], p[3 * i + 2]);
            };
            displacement[i] = glm::distance(at(shape.positions), at(shape.opened));
        }
    }
    colors.resize(n);
    color_points(color, {&shape.cloud, shape.order.file_index, shape.positions, unit_normals, displacement},
                 colors, workers);
    renderer.set_colors(colors);
}

PictureMaker::PictureMaker(const PictureOptions& options, Workers& workers, double room)
    : state_(std::make_unique<State>(options, workers, room)) {}

PictureMaker::~PictureMaker() = default;

void PictureMaker::draw(const PictureShape& shape, Progress& progress) {
    State& s = *state_;
    if (!s.camera) s.begin(shape, progress);
    s.renderer.set_positions(shape.positions);
    progress.stop_if_cancelled();
    s.take_normals(shape);
    progress.stop_if_cancelled();
    s.take_colors(shape);
    progress.stop_if_cancelled();
    s.picture = draw_picture(s.renderer, *s.camera, s.viewport, s.look);
    progress.stop_if_cancelled();
}

void PictureMaker::write(const std::filesystem::path& path) const {
    write_png(path, state_->picture);
}

void PictureMaker::write(FileInTheMaking& file) const {
    write_png(file, state_->picture);
}

} // namespace knead

#else

namespace knead {

struct PictureMaker::State {};

PictureMaker::PictureMaker(const PictureOptions& /*options*/, Workers& /*workers*/, double /*room*/) {
    throw Error(Trouble::usage, "",
                "this knead was built without OpenGL (KNEAD_EDITOR=OFF) and draws no pictures");
}
PictureMaker::~PictureMaker() = default;
void PictureMaker::draw(const PictureShape& /*shape*/, Progress& /*progress*/) {}
void PictureMaker::write(const std::filesystem::path& /*path*/) const {}
void PictureMaker::write(FileInTheMaking& /*file*/) const {}

} // namespace knead

#endif
