#include "app/drag_benchmark.h"

#include "base/error.h"
#include "base/memory.h"

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
    const auto place = static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)));
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
    const LineArray<float>& positions = editor.frame.positions();
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

// Notes the pictures of something that moves.
class Film {
public:
    void shown(const ShownPicture& picture, Clock::time_point now) {
        if (count_ == 0) first_ = now;
        if (count_ > 0) frames_.push_back(seconds_between(last_, now));
        last_ = now;
        points_.push_back(static_cast<double>(picture.points));
        ++count_;
        whole_ += picture.whole_pixels ? 1 : 0;
    }
    std::size_t count() const { return count_; }
    double seconds_to(Clock::time_point time) const { return seconds_between(first_, time); }
    MovingPictures result() const {
        return {seconds_to(last_),
                count_,
                whole_,
                quantile(frames_, 0.5),
                quantile(frames_, 0.95),
                quantile(points_, 0.5),
                quantile(points_, 0)};
    }

private:
    Clock::time_point first_, last_;
    std::size_t count_ = 0, whole_ = 0;
    std::vector<double> frames_, points_;
};

// Plays the artist, and times what is shown.
class Artist final : public EditorObserver {
public:
    explicit Artist(const DragBenchmarkOptions& options) : options_(options) {}

    std::vector<Input> play(Editor& editor) override {
        switch (stage_) {
        case Stage::opening:
            wait_for_cloud(editor);
            break;
        case Stage::orbiting:
            return orbit(editor);
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
        if (editor.document && result_.opened == 0) result_.opened = seconds_between(start_, now);
        result_.opengl = picture.opengl;
        if (stage_ == Stage::orbiting && motions_ > 0) orbit_.shown(picture, now);
        if (stage_ != Stage::dragging || !editor.frame.shows_pose) return;
        drag_.shown(picture, now);
        if (editor.frame.version != last_version_) {
            ++result_.poses;
            if (editor.frame.on_device) ++result_.poses_on_device;
        }
        last_version_ = editor.frame.version;
        ages_.push_back(seconds_between(editor.frame.pose_set, now));
        solves_.push_back(editor.frame.solve);
        if (editor.document) result_.samples = editor.document->samples;
        if (ages_.back() < result_.age_largest) return;
        result_.age_largest = ages_.back();
        result_.largest_at = drag_.seconds_to(now);
    }

    DragBenchmark result() {
        result_.orbit = orbit_.result();
        result_.drag = drag_.result();
        result_.age_median = quantile(ages_, 0.5);
        result_.age_95 = quantile(ages_, 0.95);
        result_.solve_median = quantile(solves_, 0.5);
        result_.memory = peak_memory();
        return result_;
    }

private:
    enum class Stage { opening, orbiting, handles, preparing, dragging, done };

    void wait_for_cloud(const Editor& editor) {
        if (!editor.document && !editor.opening && !editor.live && seconds_between(start_, Clock::now()) > 5)
            stage_ = Stage::done; // the notice went to the window
        if (!editor.document) return;
        result_.points = editor.frame.positions().size() / 3;
        stage_ = Stage::orbiting;
    }

    // The middle button held, the hand goes round in circles.
    std::vector<Input> orbit(Editor& editor) {
        if (result_.opened == 0 || editor.status.busy) return {};
        const glm::dvec2 middle(0.5 * editor.viewport.width, 0.5 * editor.viewport.height);
        const double reach = 0.25 * editor.viewport.height;
        if (result_.editable == 0) {
            began_ = Clock::now();
            result_.editable = seconds_between(start_, began_);
            camera_ = editor.camera;
            return {MousePress{MouseButton::middle, middle, {}}};
        }
        const double time = seconds_between(began_, Clock::now());
        if (time < options_.seconds / 2) return next_motion(time, middle, reach);
        motions_ = 0;
        stage_ = Stage::handles;
        return {MouseRelease{MouseButton::middle, middle, {}}};
    }

    void make_handles(Editor& editor) {
        apply(editor, MoveCamera{camera_});
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
        began_ = Clock::now();
        return {MouseMove{middle_, {}}, KeyPress{key('G'), {}}};
    }

    std::vector<Input> drag() {
        const double time = seconds_between(began_, Clock::now());
        if (time > options_.seconds) {
            stage_ = Stage::done;
            return {KeyPress{Key::enter, {}}};
        }
        return next_motion(time, middle_, reach_);
    }

    // The hand goes round in circles, so many motions a second.
    std::vector<Input> next_motion(double time, glm::dvec2 from, double reach) {
        const auto motion = static_cast<std::size_t>(time * options_.per_second);
        if (motion == motions_) return {};
        motions_ = motion;
        const double angle = time * std::numbers::pi;
        return {MouseMove{from + reach * glm::dvec2(std::sin(angle), 1 - std::cos(angle)), {}}};
    }

    const DragBenchmarkOptions& options_;
    Stage stage_ = Stage::opening;
    Clock::time_point start_ = Clock::now(), began_;
    Camera camera_; // before it orbits
    glm::dvec2 middle_{0.0};
    double reach_ = 0;
    std::size_t motions_ = 0;
    std::uint64_t last_version_ = 0;
    std::vector<double> ages_, solves_;
    Film orbit_, drag_;
    DragBenchmark result_;
};

} // namespace

DragBenchmark measure_drag(const DragBenchmarkOptions& options) {
    Artist artist(options);
    EditorOptions editor = options.editor;
    editor.observer = &artist;
    if (!editor.settings.samples) editor.settings.samples = Settings{}.samples; // not what the machine suits
    run_editor(editor);
    DragBenchmark result = artist.result();
    if (result.drag.pictures == 0)
        throw Error(Trouble::input, editor.file.string(), "could not be opened and dragged in the window");
    return result;
}

std::string drag_benchmark_text(const DragBenchmark& result) {
    const auto part_whole = [](const MovingPictures& film) {
        return 100.0 * static_cast<double>(film.whole) / static_cast<double>(film.pictures);
    };
    const MovingPictures &orbit = result.orbit, &drag = result.drag;
    char text[2048];
    std::snprintf(
        text, sizeof text,
        "%zu points, %zu samples, drawn by %s\n"
        "first picture                %8.2f s after the start, editable after %.2f s\n"
        "orbited for                  %8.2f s\n"
        "pictures                     %8.1f a second\n"
        "from picture to picture      %8.1f ms median, %.1f ms 95 %%\n"
        "points in a picture          %8.0f median, %.0f least; %.0f %% of the pictures with every pixel\n"
        "dragged for                  %8.2f s\n"
        "new poses on the screen      %8.1f a second, %.0f %% of them moved where they are drawn\n"
        "from picture to picture      %8.1f ms median, %.1f ms 95 %%\n"
        "age of the pose when shown   %8.1f ms median, %.1f ms 95 %%, %.1f ms largest (after %.1f s)\n"
        "a frame of the solver        %8.1f ms median\n"
        "points in a picture          %8.0f median, %.0f least; %.0f %% of the pictures with every pixel\n"
        "memory                       %8.0f MB at most\n",
        result.points, result.samples, result.opengl.c_str(), result.opened, result.editable, orbit.seconds,
        static_cast<double>(orbit.pictures - 1) / orbit.seconds, 1e3 * orbit.frame_median,
        1e3 * orbit.frame_95, orbit.points_median, orbit.points_least, part_whole(orbit), drag.seconds,
        static_cast<double>(result.poses) / drag.seconds,
        100.0 * static_cast<double>(result.poses_on_device) /
            static_cast<double>(std::max<std::size_t>(1, result.poses)),
        1e3 * drag.frame_median, 1e3 * drag.frame_95, 1e3 * result.age_median, 1e3 * result.age_95,
        1e3 * result.age_largest, result.largest_at, 1e3 * result.solve_median, drag.points_median,
        drag.points_least, part_whole(drag), 1e-6 * static_cast<double>(result.memory));
    return text;
}

namespace {

std::string film_json(const MovingPictures& film) {
    char text[512];
    std::snprintf(text, sizeof text,
                  "\"seconds\": %.6g, \"pictures\": %zu, \"whole\": %zu, \"frame\": {\"median\": %.6g, "
                  "\"p95\": %.6g}, \"drawn\": {\"median\": %.6g, \"least\": %.6g}",
                  film.seconds, film.pictures, film.whole, film.frame_median, film.frame_95,
                  film.points_median, film.points_least);
    return text;
}

} // namespace

std::string drag_benchmark_json(const DragBenchmark& result) {
    char text[2048];
    std::snprintf(text, sizeof text,
                  "{\"points\": %zu, \"samples\": %zu, \"opened\": %.6g, \"editable\": %.6g, "
                  "\"orbit\": {%s}, %s, \"poses\": %zu, \"poses_on_device\": %zu, "
                  "\"age\": {\"median\": %.6g, \"p95\": %.6g, \"largest\": %.6g}, \"solve\": %.6g, "
                  "\"memory\": %llu}\n",
                  result.points, result.samples, result.opened, result.editable,
                  film_json(result.orbit).c_str(), film_json(result.drag).c_str(), result.poses,
                  result.poses_on_device, result.age_median, result.age_95, result.age_largest,
                  result.solve_median, static_cast<unsigned long long>(result.memory));
    return text;
}

} // namespace knead
