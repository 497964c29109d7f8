/// \file window.h
/// A place to draw and the input that comes from it: a real window, or memory where there is no display.
///
/// Drawing goes to a GlFramebuffer first, then to the window (present) or into a file (GlFramebuffer::read).
/// Threads: all members but wake() belong to the thread that made the window, which for GLFW is the main thread.
#pragma once

#include "ui/input_event.h"
#include "ui/pixel_size.h"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cellcut {

class GlFramebuffer;

enum class WindowKind {
  kGlfw,   ///< on the display
  kEgl,    ///< memory; Mesa's surfaceless platform first, then each EGL device
  kOsmesa  ///< memory, for machines whose EGL cannot start
};
/// "glfw", "egl", "osmesa".
std::string_view nameOf(WindowKind kind);

struct WindowSettings {
  PixelSize size{1280, 800};  ///< of the framebuffer, on a display as near as the system allows; ≥ 1 each
  std::string title = "cellcut";
};

class Window {
 public:
  virtual ~Window() = default;
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  virtual WindowKind kind() const = 0;
  /// Its context, OpenGL 3.3 core, becomes the thread's; it already is after construction.
  virtual void makeCurrent() = 0;
  virtual PixelSize framebufferSize() const = 0;
  /// Asks for another size. Memory obeys at once; a display may take some events, or refuse.
  virtual void resize(PixelSize size) = 0;
  /// Framebuffer pixels per unit that text is designed for: 1 in memory and on ordinary displays, 2 on HiDPI.
  virtual float contentScale() const { return 1; }

  /// Collects input without waiting.
  virtual void pollEvents() = 0;
  /// Collects input; sleeps until there is some, wake() was called (also before this call), or the time is over.
  /// \param seconds ≥ 0, finite
  virtual void waitEvents(double seconds) = 0;
  /// Ends waitEvents(), from any thread, while the window exists.
  virtual void wake() noexcept = 0;
  /// What happened since the last call, in order.
  std::vector<InputEvent> takeEvents();
  /// Files that were dropped onto the window since the last call.
  std::vector<std::filesystem::path> takeDroppedFiles();

  /// Something waits for takeEvents() or takeDroppedFiles().
  bool hasInput() const { return !events_.empty() || !droppedFiles_.empty(); }

  /// Input as if a person had made it: the way of scripts and tests.
  void post(const InputEvent& event);
  void postDrop(std::filesystem::path file);

  /// UTF-8; "" if it holds no text. Memory keeps its own.
  virtual std::string clipboard() const = 0;
  virtual void setClipboard(const std::string& text) = 0;

  /// Shows the picture, 1:1 from its top left, when OpenGL has drawn it. In memory there is nobody to see it.
  virtual void present(const GlFramebuffer& picture) = 0;
  /// How long the last present() waited for the display after that.
  virtual double swapSeconds() const { return 0; }

  /// The person asked to close it, or requestClose() did.
  virtual bool shouldClose() const = 0;
  virtual void requestClose() = 0;
  virtual void setTitle(const std::string& title) = 0;

 protected:
  Window() = default;

 private:
  std::vector<InputEvent> events_;
  std::vector<std::filesystem::path> droppedFiles_;
};

/// \throws GlError if this kind cannot be had here, with the reason and what to do.
/// At most one GLFW window at a time, and no other kind while an OSMesa window lives.
std::unique_ptr<Window> openWindow(WindowKind kind, const WindowSettings& settings);

struct OpenedWindow {
  std::unique_ptr<Window> window;
  std::string notice;  ///< "" for a display; else one line for the person: why there is none and what is used instead
};

/// The display, else EGL, else OSMesa.
/// \throws GlError with the three reasons if none works.
OpenedWindow openAnyWindow(const WindowSettings& settings);

}  // namespace cellcut
