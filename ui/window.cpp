#include "ui/window.h"

#include "ui/gl_error.h"
#include "ui/window_kinds.h"

#include <utility>

namespace cellcut {

std::string_view nameOf(WindowKind kind) {
  switch (kind) {
    case WindowKind::kGlfw:
      return "glfw";
    case WindowKind::kEgl:
      return "egl";
    case WindowKind::kOsmesa:
      return "osmesa";
  }
  return {};
}

std::vector<InputEvent> Window::takeEvents() {
  return std::exchange(events_, {});
}
std::vector<std::filesystem::path> Window::takeDroppedFiles() {
  return std::exchange(droppedFiles_, {});
}
void Window::post(const InputEvent& event) {
  events_.push_back(event);
}
void Window::postDrop(std::filesystem::path file) {
  droppedFiles_.push_back(std::move(file));
}

std::unique_ptr<Window> openWindow(WindowKind kind, const WindowSettings& settings) {
  switch (kind) {
    case WindowKind::kGlfw:
      return openGlfwWindow(settings);
    case WindowKind::kEgl:
      return openEglWindow(settings);
    case WindowKind::kOsmesa:
      return openOsmesaWindow(settings);
  }
  return nullptr;
}

OpenedWindow openAnyWindow(const WindowSettings& settings) {
  std::string reasons;
  for (const WindowKind kind : {WindowKind::kGlfw, WindowKind::kEgl, WindowKind::kOsmesa}) {
    try {
      OpenedWindow opened{openWindow(kind, settings), {}};
      if (!reasons.empty()) opened.notice = reasons + "; drawing into memory by " + std::string(nameOf(kind));
      return opened;
    } catch (const GlError& error) {
      if (!reasons.empty()) reasons += "; ";
      reasons += error.what();
    }
  }
  throw GlError(reasons);
}

}  // namespace cellcut
