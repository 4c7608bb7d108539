// `knead make SHAPE --points N --out F`: writes a generated cloud.

#include "base/counts.h"
#include "base/error.h"
#include "base/quoted.h"
#include "base/workers.h"
#include "cli/commands.h"
#include "io/cloud_file.h"
#include "shapes/shapes.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <sstream>

namespace knead {

namespace {

struct MakeArguments {
    std::string shape;
    std::int64_t points = 0;
    std::uint64_t seed = 1;
    std::optional<double> noise;
    std::optional<double> outliers;
    double gradient = 1;
    std::string out;
};

std::string words_for(const PointCloud& cloud, const MakeArguments& arguments) {
    const Bounds bounds = bounds_of(cloud);
    const Vec3d size = bounds.highest - bounds.lowest;
    std::ostringstream words;
    words.precision(4);
    words << "made " << arguments.out << ": " << arguments.shape << ", " << counted(cloud.size(), "point")
          << ", " << size.x() << " × " << size.y() << " × " << size.z();
    return words.str();
}

int make(const MakeArguments& arguments, Terminal& terminal) {
    const std::optional<Shape> shape = shape_named(arguments.shape);
    if (!shape)
        throw Error(Trouble::usage, "",
                    "no shape is called " + quoted(arguments.shape) + "; there are " + shape_names());
    ShapeOptions options;
    // A count below 0 is refused with the same words as 0.
    options.points = arguments.points > 0 ? static_cast<std::size_t>(arguments.points) : 0;
    options.seed = arguments.seed;
    options.noise = arguments.noise;
    options.outliers = arguments.outliers;
    options.gradient = arguments.gradient;
    refuse_bad_target(arguments.out);
    Workers workers;
    const PointCloud cloud = make_shape(*shape, options, workers, terminal);
    for (const std::string& words : write_cloud(arguments.out, cloud, {}, terminal)) terminal.warn(words);
    terminal.say(words_for(cloud, arguments));
    return 0;
}

} // namespace

void add_make(CLI::App& app, Job& job) {
    const auto arguments = std::make_shared<MakeArguments>();
    CLI::App* command =
        app.add_subcommand("make", "Make a test cloud: a simple shape, or a creature as scanned");
    command->add_option("shape", arguments->shape, shape_names())->required()->type_name("SHAPE");
    command->add_option("--points", arguments->points, "How many points, strays included")->required();
    command->add_option("--out", arguments->out, "The file to write: " + known_extensions())
        ->required()
        ->type_name("FILE");
    command->add_option("--seed", arguments->seed, "Another seed, another cloud of the same shape (1)")
        ->check(CLI::Validator( // CLI11 would wrap it round
            [](const std::string& value) {
                return value.starts_with('-') ? std::string("must not be below 0") : std::string();
            },
            ""));
    command->add_option("--noise", arguments->noise,
                        "Standard deviation of the points from the surface, over their mean spacing "
                        "(0; creature 0.3)");
    command->add_option("--outliers", arguments->outliers,
                        "Fraction of the points that are strays (0; creature 0.002)");
    command->add_option("--gradient", arguments->gradient,
                        "Density at the dense end over that at the sparse end (1)");
    command->callback(
        [arguments, &job] { job = [arguments](Terminal& terminal) { return make(*arguments, terminal); }; });
}

} // namespace knead
