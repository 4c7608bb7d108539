// An OpenGL context that OpenCL shares memory with.

#include "upsample/opencl_devices.h"

#include <CL/cl_gl.h>

#include <array>
#include <initializer_list>

#include <dlfcn.h>

namespace knead {

namespace {

// A function of a library that is loaded already; null where it is not, or has none of that name.
template<typename Function>
Function* loaded(std::initializer_list<const char*> libraries, const char* name) {
    for (const char* library : libraries) {
        void* handle = ::dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
        if (!handle) continue;
        void* found = ::dlsym(handle, name);
        ::dlclose(handle); // whoever loaded it has it still
        if (found) return reinterpret_cast<Function*>(found);
    }
    return nullptr;
}

// An OpenGL context as OpenCL has to be told of it.
struct GlContext {
    void* context = nullptr;
    cl_context_properties kind_of_display = 0; // 0: there is none
    void* display = nullptr;
};

GlContext current_in(cl_context_properties kind_of_display, std::initializer_list<const char*> libraries,
                     const char* context_name, const char* display_name) {
    using Current = void*();
    Current* const context = loaded<Current>(libraries, context_name);
    Current* const display = loaded<Current>(libraries, display_name);
    if (!context || !display) return {};
    const GlContext current{context(), kind_of_display, display()};
    return current.context && current.display ? current : GlContext{};
}

GlContext current_context() {
    const GlContext glx = current_in(CL_GLX_DISPLAY_KHR, {"libGLX.so.0", "libGL.so.1"},
                                     "glXGetCurrentContext", "glXGetCurrentDisplay");
    if (glx.context) return glx;
    return current_in(CL_EGL_DISPLAY_KHR, {"libEGL.so.1"}, "eglGetCurrentContext", "eglGetCurrentDisplay");
}

std::array<cl_context_properties, 7> properties_of(cl_platform_id platform, const GlContext& drawn) {
    return {CL_GL_CONTEXT_KHR,
            reinterpret_cast<cl_context_properties>(drawn.context),
            drawn.kind_of_display,
            reinterpret_cast<cl_context_properties>(drawn.display),
            CL_CONTEXT_PLATFORM,
            reinterpret_cast<cl_context_properties>(platform),
            0};
}

// The device of the platform that draws the context; null where none does.
cl_device_id device_that_draws(cl_platform_id platform, const cl_context_properties* properties) {
    const auto get_info = reinterpret_cast<clGetGLContextInfoKHR_fn>(
        clGetExtensionFunctionAddressForPlatform(platform, "clGetGLContextInfoKHR"));
    cl_device_id device = nullptr;
    constexpr std::size_t wanted = sizeof(cl_device_id); // a pointer. NOLINT(bugprone-sizeof-expression)
    std::size_t size = 0;
    const bool is_told = get_info && get_info(properties, CL_CURRENT_DEVICE_FOR_GL_CONTEXT_KHR, wanted,
                                              &device, &size) == CL_SUCCESS;
    if (!is_told || size != wanted) return nullptr;
    return device;
}

// Null where the platform does not draw the context.
std::shared_ptr<const GlSharing> share_on(cl_platform_id platform, const GlContext& drawn) {
    const auto properties = properties_of(platform, drawn);
    GlSharing sharing;
    sharing.device = device_that_draws(platform, properties.data());
    if (!sharing.device) return nullptr;
    cl_int code = CL_SUCCESS;
    sharing.context =
        ContextHandle(clCreateContext(properties.data(), 1, &sharing.device, nullptr, nullptr, &code));
    return code == CL_SUCCESS ? std::make_shared<const GlSharing>(std::move(sharing)) : nullptr;
}

} // namespace

std::shared_ptr<const GlSharing> share_with_current_gl_context() {
    const GlContext drawn = current_context();
    if (!drawn.context) return nullptr;
    for (cl_platform_id platform : opencl_platforms())
        if (auto sharing = share_on(platform, drawn)) return sharing;
    return nullptr;
}

} // namespace knead
