#include "bench/page.h"

#include "base/temporary_folder.h"
#include "base/whole_file.h"
#include "bench/machine.h"
#include "bench/page_studio.h"
#include "upsample/devices.h"

namespace knead {

namespace {

std::string introduction() {
    const Machine machine = this_machine();
    return "knead " + machine.version + " (" + machine.commit +
           "). What stays is blue, what moves has a colour, what is free is grey. Under every picture stands "
           "the "
           "command that shows the same shape, given in this page's folder; the numbers are those of `knead "
           "evaluate`, D being the diagonal of the bounding box.";
}

} // namespace

void refuse_bad_page(const std::filesystem::path& folder) {
    Workers workers(1);
    const PageDrawer drawer(workers);
    const TemporaryFolder probe(folder);
}

void write_evaluation_page(const PageOptions& options, Progress& progress) {
    Workers workers(options.threads);
    PageDrawer drawer(workers);
    const UpsamplerChoice choice = make_upsampler(options.device, workers, options.threads);
    TemporaryFolder folder(options.folder);
    PageStudio studio{workers,       *choice.upsampler, progress,      drawer,
                      options.scans, options.survey,    folder.path(), {}};
    const std::vector<PageSection> sections{survey_section(studio),   elasticity_section(studio),
                                            posed_section(studio),    neighbors_section(studio),
                                            pipeline_section(studio), weights_section(studio),
                                            large_section(studio)};
    FileInTheMaking page(folder.path() / "index.html");
    page.write(std::string_view(page_html("How well knead deforms", introduction(), sections)));
    page.commit();
    folder.hand_over();
}

} // namespace knead
