// knead render FILE --out PNG: a picture of a cloud, with no display.

#include "base/error.h"
#include "cli/commands.h"
#include "cli/pictures.h"
#include "io/cloud_file.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace knead {

namespace {

struct Arguments {
    std::string file, out;
    PictureOptions picture;
};

int render(const Arguments& arguments, Terminal& terminal) {
    if (arguments.picture.color == "displacement")
        throw Error(Trouble::usage, "",
                    "--color displacement: a cloud by itself has none; `knead replay` knows it");
    Workers workers;
    PictureMaker maker(arguments.picture, workers);
    refuse_bad_picture(arguments.out);
    const PointCloud cloud = read_cloud(arguments.file, terminal);
    const PointOrder order = order_points(cloud.positions, workers, terminal);
    if (order.points() == 0)
        throw Error(Trouble::input, arguments.file,
                    "holds no point with finite coordinates, so there is nothing to see");
    std::vector<float> positions(3 * order.points()), normals;
    gather(order, cloud.positions, 3, positions, workers);
    if (const std::vector<float> of_file = read_normals(cloud); !of_file.empty()) {
        normals.resize(positions.size());
        gather(order, of_file, 3, normals, workers);
    }
    terminal.step("drawing", 0);
    maker.draw({cloud, order, positions, positions, normals}, terminal);
    maker.write(arguments.out);
    return 0;
}

} // namespace

void add_render(CLI::App& app, Job& job) {
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("render", "A picture of a cloud, with no display");
    command->add_option("FILE", arguments->file, "The cloud: " + known_extensions())->required();
    command->add_option("--out", arguments->out, "The picture, a PNG file")->required();
    declare_picture_options(*command, arguments->picture);
    command->callback([arguments, &job] {
        job = [arguments](Terminal& terminal) { return render(*arguments, terminal); };
    });
}

} // namespace knead
