#pragma once
// The pictures of a replay: one of the last shape, one of every frame.

#include "cli/pictures.h"
#include "edit/replay.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace knead {

// Whether a frame of a replay may have this name.
bool is_name_of_frame(const std::filesystem::path& name);

struct ReplayPictureOptions {
    std::string picture; // a PNG file, or empty
    std::string frames;  // a folder, or empty
    PictureOptions look;

    bool wanted() const { return !picture.empty() || !frames.empty(); }
};

// Draws while a replay runs. Frames go into a temporary folder beside theirs, and take their place together
// with everything else that the replay writes, so that one that fails leaves nothing behind.
class ReplayPictures {
public:
    // Throws Error as PictureMaker does, and (output) for targets that cannot be written to. Drawing is
    // cancelled by `progress`, which must outlive it.
    ReplayPictures(const ReplayPictureOptions& options, Progress& progress);
    ~ReplayPictures();

    // For ReplayOptions; they refer to this object.
    ShapeSeen after_frame();
    ShapeSeen after_last();

    // For ReplayOptions, too: adds the picture, and the folder, which is made if it is not there, with
    // frame-000001.png and so on; other files in it stay.
    std::function<void(Outputs&)> adding();

    // Of frames in the folder that follow the last one of this run, from a longer run before it: they stay,
    // and who makes a film of the folder should know. Empty if there are none.
    std::string words_about_other_frames() const;

    // The targets: the picture, and the folder.
    std::vector<std::filesystem::path> targets() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace knead
