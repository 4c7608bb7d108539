#pragma once
// The cloud in the window: hands the renderer what changed, and puts its picture into the middle of the
// window.

#include "app/ui.h"
#include "render/point_renderer.h"

#include <memory>

namespace knead {

// Owns the renderer and the framebuffer that it draws into. Needs the window's context.
class Scene {
public:
    Scene();
    ~Scene();
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    // Uploads what changed in the editor and in the way it is shown, and clears editor.changes.
    void take_in(Editor& editor, UiState& state);

    // Whether the cloud will soon look different though nothing happens: call take_in() again in a moment.
    bool expects_more() const;

    // Draws the cloud, or goes on with what is missing; with half as many pixels each way if it is to be
    // coarse.
    DrawResult draw(const Editor& editor, PointLook look, std::size_t budget, bool coarse);

    // Copies the picture into the window's framebuffer, its upper left corner there, in pixels from the
    // window's upper left, as large as the viewport.
    void show(int left, int top, Viewport viewport, int window_height);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace knead
