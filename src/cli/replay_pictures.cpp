#include "cli/replay_pictures.h"

#include "base/outputs.h"

#include <cstdio>
#include <optional>
#include <utility>

namespace knead {

namespace {

namespace fs = std::filesystem;

// The camera of the frames is chosen on the shape as opened; it stands farther away, as handles move out.
constexpr double room_for_motion = 1.35;

std::string frame_name(std::size_t number) {
    char text[32];
    std::snprintf(text, sizeof text, "frame-%06zu.png", number);
    return text;
}

PictureShape seen(const Document& document, const RestShape& shape) {
    const Pipeline& pipeline = document.pipeline();
    return {document.cloud(), pipeline.order(), pipeline.opened().positions, shape.positions, shape.normals};
}

} // namespace

bool is_name_of_frame(const fs::path& name) {
    return name.extension() == ".png" && name.string().starts_with("frame-");
}

struct ReplayPictures::State {
    State(const ReplayPictureOptions& given, Progress& of_replay) : progress(of_replay), options(given) {}

    Progress& progress;
    ReplayPictureOptions options;
    Workers workers;
    std::optional<PictureMaker> last, frame; // never both alive: each has a context of its own
    std::optional<TemporaryFolder> made;
    std::size_t frames = 0;
};

ReplayPictures::ReplayPictures(const ReplayPictureOptions& options, Progress& progress)
    : state_(std::make_unique<State>(options, progress)) {
    State& s = *state_;
    if (!options.picture.empty()) refuse_bad_picture(options.picture);
    if (options.frames.empty()) {
        s.last.emplace(options.look, s.workers); // so that bad options are refused now
        return;
    }
    s.frame.emplace(options.look, s.workers, room_for_motion);
    s.made.emplace(folder_of(options.frames));
}

ReplayPictures::~ReplayPictures() = default;

ShapeSeen ReplayPictures::after_frame() {
    if (!state_->frame) return {};
    return [this](const Document& document, const RestShape& shape) {
        State& s = *state_;
        if (s.frames == 0)
            s.frame->draw(seen(document, document.pipeline().opened()), s.progress); // for the camera
        s.frame->draw(seen(document, shape), s.progress);
        s.frame->write(s.made->path() / frame_name(++s.frames));
    };
}

ShapeSeen ReplayPictures::after_last() {
    if (state_->options.picture.empty()) return {};
    return [this](const Document& document, const RestShape& shape) {
        State& s = *state_;
        s.frame.reset();
        if (!s.last) s.last.emplace(s.options.look, s.workers);
        s.last->draw(seen(document, shape), s.progress);
    };
}

std::function<void(Outputs&)> ReplayPictures::adding() {
    return [this](Outputs& outputs) {
        State& s = *state_;
        if (!s.options.picture.empty()) s.last->write(outputs.add(FileInTheMaking(s.options.picture)));
        if (s.made) outputs.add(std::move(*s.made));
    };
}

std::string ReplayPictures::words_about_other_frames() const {
    if (state_->options.frames.empty()) return {};
    const fs::path folder = folder_of(state_->options.frames);
    std::size_t last = state_->frames;
    std::error_code ignored;
    while (fs::exists(folder / frame_name(last + 1), ignored)) ++last;
    if (last == state_->frames) return {};
    return folder.string() + " holds frames of an earlier run, too, up to " + frame_name(last) +
           "; this one's last is " + (state_->frames > 0 ? frame_name(state_->frames) : "none");
}

std::vector<fs::path> ReplayPictures::targets() const {
    std::vector<fs::path> targets;
    if (!state_->options.picture.empty()) targets.emplace_back(state_->options.picture);
    if (!state_->options.frames.empty()) targets.push_back(folder_of(state_->options.frames));
    return targets;
}

} // namespace knead
