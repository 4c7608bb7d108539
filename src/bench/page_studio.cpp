#include "bench/page_studio.h"

#include "base/whole_file.h"
#include "bench/automatic_handles.h"
#include "bench/posing.h"
#include "bench/scan_samples.h"
#include "bench/text_table.h"
#include "io/cloud_file.h"
#include "shapes/shapes.h"

namespace knead {

namespace {

namespace fs = std::filesystem;

constexpr unsigned settle_limit = 300;

void write_text(PageStudio& studio, const std::string& name, const std::string& text) {
    FileInTheMaking file(studio.folder / name);
    file.write(std::string_view(text));
    file.commit();
    studio.files.push_back(name);
}

std::string cloud_file_name(const PageScene& scene) {
    return (scene.cloud_name.empty() ? scene.name : scene.cloud_name) + ".ply";
}

} // namespace

std::vector<SessionAction> acts_of(const DeformationTask& task) {
    return {handle_line("fixed", HandleRole::fixed, task.fixed),
            handle_line("handle", HandleRole::moving, task.handle), whole_motion(task),
            SettleLine{settle_limit}};
}

PointCloud clean_creature(PageStudio& studio) {
    ShapeOptions options;
    options.points = 50'000;
    options.outliers = 0;
    return make_shape(Shape::creature, options, studio.workers, studio.progress);
}

void add_scan_rows(
    PageStudio& studio, PageSection& section,
    const std::function<PageRow(const std::string& name, PointCloud cloud, const fs::path& file)>& draw) {
    for (const NamedScan& scan : scans_of_the_paper()) {
        if (const auto path = find_data_file(studio.scans, scan.file))
            section.rows.push_back(draw(scan.name, read_cloud(*path, studio.progress), *path));
        else
            section.missing.push_back(missing_words(studio.scans, scan.file) + ", so it is not shown here.");
    }
}

void write_session(PageStudio& studio, const PageScene& scene) {
    Session session;
    session.cloud =
        scene.cloud_file.empty() ? fs::path(cloud_file_name(scene)) : fs::absolute(scene.cloud_file);
    session.points = scene.cloud.size();
    session.settings = scene.settings;
    std::string text = header_text(session) + "\n";
    for (const SessionAction& act : scene.acts) text += to_text(act) + "\n";
    write_text(studio, scene.name + ".knead", text);
    const std::string name = cloud_file_name(scene);
    if (!scene.cloud_file.empty() || std::ranges::find(studio.files, name) != studio.files.end()) return;
    write_cloud(studio.folder / name, scene.cloud, {}, studio.progress);
    studio.files.push_back(name);
}

std::unique_ptr<Document> carry_out(PageStudio& studio, const PageScene& scene, const Settings& settings) {
    auto document = std::make_unique<Document>(scene.cloud, settings, studio.workers, studio.upsampler);
    for (const SessionAction& act : scene.acts) {
        if (const auto* handle = std::get_if<HandleLine>(&act)) document->declare(*handle, scene.name);
        if (const auto* drag = std::get_if<DragLine>(&act))
            document->drag(*drag, scene.name, studio.progress);
        if (const auto* settling = std::get_if<SettleLine>(&act))
            document->settle(*settling, studio.progress);
    }
    return document;
}

std::vector<Index> holders_of_points(const Pipeline& pipeline) {
    std::vector<Index> holders = pipeline.labels().point;
    for (Index& holder : holders) holder = pipeline.handle_of(holder);
    return holders;
}

PageShape shape_of(PageStudio& studio, Document& document) {
    PageShape shape;
    shape.positions = document.shape(studio.progress).positions;
    const Pipeline& pipeline = document.pipeline();
    shape.order = &pipeline.order();
    shape.graph = &pipeline.graph();
    shape.opened = pipeline.opened().positions;
    shape.handle = holders_of_points(pipeline);
    return shape;
}

PagePicture draw_scene(PageStudio& studio, PageScene& scene, const std::string& suffix,
                       const PageShape& shape) {
    if (scene.view.framed.empty()) {
        scene.view.framed.assign(shape.positions.begin(), shape.positions.end());
        if (scene.rest_is_shown)
            scene.view.framed.insert(scene.view.framed.end(), shape.opened.begin(), shape.opened.end());
    }
    PageShape seen = shape;
    seen.solid = scene.solid;
    PagePicture picture;
    picture.file = scene.name + "-" + suffix + ".png";
    studio.progress.step("drawing " + picture.file, 0);
    studio.drawer.draw(studio.folder / picture.file, seen, scene.view);
    studio.files.push_back(picture.file);
    return picture;
}

std::string view_option(const PageView& view) {
    if (view.up == UpAxis::y) return "--view top";
    return "--view " + digits_text(view.azimuth, 0) + "," + digits_text(view.elevation, 0);
}

std::string replay_command(const PageScene& scene, const std::string& options, const PagePicture& picture) {
    return "knead replay " + scene.name + ".knead " + options + (options.empty() ? "" : " ") +
           view_option(scene.view) + " --picture " + picture.file;
}

} // namespace knead
