#include "cli/replay_pictures.h"

#include "base/error.h"

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <system_error>

namespace knead {

namespace {

namespace fs = std::filesystem;

// The camera of the frames is chosen on the shape as opened; it stands farther away, as handles move out.
constexpr double room_for_motion = 1.35;

// A folder with a name of its own beside `target`, gone with all that is in it when this is over.
class TemporaryFolder {
public:
    explicit TemporaryFolder(const fs::path& target) {
        const fs::path parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
        std::string name = (parent / ".knead-frames-XXXXXX").string();
        if (!::mkdtemp(name.data()))
            throw Error(Trouble::output, target.string(),
                        "the folder cannot be made: " +
                            std::error_code(errno, std::generic_category()).message());
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

std::string frame_name(std::size_t number) {
    char text[32];
    std::snprintf(text, sizeof text, "frame-%06zu.png", number);
    return text;
}

// "frames/" is the folder "frames".
fs::path folder_of(const std::string& text) {
    fs::path path(text);
    return path.has_filename() || !path.has_parent_path() ? path : path.parent_path();
}

PictureShape seen(const Document& document, const RestShape& shape) {
    const Pipeline& pipeline = document.pipeline();
    return {document.cloud(), pipeline.order(), pipeline.opened().positions, shape.positions, shape.normals};
}

} // namespace

struct ReplayPictures::State {
    ReplayPictureOptions options;
    Workers workers;
    std::optional<PictureMaker> last, frame; // never both alive: each has a context of its own
    std::optional<TemporaryFolder> made;
    std::size_t frames = 0;
};

ReplayPictures::ReplayPictures(const ReplayPictureOptions& options) : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.options = options;
    if (!options.picture.empty()) refuse_bad_picture(options.picture);
    if (options.frames.empty()) {
        s.last.emplace(options.look, s.workers); // so that bad options are refused now
        return;
    }
    const fs::path folder = folder_of(options.frames);
    if (fs::exists(folder) && !fs::is_directory(folder))
        throw Error(Trouble::output, folder.string(), "is a file; name a folder for the frames");
    s.frame.emplace(options.look, s.workers, room_for_motion);
    s.made.emplace(folder);
}

ReplayPictures::~ReplayPictures() = default;

ShapeSeen ReplayPictures::after_frame() {
    if (!state_->frame) return {};
    return [this](const Document& document, const RestShape& shape) {
        State& s = *state_;
        if (s.frames == 0) s.frame->draw(seen(document, document.pipeline().opened())); // chooses the camera
        s.frame->draw(seen(document, shape));
        s.frame->write(s.made->path() / frame_name(++s.frames));
    };
}

ShapeSeen ReplayPictures::after_last() {
    if (state_->options.picture.empty()) return {};
    return [this](const Document& document, const RestShape& shape) {
        State& s = *state_;
        s.frame.reset();
        if (!s.last) s.last.emplace(s.options.look, s.workers);
        s.last->draw(seen(document, shape));
    };
}

std::vector<fs::path> ReplayPictures::write() {
    State& s = *state_;
    std::vector<fs::path> written;
    if (!s.options.picture.empty()) {
        s.last->write(s.options.picture);
        written.push_back(s.options.picture);
    }
    if (s.made) {
        const fs::path folder = folder_of(s.options.frames);
        try {
            fs::create_directories(folder);
            for (std::size_t i = 1; i <= s.frames; ++i)
                fs::rename(s.made->path() / frame_name(i), folder / frame_name(i));
        } catch (const fs::filesystem_error& error) {
            throw Error(Trouble::output, folder.string(),
                        "the frames cannot be put there: " + error.code().message());
        }
        written.push_back(folder);
    }
    return written;
}

} // namespace knead
