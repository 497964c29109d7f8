#include "ui/gl_error.h"
#include "ui/memory_window.h"
#include "ui/window_kinds.h"

#include <array>
#include <cstdio>
#include <dlfcn.h>
#include <vector>

#include <epoxy/egl.h>

namespace cellcut {

namespace {

std::string eglErrorText(const char* call) {
  std::array<char, 16> code{};
  std::snprintf(code.data(), code.size(), "0x%04x", static_cast<unsigned>(eglGetError()));
  return std::string(call) + " says " + code.data();
}

/// epoxy ends the process when it needs a library that is not there.
void requireEglLibrary() {
  void* const library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) throw GlError("EGL: libEGL.so.1 is not installed (Debian: libegl1)");
  dlclose(library);
}

std::vector<EGLDisplay> candidateDisplays() {
  std::vector<EGLDisplay> displays;
  const char* const text = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto has = [text](const char* name) { return text != nullptr && epoxy_extension_in_string(text, name); };
  if (has("EGL_EXT_platform_base") && has("EGL_MESA_platform_surfaceless"))
    displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  if (has("EGL_EXT_platform_base") && has("EGL_EXT_platform_device") && has("EGL_EXT_device_enumeration")) {
    EGLint count = 0;
    eglQueryDevicesEXT(0, nullptr, &count);
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    eglQueryDevicesEXT(count, devices.data(), &count);
    for (const EGLDeviceEXT device : devices)
      displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
  }
  return displays;
}

class EglWindow final : public MemoryWindow {
 public:
  /// \throws GlError if this display has no OpenGL 3.3 without a surface
  EglWindow(EGLDisplay display, PixelSize size) : MemoryWindow(size), display_(display) {
    if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr))
      throw GlError(eglErrorText("eglInitialize"));
    if (!eglBindAPI(EGL_OPENGL_API)) throw GlError("no desktop OpenGL");
    constexpr std::array<EGLint, 5> kConfig{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                            EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display_, kConfig.data(), &config, 1, &count) || count == 0)
      throw GlError(eglErrorText("eglChooseConfig"));
    constexpr std::array<EGLint, 7> kVersion{
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, kVersion.data());
    if (context_ == EGL_NO_CONTEXT) throw GlError(eglErrorText("eglCreateContext"));
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
      const std::string reason = eglErrorText("eglMakeCurrent");
      eglDestroyContext(display_, context_);
      throw GlError(reason);
    }
  }

  // The display stays initialised: EGL hands the same one to everybody in the process, other windows included.
  ~EglWindow() override {
    if (eglGetCurrentContext() == context_) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
  }

  WindowKind kind() const override { return WindowKind::kEgl; }

  void makeCurrent() override {
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      throw GlError(eglErrorText("eglMakeCurrent"));
  }

 private:
  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Window> openEglWindow(const WindowSettings& settings) {
  requireEglLibrary();
  std::string reasons;
  for (const EGLDisplay display : candidateDisplays()) {
    try {
      return std::make_unique<EglWindow>(display, settings.size);
    } catch (const GlError& error) {
      if (!reasons.empty()) reasons += ", ";
      reasons += error.what();
    }
  }
  throw GlError("EGL: " + (reasons.empty() ? "no driver works without a display" : reasons) +
                " (Debian: libgl1-mesa-dri has one)");
}

}  // namespace cellcut
