// Figure 4 of the paper: its weights beside smooth ones.

#include "bench/deviation.h"
#include "bench/made_cloud.h"
#include "bench/page_studio.h"
#include "bench/posing.h"
#include "bench/text_table.h"

#include <cmath>

namespace knead {

namespace {

constexpr std::uint64_t samples = 100;
constexpr double bend_degrees = 60;
constexpr double largest_stretch = 0.2; // where the scale of colours ends

// How much the links of each point changed their length: the mean of |log stretch|.
std::vector<float> stretches(const PageShape& shape) {
    const auto length = [&](std::span<const float> positions, Index v, Index w) {
        const std::size_t a = 3 * std::size_t{shape.order->first_point[v]};
        const std::size_t b = 3 * std::size_t{shape.order->first_point[w]};
        double square = 0;
        for (std::size_t c = 0; c < 3; ++c)
            square += std::pow(double{positions[a + c]} - double{positions[b + c]}, 2);
        return std::sqrt(square);
    };
    std::vector<float> of_vertex(shape.graph->size(), 0.0F);
    for (Index v = 0; v < shape.graph->size(); ++v) {
        const auto row = shape.graph->row(v);
        double sum = 0;
        for (const Index w : row)
            sum += std::abs(
                std::log(std::max(length(shape.positions, v, w), 1e-12) / length(shape.opened, v, w)));
        if (!row.empty()) of_vertex[v] = static_cast<float>(sum / static_cast<double>(row.size()));
    }
    std::vector<float> values;
    for (std::size_t i = 0; i < shape.order->points(); ++i)
        values.push_back(of_vertex[shape.order->vertex[i]]);
    return values;
}

PagePicture picture_of(PageStudio& studio, PageScene& scene, const std::string& words,
                       const std::string& suffix, const Settings& settings, const std::string& options) {
    const auto document = carry_out(studio, scene, settings);
    PageShape shape = shape_of(studio, *document);
    const std::vector<float> values = stretches(shape);
    shape.values = values;
    shape.largest_value = largest_stretch;
    PagePicture picture = draw_scene(studio, scene, suffix, shape);
    picture.caption = words + ": links' lengths changed by " +
                      digits_text(100 * link_noise(document->pipeline(), shape.positions), 1) + " % rms.";
    picture.command = replay_command(scene, options, picture);
    return picture;
}

PageRow row_of(PageStudio& studio, const DeformationTask& task, const std::filesystem::path& cloud_file,
               const PageView& view) {
    PageScene scene;
    scene.name = task.name + "-weights";
    scene.cloud = task.cloud;
    scene.cloud_file = cloud_file;
    scene.acts = acts_of(task);
    scene.view = view;
    write_session(studio, scene);
    const std::string count = "--samples " + std::to_string(samples);
    Settings paper = with_samples(samples), smooth = paper, full = with_samples(5000);
    paper.weights = InfluenceWeights::paper;
    PageRow row{task.name, {}};
    row.pictures = {picture_of(studio, scene, "The paper's weights, 1/d²", "paper", paper,
                               count + " --set weights=paper"),
                    picture_of(studio, scene, "Smooth weights, (1 - d/d_max)²", "smooth", smooth, count),
                    picture_of(studio, scene, "With 5000 samples", "5000", full, "--samples 5000")};
    return row;
}

} // namespace

PageSection weights_section(PageStudio& studio) {
    PageSection section{
        "Figure 4: the paper's weights and smooth ones",
        "Bent by 60° between two automatic handles, with 100 samples, where weights show most. "
        "The colour is how much the links of a point changed their length. The paper's weights jump where "
        "the set of the nearest samples "
        "changes: patches with edges.",
        {},
        {},
        "unchanged",
        "20 %"};
    section.rows.push_back(
        row_of(studio,
               bending_task("bar-bent", made_cloud(Shape::bar, 20'000, studio.workers, studio.progress),
                            bend_degrees),
               {}, {20, 15, UpAxis::z, usual_size, {}}));
    add_scan_rows(studio, section, [&](const std::string& name, PointCloud cloud, const auto& file) {
        return row_of(studio, bending_task(name, std::move(cloud), bend_degrees), file,
                      {15, 10, UpAxis::y, usual_size, {}});
    });
    return section;
}

} // namespace knead
