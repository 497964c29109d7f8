#include "ui/gl_error.h"
#include "ui/memory_window.h"
#include "ui/window_kinds.h"

#include <array>
#include <cstdint>
#include <dlfcn.h>
#include <utility>
#include <vector>

#include <epoxy/gl.h>

namespace cellcut {

namespace {

// From Mesa's GL/osmesa.h, whose GL/gl.h cannot stand beside epoxy's.
using OsmesaContext = struct osmesa_context*;
using CreateContextAttribs = OsmesaContext(const int* attributes, OsmesaContext shared);
using MakeCurrent = GLboolean(OsmesaContext context, void* picture, GLenum type, GLsizei width, GLsizei height);
using DestroyContext = void(OsmesaContext context);
using GetProcAddress = void (*(const char* name))();
constexpr int kFormat = 0x22;
constexpr int kProfile = 0x33;
constexpr int kCoreProfile = 0x34;
constexpr int kMajorVersion = 0x36;
constexpr int kMinorVersion = 0x37;

/// Names of OpenGL's functions, those of vendors left out.
constexpr const char* kGlFunctions[] = {
#include "osmesa_functions.inc"
};

/// Opened at run time: linked, its own gl… functions would stand beside those of the display's driver.
class OsmesaLibrary {
 public:
  OsmesaLibrary() {
    for (const char* const name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}) {
      // It stays loaded: what it allocates once would be lost with it each time.
      handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
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
    const auto getProcAddress = library.find<GetProcAddress>("OSMesaGetProcAddress");
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
        makeContextCurrent_(library_.find<MakeCurrent>("OSMesaMakeCurrent")),
        destroyContext_(library_.find<DestroyContext>("OSMesaDestroyContext")) {
    constexpr std::array<int, 9> kAttributes{kFormat,       GL_RGBA, kProfile, kCoreProfile, kMajorVersion, 3,
                                             kMinorVersion, 3,       0};
    const auto create = library_.find<CreateContextAttribs>("OSMesaCreateContextAttribs");
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
  MakeCurrent* makeContextCurrent_;
  DestroyContext* destroyContext_;
  OsmesaContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<Window> openOsmesaWindow(const WindowSettings& settings) {
  return std::make_unique<OsmesaWindow>(settings.size);
}

}  // namespace cellcut
