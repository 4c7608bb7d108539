#include "base/stopwatch.h"
#include "bench/posing.h"
#include "bench/statistics.h"
#include "peers/descent.h"

namespace knead::peers {

namespace {

// Without the device's build of the kernel, which is once a machine.
double preparation_seconds(const Pipeline& pipeline) {
    const StageSeconds& seconds = pipeline.seconds();
    return seconds.order + seconds.neighbors + seconds.sampling + seconds.geodesic + seconds.factorize;
}

} // namespace

Descent descend_with_knead(const DeformationTask& task, const std::optional<std::uint64_t>& samples,
                           std::size_t most_iterations, std::size_t repeats, Workers& workers,
                           Upsampler& upsampler) {
    SilentProgress progress;
    Settings settings = with_samples(samples);
    settings.iterations = 0; // the drag's frame is the start from Equation (1) alone
    std::unique_ptr<Document> document;
    std::vector<double> preparations;
    for (std::size_t r = 0; r < repeats; ++r) {
        document.reset();
        document = open_task(task, settings, workers, upsampler);
        document->prepare_ahead(progress);
        preparations.push_back(preparation_seconds(document->pipeline()));
    }

    Descent descent;
    descent.name = samples ? "knead" : "knead, every point";
    descent.preparation = summarize(preparations).median;
    descent.samples = document->pipeline().samples().size();
    const auto stop = [&](std::size_t iterations, double seconds) {
        descent.stops.push_back({iterations, seconds, document->pipeline().posed().positions});
    };
    document->begin_drag("handle", task.pivot, task.name, progress);
    const Stopwatch clock;
    document->drag_frame(task.pose, task.name, progress);
    double seconds = clock.seconds();
    document->end_drag();
    stop(0, seconds);
    document->begin_settling(progress);
    for (std::size_t i = 1; i <= most_iterations && !descent.at_rest; ++i) {
        descent.at_rest = document->settle_some(1, progress);
        seconds += document->log().iteration.back();
        if (is_stop(i) || descent.at_rest || i == most_iterations) stop(i, seconds);
    }
    document->end_settling();
    descent.iteration = summarize(document->log().iteration).median;
    return descent;
}

} // namespace knead::peers
