#pragma once
// The pictures of `knead render` and `knead replay`: their options, and drawing them with no display.

#include "base/progress.h"
#include "base/whole_file.h"
#include "base/workers.h"
#include "graph/point_order.h"
#include "view/coloring.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace CLI {
class App;
}

namespace knead {

// As given on the command line.
struct PictureOptions {
    std::string size = "1280x800";
    std::string view;        // a side, or azimuth and elevation; empty: chosen
    std::string up = "auto"; // what the cloud stands on tells; or z, y, -y
    std::string color;       // rgb, plain, height, normal, displacement, or a column; empty: the file's own
    std::string background;  // "#rrggbb"; empty: a dark gradient
    double point_size = 0;   // pixels; 0: by distance
    double zoom = 1;
    bool orthographic = false, flat = false;
};

// Adds --size, --view and the others to a subcommand.
void declare_picture_options(CLI::App& command, PictureOptions& options);

// Throws Error (usage) where one of them is given, though no picture is asked for.
void refuse_picture_options(const CLI::App& command);

// Throws Error for a target that is no PNG file (usage) or that cannot be written to (output), so that one
// who computes for long can ask beforehand. Nothing is left behind.
void refuse_bad_picture(const std::filesystem::path& path);

// One shape of a cloud.
struct PictureShape {
    const PointCloud& cloud;
    const PointOrder& order;
    std::span<const float> opened;    // 3n in the order of computation, as in the file
    std::span<const float> positions; // 3n, as posed
    std::span<const float> normals;   // 3n of any length; empty: estimated, for the shading
};

// Draws pictures of one cloud, all with the camera of the first.
class PictureMaker {
public:
    // Throws Error (usage) for options that say nothing sensible, before any work is done, and where nothing
    // can be drawn: no EGL, or a knead that was built without it. `room` ≥ 1: the camera stands so much
    // farther away, for shapes that will move.
    PictureMaker(const PictureOptions& options, Workers& workers, double room = 1);
    ~PictureMaker();

    // The camera is framed on the bulk of the first shape. Throws Cancelled.
    void draw(const PictureShape& shape, Progress& progress);
    // Writes what was drawn last as PNG. Throws Error (output).
    void write(const std::filesystem::path& path) const;
    void write(FileInTheMaking& file) const; // that the caller commits

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace knead
