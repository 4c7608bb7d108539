#include "render/headless.h"

#include "base/error.h"
#include "render/gl_objects.h"

#include <epoxy/egl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <dlfcn.h>

namespace knead {

namespace {

// The words for whoever has no EGL.
[[noreturn]] void refuse(const std::string& why) {
    throw Error(Trouble::usage, "",
                "pictures need OpenGL 4.1 through EGL, and " + why +
                    "; on Debian, `apt-get install libegl1 libgl1 libgl1-mesa-dri` brings a renderer that "
                    "needs no graphics card");
}

// libepoxy ends the program where a library is missing, so they are looked for first.
void require_library(std::initializer_list<const char*> names) {
    for (const char* name : names)
        if (::dlopen(name, RTLD_LAZY | RTLD_GLOBAL)) return; // kept open for the rest of the program
    refuse(std::string("there is no ") + *names.begin());
}

bool names(const char* extensions, std::string_view wanted) {
    const std::string padded = std::string(" ") + (extensions ? extensions : "") + " ";
    return padded.find(" " + std::string(wanted) + " ") != std::string::npos;
}

// All displays that may give a context, the most wanted first: graphics cards, Mesa in software.
std::vector<EGLDisplay> candidate_displays() {
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    std::vector<EGLDisplay> displays;
    if (!names(client, "EGL_EXT_platform_base")) return displays;
    if (names(client, "EGL_EXT_device_enumeration") && names(client, "EGL_EXT_platform_device")) {
        std::array<EGLDeviceEXT, 32> devices{};
        EGLint count = 0;
        if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count)) {
            const auto is_hardware = [](EGLDeviceEXT device) {
                return !names(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
            };
            const auto end = devices.begin() + count;
            std::stable_partition(devices.begin(), end, is_hardware);
            for (auto device = devices.begin(); device != end; ++device)
                displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, *device, nullptr));
        }
    }
    if (names(client, "EGL_MESA_platform_surfaceless"))
        displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
    return displays;
}

EGLContext make_context(EGLDisplay display) {
    if (!names(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context")) return EGL_NO_CONTEXT;
    if (!eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) return EGL_NO_CONTEXT;
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 1,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
    return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
}

} // namespace

struct HeadlessContext::State {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
};

HeadlessContext::HeadlessContext() : state_(std::make_unique<State>()) {
    require_library({"libEGL.so.1"});
    require_library({"libOpenGL.so.0", "libGL.so.1"});
    for (EGLDisplay display : candidate_displays()) {
        if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) continue;
        EGLContext context = make_context(display);
        if (context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
            *state_ = {display, context};
            return;
        }
        if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
        eglTerminate(display);
    }
    refuse("EGL has no driver that gives it");
}

HeadlessContext::~HeadlessContext() {
    eglMakeCurrent(state_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(state_->display, state_->context);
    eglTerminate(state_->display);
}

std::string HeadlessContext::renderer() const {
    return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

namespace {

// sRGB bytes to light, and light (0 … 4095) back to bytes: pixels are averaged as light.
struct Gamma {
    std::array<float, 256> light{};
    std::array<std::uint8_t, 4096> byte{};
    Gamma() {
        for (std::size_t i = 0; i < light.size(); ++i) {
            const double v = static_cast<double>(i) / 255;
            light[i] = static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
        }
        for (std::size_t i = 0; i < byte.size(); ++i) {
            const double v = static_cast<double>(i) / 4095;
            const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
            byte[i] = static_cast<std::uint8_t>(std::lround(255 * s));
        }
    }
};

// `drawn`: rgba rows from the bottom, `factor` times as wide and high as the picture.
Picture averaged(const std::vector<std::uint8_t>& drawn, Viewport viewport, int factor) {
    static const Gamma gamma;
    Picture picture{viewport.width, viewport.height, {}};
    const auto width = static_cast<std::size_t>(viewport.width);
    const auto height = static_cast<std::size_t>(viewport.height);
    const auto f = static_cast<std::size_t>(factor);
    picture.rgb.resize(3 * width * height);
    const float share = 4095.0f / static_cast<float>(f * f);
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                float sum = 0;
                for (std::size_t j = 0; j < f; ++j)
                    for (std::size_t i = 0; i < f; ++i)
                        sum +=
                            gamma.light[drawn[4 * (((height - 1 - y) * f + j) * width * f + x * f + i) + c]];
                picture.rgb[3 * (y * width + x) + c] =
                    gamma.byte[static_cast<std::size_t>(sum * share + 0.5f)];
            }
        }
    }
    return picture;
}

} // namespace

Picture draw_picture(PointRenderer& renderer, const Camera& camera, Viewport viewport, const PointLook& look,
                     int supersampling) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    const int longest = std::max(viewport.width, viewport.height);
    const int factor = std::clamp(largest / longest, 1, std::clamp(supersampling, 1, 4));
    const Viewport drawn{viewport.width * factor, viewport.height * factor};

    GlTexture color;
    glBindTexture(GL_TEXTURE_2D, color);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, drawn.width, drawn.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 nullptr);
    GlFramebuffer target;
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color, 0);

    PointLook large = look;
    large.pixel_scale *= static_cast<float>(factor);
    renderer.draw(camera, drawn, large, renderer.points() + 1, PictureTarget(target));
    std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(drawn.width) *
                                     static_cast<std::size_t>(drawn.height));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, drawn.width, drawn.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return averaged(pixels, viewport, factor);
}

} // namespace knead
