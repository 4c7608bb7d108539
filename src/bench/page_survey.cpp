// The survey's four shapes, with few samples and with all.

#include "base/counts.h"
#include "bench/deviation.h"
#include "bench/page_studio.h"
#include "bench/posing.h"
#include "bench/text_table.h"

#include <cmath>

namespace knead {

namespace {

PageView view_of(const std::string& name) {
    PageView view;
    if (name == "cactus") // which bends in the plane of y and z
        view.azimuth = 80;
    else if (name == "plane" || name == "made-plane")
        view.azimuth = -40, view.elevation = 20;
    else
        view.azimuth = 15, view.elevation = 10;
    return view;
}

PageRow row_of(PageStudio& studio, const DeformationTask& task) {
    PageScene scene;
    scene.name = task.name;
    scene.cloud = task.cloud;
    scene.acts = acts_of(task);
    scene.view = view_of(task.name);
    write_session(studio, scene);
    PageRow row{task.name + ", " + grouped(task.cloud.size()) + " points", {}};
    std::vector<float> every_point;
    const std::optional<std::uint64_t> counts[] = {std::nullopt, 1000U, 200U, 50U};
    for (const auto& count : counts) {
        const auto document = carry_out(studio, scene, with_samples(count));
        const PageShape shape = shape_of(studio, *document);
        if (!count) every_point.assign(shape.positions.begin(), shape.positions.end());
        const std::string number = count ? std::to_string(*count) : "all";
        PagePicture picture = draw_scene(studio, scene, number, shape);
        const double rms = deviation_between(shape.positions, every_point, document->bounds().diagonal()).rms;
        picture.caption = count ? grouped(*count) + " samples: " + digits_text(100 * rms, 2) +
                                      " % of D rms from every point a sample."
                                : "Every point a sample.";
        picture.command = replay_command(scene, "--samples " + number, picture);
        row.pictures.insert(row.pictures.begin(), std::move(picture)); // 50, 200, 1000, all
    }
    return row;
}

} // namespace

PageSection survey_section(PageStudio& studio) {
    PageSection section{
        "Samples do not show",
        "The shapes of Botsch and Sorkine's survey: plane shifted, cylinder bent 120°, bar twisted "
        "135°, cactus bent 70°, each in one frame and settled. With fewer samples the same shape "
        "is to be seen: rms 0.2 % of D at 1000, 0.45 at 200, 0.9 at 50.",
        {},
        {}};
    if (const auto folder = survey_folder(studio.survey)) {
        for (const std::string& name : survey_names())
            section.rows.push_back(row_of(studio, read_survey_task(*folder, name)));
    } else {
        section.missing.push_back(missing_words(studio.survey, "survey shape") +
                                  "; likenesses from knead's own generator stand in for three of the four.");
        for (const std::string& name : generated_names())
            section.rows.push_back(row_of(studio, generated_task(name, studio.workers, studio.progress)));
    }
    return section;
}

} // namespace knead
