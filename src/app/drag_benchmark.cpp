#include "app/drag_benchmark.h"

#include "base/error.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

namespace knead {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const auto place = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5);
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(place));
    return values[place];
}

// Where the cloud lies on the screen, from left to right.
struct Extent {
    double left = std::numeric_limits<double>::infinity();
    double right = -std::numeric_limits<double>::infinity();
};
Extent extent_on_screen(const Editor& editor) {
    Extent extent;
    const std::vector<float>& positions = editor.frame.positions;
    for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
        const glm::dvec3 point(positions[i], positions[i + 1], positions[i + 2]);
        const auto projected = project(editor.camera, editor.viewport, point);
        if (!projected) continue;
        extent.left = std::min(extent.left, projected->pixel.x);
        extent.right = std::max(extent.right, projected->pixel.x);
    }
    return extent;
}

// Selects the strip of the screen from x to x, through the cloud, and makes it a handle.
void make_handle(Editor& editor, double from, double to, HandleRole role) {
    const ScreenBox strip{{from, 0}, {to, editor.viewport.height}};
    apply(editor, SelectRegion{strip, SelectMode::replace, true});
    apply(editor, MakeHandle{role, ""});
}

// Plays the artist, and times what is shown.
class Artist final : public EditorObserver {
public:
    explicit Artist(const DragBenchmarkOptions& options) : options_(options) {}

    std::vector<Input> play(Editor& editor) override {
        switch (stage_) {
        case Stage::opening:
            wait_for_cloud(editor);
            break;
        case Stage::handles:
            make_handles(editor);
            break;
        case Stage::preparing:
            return begin(editor);
        case Stage::dragging:
            return drag();
        case Stage::done:
            break;
        }
        return {};
    }

    bool done() const override { return stage_ == Stage::done; }

    void shown(const Editor& editor, const ShownPicture& picture) override {
        const Clock::time_point now = Clock::now();
        if (stage_ == Stage::handles && result_.opened == 0) result_.opened = seconds_between(start_, now);
        result_.opengl = picture.opengl;
        if (stage_ != Stage::dragging || !editor.frame.shows_pose) return;
        if (result_.pictures == 0) first_picture_ = now;
        if (result_.pictures > 0) frames_.push_back(seconds_between(last_picture_, now));
        last_picture_ = now;
        ++result_.pictures;
        if (editor.frame.version != last_version_) ++result_.poses;
        last_version_ = editor.frame.version;
        ages_.push_back(seconds_between(editor.frame.pose_set, now));
        solves_.push_back(editor.frame.solve);
        points_.push_back(static_cast<double>(picture.points));
        result_.whole += picture.whole_pixels ? 1 : 0;
        if (editor.document) result_.samples = editor.document->samples;
        if (ages_.back() < result_.age_largest) return;
        result_.age_largest = ages_.back();
        result_.largest_at = seconds_between(first_picture_, now);
    }

    DragBenchmark result() {
        result_.seconds = seconds_between(first_picture_, last_picture_);
        result_.age_median = quantile(ages_, 0.5);
        result_.age_95 = quantile(ages_, 0.95);
        result_.frame_median = quantile(frames_, 0.5);
        result_.frame_95 = quantile(frames_, 0.95);
        result_.solve_median = quantile(solves_, 0.5);
        result_.points_median = quantile(points_, 0.5);
        result_.points_least = quantile(points_, 0);
        return result_;
    }

private:
    enum class Stage { opening, handles, preparing, dragging, done };

    void wait_for_cloud(const Editor& editor) {
        if (!editor.document && !editor.opening && !editor.live && seconds_between(start_, Clock::now()) > 5)
            stage_ = Stage::done; // the notice went to the window
        if (!editor.document) return;
        result_.points = editor.frame.positions.size() / 3;
        stage_ = Stage::handles;
    }

    void make_handles(Editor& editor) {
        if (result_.opened == 0 || editor.status.busy) return;
        const Extent extent = extent_on_screen(editor);
        const double width = extent.right - extent.left;
        make_handle(editor, extent.left, extent.left + 0.15 * width, HandleRole::fixed);
        make_handle(editor, extent.right - 0.15 * width, extent.right, HandleRole::moving);
        middle_ = {extent.right - 0.07 * width, 0.5 * editor.viewport.height};
        reach_ = 0.1 * width;
        stage_ = Stage::preparing;
    }

    std::vector<Input> begin(const Editor& editor) {
        if (editor.status.busy || !gizmo_of(editor)) return {};
        stage_ = Stage::dragging;
        drag_began_ = Clock::now();
        return {MouseMove{middle_, {}}, KeyPress{key('G'), {}}};
    }

    // The hand goes round in circles, so many motions a second.
    std::vector<Input> drag() {
        const double time = seconds_between(drag_began_, Clock::now());
        if (time > options_.seconds) {
            stage_ = Stage::done;
            return {KeyPress{Key::enter, {}}};
        }
        const auto motion = static_cast<std::size_t>(time * options_.per_second);
        if (motion == motions_) return {};
        motions_ = motion;
        const double angle = time * std::numbers::pi;
        return {MouseMove{middle_ + reach_ * glm::dvec2(std::sin(angle), 1 - std::cos(angle)), {}}};
    }

    const DragBenchmarkOptions& options_;
    Stage stage_ = Stage::opening;
    Clock::time_point start_ = Clock::now(), drag_began_, first_picture_, last_picture_;
    glm::dvec2 middle_{0.0};
    double reach_ = 0;
    std::size_t motions_ = 0;
    std::uint64_t last_version_ = 0;
    std::vector<double> ages_, frames_, solves_, points_;
    DragBenchmark result_;
};

} // namespace

DragBenchmark measure_drag(const DragBenchmarkOptions& options) {
    Artist artist(options);
    EditorOptions editor = options.editor;
    editor.observer = &artist;
    if (!editor.settings.samples) editor.settings.samples = Settings{}.samples; // not what the machine suits
    run_editor(editor);
    const DragBenchmark result = artist.result();
    if (result.pictures == 0)
        throw Error(Trouble::input, editor.file.string(), "could not be opened and dragged in the window");
    return result;
}

std::string drag_benchmark_text(const DragBenchmark& result) {
    char text[1024];
    const double poses = static_cast<double>(result.poses) / result.seconds;
    std::snprintf(
        text, sizeof text,
        "%zu points, %zu samples, drawn by %s\n"
        "first picture                %8.2f s after the start\n"
        "dragged for                  %8.2f s\n"
        "new poses on the screen      %8.1f a second\n"
        "from picture to picture      %8.1f ms median, %.1f ms 95 %%\n"
        "age of the pose when shown   %8.1f ms median, %.1f ms 95 %%, %.1f ms largest (after %.1f s)\n"
        "a frame of the solver        %8.1f ms median\n"
        "points in a picture          %8.0f median, %.0f least; %.0f %% of the pictures with every pixel\n",
        result.points, result.samples, result.opengl.c_str(), result.opened, result.seconds, poses,
        1e3 * result.frame_median, 1e3 * result.frame_95, 1e3 * result.age_median, 1e3 * result.age_95,
        1e3 * result.age_largest, result.largest_at, 1e3 * result.solve_median, result.points_median,
        result.points_least,
        100.0 * static_cast<double>(result.whole) / static_cast<double>(result.pictures));
    return text;
}

std::string drag_benchmark_json(const DragBenchmark& result) {
    char text[1024];
    std::snprintf(
        text, sizeof text,
        "{\"points\": %zu, \"samples\": %zu, \"opened\": %.6g, \"seconds\": %.6g, \"pictures\": %zu, "
        "\"poses\": %zu, \"frame\": {\"median\": %.6g, \"p95\": %.6g}, "
        "\"age\": {\"median\": %.6g, \"p95\": %.6g, \"largest\": %.6g}, \"solve\": %.6g, "
        "\"drawn\": {\"median\": %.6g, \"least\": %.6g}, \"whole\": %zu}\n",
        result.points, result.samples, result.opened, result.seconds, result.pictures, result.poses,
        result.frame_median, result.frame_95, result.age_median, result.age_95, result.age_largest,
        result.solve_median, result.points_median, result.points_least, result.whole);
    return text;
}

} // namespace knead
