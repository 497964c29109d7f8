#include "ui/gl_error.h"
#include "ui/window_kinds.h"

#ifdef CELLCUT_OSMESA

#include "ui/memory_window.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <dlfcn.h>
#include <epoxy/gl.h>  // before osmesa.h, whose GL/gl.h it replaces

#include <GL/osmesa.h>

namespace cellcut {

namespace {

/// Names of OpenGL's functions, those of vendors left out.
constexpr const char* kGlFunctions[] = {
#include "osmesa_functions.inc"
};

/// Opened at run time: linked, its own gl… functions would stand beside those of the display's driver.
class OsmesaLibrary {
 public:
  OsmesaLibrary() {
    for (const char* const name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}) {
      handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
      if (handle_ != nullptr) return;
    }
    throw GlError("OSMesa: libOSMesa.so.8 is not installed (Debian: libosmesa6)");
  }
  ~OsmesaLibrary() { dlclose(handle_); }
  OsmesaLibrary(const OsmesaLibrary&) = delete;
  OsmesaLibrary& operator=(const OsmesaLibrary&) = delete;

  template <class Function>
  Function* find(const char* name) const {
    void* const address = dlsym(handle_, name);
    if (address == nullptr) throw GlError(std::string("OSMesa: has no ") + name);
    return reinterpret_cast<Function*>(address);
  }

 private:
  void* handle_ = nullptr;
};

/// While it lives, epoxy's functions are OSMesa's: epoxy itself asks GLX and EGL only.
class EpoxyRedirection {
 public:
  explicit EpoxyRedirection(const OsmesaLibrary& library) {
    const auto getProcAddress = library.find<decltype(OSMesaGetProcAddress)>("OSMesaGetProcAddress");
    for (const char* const name : kGlFunctions) {
      auto* const slot = static_cast<void**>(dlsym(RTLD_DEFAULT, ("epoxy_" + std::string(name)).c_str()));
      const auto function = reinterpret_cast<void*>(getProcAddress(name));
      if (slot == nullptr || function == nullptr) continue;
      saved_.emplace_back(slot, *slot);
      *slot = function;
    }
    if (saved_.empty()) throw GlError("OSMesa: epoxy's functions cannot be redirected");
  }
  ~EpoxyRedirection() {
    for (const auto& [slot, function] : saved_) *slot = function;
  }
  EpoxyRedirection(const EpoxyRedirection&) = delete;
  EpoxyRedirection& operator=(const EpoxyRedirection&) = delete;

 private:
  std::vector<std::pair<void**, void*>> saved_;
};

class OsmesaWindow final : public MemoryWindow {
 public:
  explicit OsmesaWindow(PixelSize size)
      : MemoryWindow(size),
        makeContextCurrent_(library_.find<decltype(OSMesaMakeCurrent)>("OSMesaMakeCurrent")),
        destroyContext_(library_.find<decltype(OSMesaDestroyContext)>("OSMesaDestroyContext")) {
    constexpr std::array<int, 9> kAttributes{OSMESA_FORMAT,
                                             OSMESA_RGBA,
                                             OSMESA_PROFILE,
                                             OSMESA_CORE_PROFILE,
                                             OSMESA_CONTEXT_MAJOR_VERSION,
                                             3,
                                             OSMESA_CONTEXT_MINOR_VERSION,
                                             3,
                                             0};
    const auto create = library_.find<decltype(OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs");
    context_ = create(kAttributes.data(), nullptr);
    if (context_ == nullptr) throw GlError("OSMesa: has no OpenGL 3.3 core");
    if (!isMadeCurrent()) {
      destroyContext_(context_);
      throw GlError("OSMesa: OSMesaMakeCurrent refuses");
    }
  }
  ~OsmesaWindow() override {
    makeContextCurrent_(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    destroyContext_(context_);
  }

  WindowKind kind() const override { return WindowKind::kOsmesa; }

  void makeCurrent() override {
    if (!isMadeCurrent()) throw GlError("OSMesa: OSMesaMakeCurrent refuses");
  }

 private:
  bool isMadeCurrent() {
    return makeContextCurrent_(context_, unused_.data(), GL_UNSIGNED_BYTE, kUnusedSize, kUnusedSize) == GL_TRUE;
  }

  // OSMesa wants a picture of its own; everything is drawn to framebuffer objects.
  static constexpr int kUnusedSize = 4;
  std::array<std::uint8_t, std::size_t{kUnusedSize} * kUnusedSize * 4> unused_{};

  OsmesaLibrary library_;
  EpoxyRedirection redirection_{library_};
  decltype(OSMesaMakeCurrent)* makeContextCurrent_;
  decltype(OSMesaDestroyContext)* destroyContext_;
  OSMesaContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<Window> openOsmesaWindow(const WindowSettings& settings) {
  return std::make_unique<OsmesaWindow>(settings.size);
}

}  // namespace cellcut

#else

namespace cellcut {

std::unique_ptr<Window> openOsmesaWindow(const WindowSettings& /*settings*/) {
  throw GlError("OSMesa: this program was built without it (Debian: libosmesa6-dev, then configure again)");
}

}  // namespace cellcut

#endif
