#include "render/offscreen_context.h"

#include <array>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "pliant/core/error.h"

namespace pliant_render {
namespace {

[[noreturn]] void fail(const std::string& what) {
  pliant::fail_input("OpenGL: " + what +
                     "; pictures need OpenGL 3.3 through EGL without a surface: install libegl1 and libgl1-mesa-dri, "
                     "which draws with the processor where there is no graphics card");
}

EGLDisplay find_display() {
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
  }
  return eglGetDisplay(EGL_DEFAULT_DISPLAY);
}

}  // namespace

OffscreenContext::OffscreenContext() {
  display_ = find_display();
  if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) == EGL_FALSE) {
    fail("EGL has no display without a screen");
  }
  constexpr std::array<EGLint, 5> wanted = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                            EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  const bool has_api = eglBindAPI(EGL_OPENGL_API) != EGL_FALSE;
  if (!has_api || eglChooseConfig(display_, wanted.data(), &config, 1, &count) == EGL_FALSE || count == 0) {
    eglTerminate(display_);
    fail("EGL offers no OpenGL");
  }
  constexpr std::array<EGLint, 7> attributes = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, attributes.data());
  if (context_ == EGL_NO_CONTEXT || eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
    eglTerminate(display_);
    fail("the driver has no core context of version 3.3");
  }
  renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

OffscreenContext::~OffscreenContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

}  // namespace pliant_render
