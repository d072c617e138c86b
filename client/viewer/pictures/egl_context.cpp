#include "client/viewer/pictures/egl_context.h"

#include <array>
#include <epoxy/egl.h>
#include <string>

namespace scree {
namespace {

constexpr const char* gl_advice =
    "; install libegl1 and libgl1-mesa-dri (Mesa's software driver needs no GPU), or run the viewer in a "
    "window";

EGLDisplay open_display() {
  // epoxy aborts on EGL functions that the library lacks: ask before calling.
  if (!epoxy_has_egl()) return EGL_NO_DISPLAY;
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless") ||
      !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base"))
    return EGL_NO_DISPLAY;
  return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

EGLContext make_desktop_context(EGLDisplay display, EGLConfig config, bool debug) {
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return EGL_NO_CONTEXT;
  const std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                         3,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         3,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_CONTEXT_OPENGL_DEBUG,
                                         debug ? EGL_TRUE : EGL_FALSE,
                                         EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

EGLContext make_es_context(EGLDisplay display, EGLConfig config) {
  if (eglBindAPI(EGL_OPENGL_ES_API) != EGL_TRUE) return EGL_NO_CONTEXT;
  const std::array<EGLint, 5> attributes{EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0,
                                         EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

}  // namespace

Result<std::unique_ptr<EglContext>> EglContext::create(bool debug) {
  const EGLDisplay display = open_display();
  if (display == EGL_NO_DISPLAY)
    return fail(
        std::string("offscreen drawing needs EGL with its surfaceless platform, which was not found") +
        gl_advice);
  EGLint major = 0;
  EGLint minor = 0;
  if (eglInitialize(display, &major, &minor) != EGL_TRUE)
    return fail(std::string("EGL was found but cannot start: no driver for it") + gl_advice);
  // No config: nothing is ever drawn but into framebuffer objects (EGL_KHR_no_config_context).
  EGLContext context = make_desktop_context(display, EGL_NO_CONFIG_KHR, debug);
  if (context == EGL_NO_CONTEXT) context = make_es_context(display, EGL_NO_CONFIG_KHR);
  if (context == EGL_NO_CONTEXT ||
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE) {
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    eglTerminate(display);
    return fail(std::string("EGL's driver has neither OpenGL 3.3 nor OpenGL ES 3.0") + gl_advice);
  }
  return std::unique_ptr<EglContext>(new EglContext(display, context));
}

EglContext::~EglContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

}  // namespace scree
