#pragma once
// Scenes of the evaluation's page: a cloud and the session that poses it, carried out, drawn and written.

#include "bench/data_files.h"
#include "bench/page_drawing.h"
#include "bench/page_html.h"
#include "bench/survey.h"
#include "edit/document.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace knead {

struct PageScene {
    std::string name; // of its files: "armadillo-figure-1"
    PointCloud cloud;
    std::filesystem::path cloud_file; // where the cloud came from; empty: CLOUD_NAME.ply is written
    std::string cloud_name;           // of that file; empty: as `name`
    Settings settings;
    std::vector<SessionAction> acts; // handles, drags, settlings
    PageView view;                   // `framed` is filled from the first shape that is drawn
    bool solid = false;
    bool rest_is_shown = false; // in the row, so that the camera must have it in view
};

// What the sections are made with.
struct PageStudio {
    Workers& workers;
    Upsampler& upsampler;
    Progress& progress;
    PageDrawer& drawer;
    const DataFolders& scans;
    const DataFolders& survey;
    std::filesystem::path folder;   // where everything is written
    std::vector<std::string> files; // and what was
};

// A task's handles, its drag in one frame and a settling.
std::vector<SessionAction> acts_of(const DeformationTask& task);

// The creature as a scanner without strays would see it, 50,000 points.
PointCloud clean_creature(PageStudio& studio);

// A row of each scan of the paper that is here, drawn by `draw`, which takes the scan's name, its cloud and
// its file; of the others the section says that they are missing.
void add_scan_rows(PageStudio& studio, PageSection& section,
                   const std::function<PageRow(const std::string& name, PointCloud cloud,
                                               const std::filesystem::path& file)>& draw);

// Writes the scene's session, NAME.knead, and its cloud where that came from no file.
void write_session(PageStudio& studio, const PageScene& scene);

// Carries out the acts with these settings.
std::unique_ptr<Document> carry_out(PageStudio& studio, const PageScene& scene, const Settings& settings);

// The shape as the document has it, as PageDrawer takes it; good until its next act.
PageShape shape_of(PageStudio& studio, Document& document);
// Which handle holds each point, in the order of computation; no_index: none.
std::vector<Index> holders_of_points(const Pipeline& pipeline);

// Draws into NAME-SUFFIX.png. The first picture of a scene chooses its camera. The caption is left to the
// caller.
PagePicture draw_scene(PageStudio& studio, PageScene& scene, const std::string& suffix,
                       const PageShape& shape);

// "knead replay NAME.knead --samples 200 --view 15,10 --picture NAME-200.png", with these options. Of a cloud
// with y up the front is what `--view top` sees.
std::string view_option(const PageView& view);
std::string replay_command(const PageScene& scene, const std::string& options, const PagePicture& picture);

// The sections.
PageSection survey_section(PageStudio& studio);
PageSection elasticity_section(PageStudio& studio);
PageSection posed_section(PageStudio& studio);     // Figure 1
PageSection neighbors_section(PageStudio& studio); // Figure 2
PageSection pipeline_section(PageStudio& studio);  // in place of Figure 3
PageSection weights_section(PageStudio& studio);   // Figure 4
PageSection large_section(PageStudio& studio);     // in place of Figure 5

} // namespace knead
