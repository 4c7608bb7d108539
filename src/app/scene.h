#pragma once
// The cloud in the window: hands the renderer what changed, and puts its picture into the middle of the
// window.

#include "app/ui.h"
#include "render/headless.h"

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

    // Whether the processor draws the points.
    bool is_drawn_in_software() const;

    // Whether the cloud will soon look different though nothing happens: call take_in() again in a moment.
    bool expects_more() const;

    // Draws the cloud, or goes on with what is missing, into the window's framebuffer, as large as the view
    // and with its lower left corner there, in pixels; with half as many pixels each way if it is to be
    // coarse.
    DrawResult draw(const Editor& editor, PointLook look, std::size_t budget, bool coarse, int left,
                    int bottom);

    // The same as a picture of its own, as finely as a picture may be: with twice as many pixels each way, or
    // as many as the view has. All points are drawn. `bare`: of the cloud alone, without what stands for
    // handles, selection and the solver, and without the ground. The next draw() begins anew.
    Picture picture(const Editor& editor, PointLook look, bool bare);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace knead
