// The strip of elasticities: one bar, pulled, of every material.

#include "base/counts.h"
#include "bench/elasticity.h"
#include "bench/page_studio.h"
#include "bench/posing.h"
#include "bench/text_table.h"

#include <cmath>

namespace knead {

namespace {

constexpr double ratios[] = {-0.9, -0.5, 0.0, 0.3, 0.49};

PageRow strip_of(PageStudio& studio, bool solid) {
    const DeformationTask task = stretched_bar(solid, studio.workers, studio.progress);
    PageScene scene;
    scene.name = "pulled-" + task.name;
    scene.cloud = task.cloud;
    scene.acts = acts_of(task);
    scene.view.azimuth = 30;
    scene.view.elevation = 5;
    scene.view.size = {190, 560};
    scene.solid = solid;
    write_session(studio, scene);
    PageRow row{(solid ? "A solid, filled with points that have no surface, " : "A shell, ") +
                    grouped(task.cloud.size()) + " points",
                {}};
    for (const double ratio : ratios) {
        Settings settings;
        settings.poisson = ratio;
        const auto document = carry_out(studio, scene, settings);
        const PageShape shape = shape_of(studio, *document);
        const SlabStretch slab =
            slab_stretch(task.cloud.positions, document->positions(studio.progress), 0.5);
        PagePicture picture = draw_scene(studio, scene, digits_text(100 * ratio, 0), shape);
        const double measured = -std::log(slab.across) / std::log(slab.along);
        picture.caption = "Poisson's ratio " + digits_text(ratio, 2) + " asked, " + digits_text(measured, 2) +
                          " measured at mid-length: there " + digits_text(slab.across, 2) + " times as wide.";
        picture.command = replay_command(scene, "--set poisson=" + digits_text(ratio, 2), picture);
        row.pictures.push_back(std::move(picture));
    }
    return row;
}

} // namespace

PageSection elasticity_section(PageStudio& studio) {
    return {
        "Elasticity is physical",
        "A bar of 1 : 10, held at both ends and pulled until what is between is longer by 30 %: from auxetic "
        "(it swells) to rubber (it keeps its volume). 1000 samples.",
        {strip_of(studio, false), strip_of(studio, true)},
        {}};
}

} // namespace knead
