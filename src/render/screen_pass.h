#pragma once
// Private to this room: the pass over the screen that makes a picture of the points' colours and depths. It
// is made by shaders/compose.frag on a graphics card, and by the processor where OpenGL runs in software;
// both compute the same.

#include "render/layer.h"

#include <memory>

namespace knead {

struct ScreenPass {
    Viewport viewport;
    glm::vec3 top{0.0f}, bottom{0.0f}; // background
    glm::ivec2 from{0}, to{0};         // pixels from the lower left: nothing of the points lies elsewhere
    glm::vec3 depth_scale{0, 1, 0};    // difference of depths (0 … 1) to pixels: x / (y + z · depth)
    int near = 1, far = 3;             // distances of the neighbours, in pixels
    float strength = 1;                // of the eye-dome lighting; 0: none
    float grain = 0;                   // half the usual diameter of a splat, in pixels
    glm::vec3 key{0, 0, 1};            // towards the light, in the camera's axes
    float pattern = 1;                 // pixels in a unit of the patterns
    bool relief = false;               // lit by the slopes of the depths
    bool patterns = false;             // of handles and selection
};

// By OpenGL.
class GlScreen {
public:
    GlScreen();
    ~GlScreen();
    GlScreen(const GlScreen&) = delete;
    GlScreen& operator=(const GlScreen&) = delete;

    void draw(const ScreenPass& pass, const Layer& shown, Layer& finished);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace knead
