#pragma once
// A renderer with no display, and the pixels that it draws.

#include "base/error.h"
#include "render/headless.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace knead::test {

using Pixel = std::array<int, 3>;

// Tests derive from this, once with the splats of OpenGL and once with those of the processor; they are
// skipped where there is no EGL.
class HeadlessScene : public testing::TestWithParam<PointRenderer::Drawing> {
protected:
    void SetUp() override {
        try {
            context.emplace();
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
        renderer.emplace(GetParam());
        flat.eye_dome = false;
        flat.shading = false;
        flat.background_top = flat.background_bottom = glm::vec3(0);
        flat.size_by_distance = false;
        flat.pixels = 5;
    }
    void TearDown() override {
        renderer.reset(); // before its context
        context.reset();
    }

    // A framebuffer of the viewport's size, cleared to magenta.
    GLuint target(Viewport size) {
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_2D, texture);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.width, size.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                     nullptr);
        glGenFramebuffers(1, &framebuffer);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
        const float magenta[4] = {1, 0, 1, 1};
        glClearBufferfv(GL_COLOR, 0, magenta);
        return framebuffer;
    }

    // What is in the target, by rows from the top.
    std::vector<Pixel> read(Viewport size) const {
        std::vector<std::uint8_t> bytes(4 * static_cast<std::size_t>(size.width * size.height));
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
        std::vector<Pixel> pixels;
        for (int y = size.height - 1; y >= 0; --y)
            for (int x = 0; x < size.width; ++x) {
                const std::uint8_t* p = &bytes[4 * static_cast<std::size_t>(y * size.width + x)];
                pixels.push_back({p[0], p[1], p[2]});
            }
        return pixels;
    }

    // Draws everything in one call.
    std::vector<Pixel> draw(const Camera& camera, Viewport size, const PointLook& look) {
        const GLuint to = target(size);
        EXPECT_TRUE(renderer->draw(camera, size, look, 1'000'000'000, to).complete);
        return read(size);
    }

    static Pixel at(const std::vector<Pixel>& pixels, Viewport size, glm::dvec2 pixel) {
        const auto x = static_cast<std::size_t>(pixel.x), y = static_cast<std::size_t>(pixel.y);
        return pixels.at(y * static_cast<std::size_t>(size.width) + x);
    }

    std::optional<HeadlessContext> context;
    std::optional<PointRenderer> renderer;
    PointLook flat; // colours as they are given, on black
    GLuint texture = 0, framebuffer = 0;
};

inline const auto both_ways =
    testing::Values(PointRenderer::Drawing::by_opengl, PointRenderer::Drawing::by_processor);
inline std::string name_of_way(const testing::TestParamInfo<PointRenderer::Drawing>& info) {
    return info.param == PointRenderer::Drawing::by_opengl ? "by_opengl" : "by_processor";
}

constexpr std::uint32_t rgba(unsigned r, unsigned g, unsigned b) {
    return r | g << 8U | b << 16U | 0xff000000U;
}

} // namespace knead::test
