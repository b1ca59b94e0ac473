// SPDX-License-Identifier: MIT
#include "offscreen_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>

namespace sherd::samples {

Result<std::unique_ptr<OffscreenContext>> OffscreenContext::create() {
    constexpr const char* kAdvice = "; install Mesa's EGL driver (libegl-mesa0, libgl1-mesa-dri)";
    const auto refuse = [&](const char* what) {
        return fail(ErrorCode::unsupported, std::string(what).append(kAdvice), "EGL surfaceless");
    };
    std::unique_ptr<OffscreenContext> self(new OffscreenContext);
    EGLDisplay display = EGL_NO_DISPLAY;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base") &&
        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        display =
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    }
    if (display == EGL_NO_DISPLAY) return refuse("EGL cannot render without a display");
    if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) return refuse("EGL does not start");
    self->display_ = display;
    eglBindAPI(EGL_OPENGL_API);
    constexpr std::array<EGLint, 5> kConfig{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE,
                                            EGL_PBUFFER_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    eglChooseConfig(display, kConfig.data(), &config, 1, &count);
    constexpr std::array<EGLint, 7> kContext{EGL_CONTEXT_MAJOR_VERSION,
                                             3,
                                             EGL_CONTEXT_MINOR_VERSION,
                                             3,
                                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                             EGL_NONE};
    EGLContext context =
        eglCreateContext(display, count > 0 ? config : nullptr, EGL_NO_CONTEXT, kContext.data());
    if (context == EGL_NO_CONTEXT) return refuse("there is no OpenGL 3.3 core here");
    self->context_ = context;
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
        return refuse("the OpenGL context cannot be made current without a surface");
    }
    return self;
}

OffscreenContext::~OffscreenContext() {
    if (display_ == nullptr) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != nullptr) eglDestroyContext(display_, context_);
    eglTerminate(display_);
}

}  // namespace sherd::samples
