// In place of Figure 3 of the paper, which nothing here describes: from the cloud to the posed cloud.

#include "base/counts.h"
#include "base/require.h"
#include "bench/page_studio.h"
#include "bench/posing.h"
#include "bench/text_table.h"

#include <algorithm>

namespace knead {

namespace {

constexpr std::uint64_t samples = 500;
constexpr double bend_degrees = 45;
constexpr float dot = 5, link = 1; // pixels

struct Look {
    std::string name;
    Vec3d chosen; // the sample nearest to it is the one whose influence is shown; in the file's coordinates
    PageView view;
};

Vec3f place_of(const Pipeline& pipeline, std::span<const float> positions, Index sample) {
    const Index point = pipeline.order().first_point[pipeline.samples()[sample]];
    return point_at(positions, point).cast<float>();
}

// The samples as dots and the links between them.
std::vector<PageLine> sample_lines(const Pipeline& pipeline, std::span<const float> positions) {
    const Graph& graph = pipeline.sample_graph().graph;
    std::vector<PageLine> lines;
    for (Index s = 0; s < graph.size(); ++s) {
        const Vec3f here = place_of(pipeline, positions, s);
        for (const Index other : graph.row(s))
            if (s < other) lines.push_back({here, place_of(pipeline, positions, other), false, link});
    }
    for (Index s = 0; s < graph.size(); ++s) {
        const Vec3f here = place_of(pipeline, positions, s);
        lines.push_back({here, here, true, dot});
    }
    return lines;
}

// How much of each point's motion is this sample's; n.
std::vector<float> influence_of(const Pipeline& pipeline, Index sample) {
    std::vector<float> values;
    for (std::size_t i = 0; i < pipeline.order().points(); ++i) {
        const Index v = pipeline.order().vertex[i];
        const Influence influence = pipeline.influence(v);
        float value = 0;
        for (std::size_t k = 0; k < influence.count; ++k)
            if (influence.motion[k] == sample) value += influence.weight[k];
        values.push_back(pipeline.labels().vertex[v] == no_index ? value : 0);
    }
    return values;
}

// Of those that move points: the free ones.
Index sample_near(const Pipeline& pipeline, const Vec3d& place) {
    Index nearest = no_index;
    const auto away = [&](Index s) {
        return (place_of(pipeline, pipeline.opened().positions, s).cast<double>() - place).squaredNorm();
    };
    for (Index s = 0; s < pipeline.samples().size(); ++s) {
        if (pipeline.labels().vertex[pipeline.samples()[s]] != no_index) continue;
        if (nearest == no_index || away(s) < away(nearest)) nearest = s;
    }
    require(nearest != no_index, "the page's handles leave samples free");
    return nearest;
}

PageRow row_of(PageStudio& studio, const Look& look, PointCloud cloud,
               const std::filesystem::path& cloud_file) {
    const DeformationTask task = bending_task(look.name, std::move(cloud), bend_degrees);
    PageScene scene;
    scene.name = look.name + "-pipeline";
    scene.cloud_name = look.name;
    scene.cloud = task.cloud;
    scene.cloud_file = cloud_file;
    scene.settings.samples = samples;
    scene.acts = acts_of(task);
    scene.view = look.view;
    scene.rest_is_shown = true;
    write_session(studio, scene);
    const auto document = carry_out(studio, scene, scene.settings);
    const Pipeline& pipeline = document->pipeline();
    const PageShape posed = shape_of(studio, *document);
    PageShape shape = posed;
    const std::vector<PageLine> moved = sample_lines(pipeline, posed.positions);
    shape.lines = moved;
    PagePicture after = draw_scene(studio, scene, "posed", shape); // first, as it chooses the camera
    after.caption = "Only the samples are solved for, here bent by " + digits_text(bend_degrees, 0) +
                    "° between two automatic handles; all points follow.";
    after.command = replay_command(scene, "", after);

    shape = posed;
    shape.positions = posed.opened;
    shape.handle = {};
    PagePicture rest = draw_scene(studio, scene, "rest", shape);
    rest.caption = grouped(scene.cloud.size()) + " points.";
    const std::vector<PageLine> lines = sample_lines(pipeline, posed.opened);
    shape.lines = lines;
    PagePicture graph = draw_scene(studio, scene, "samples", shape);
    graph.caption = grouped(pipeline.samples().size()) +
                    " samples and their graph: links where territories touch, and to the six nearest.";
    const Index chosen = sample_near(pipeline, look.chosen - scene.cloud.origin);
    const std::vector<float> influence = influence_of(pipeline, chosen);
    const Vec3f here = place_of(pipeline, posed.opened, chosen);
    const PageLine mark{here, here, true, 2 * dot};
    shape.lines = {&mark, 1};
    shape.values = influence;
    shape.largest_value = 1;
    PagePicture influenced = draw_scene(studio, scene, "influence", shape);
    influenced.caption = "What the marked sample moves: its weight at every point.";
    return {look.name, {rest, graph, influenced, after}};
}

} // namespace

PageSection pipeline_section(PageStudio& studio) {
    PageSection section{
        "In place of Figure 3: samples, their graph, their influence",
        "What Figure 3 of the paper shows is written nowhere in this project, and a search found no "
        "more than the paper's title. This is our own reading: the steps from a cloud to a "
        "posed cloud.",
        {},
        {},
        "no influence",
        "all of a point's motion"};
    section.rows.push_back(row_of(studio,
                                  {"creature", Vec3d(0.25, 0.08, 0.75), {60, 15, UpAxis::z, usual_size, {}}},
                                  clean_creature(studio), {}));
    const Look looks[] = {{"bunny", Vec3d(-0.02, 0.1, 0.06), {-20, 15, UpAxis::y, usual_size, {}}},
                          {"armadillo", Vec3d(5, 15, 20), {20, 5, UpAxis::y, usual_size, {}}},
                          {"dragon", Vec3d(-0.01, 0.13, 0.03), {15, 10, UpAxis::y, usual_size, {}}}};
    add_scan_rows(studio, section, [&](const std::string& name, PointCloud cloud, const auto& file) {
        return row_of(studio, *std::ranges::find(looks, name, &Look::name), std::move(cloud), file);
    });
    return section;
}

} // namespace knead
