#include "renderer/base/stopwatch.h"
#include "ui/gl_error.h"
#include "ui/gl_framebuffer.h"
#include "ui/glfw_keys.h"
#include "ui/window_kinds.h"

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace cellcut {

namespace {

/// GLFW's own words for its last failure.
std::string glfwReason() {
  const char* description = nullptr;
  glfwGetError(&description);
  return description != nullptr ? description : "no reason given";
}

class GlfwLibrary {
 public:
  GlfwLibrary() {
    if (glfwInit() != GLFW_TRUE) throw GlError("no window on a display: " + glfwReason());
  }
  ~GlfwLibrary() { glfwTerminate(); }
  GlfwLibrary(const GlfwLibrary&) = delete;
  GlfwLibrary& operator=(const GlfwLibrary&) = delete;
};

class GlfwWindow final : public Window {
 public:
  explicit GlfwWindow(const WindowSettings& settings) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);  // it is only copied to
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    window_ = glfwCreateWindow(settings.size.width, settings.size.height, settings.title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) throw GlError("no window with OpenGL 3.3 on this display: " + glfwReason());
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    glfwSetWindowUserPointer(window_, this);
    listen();
    if (framebufferSize() != settings.size) resize(settings.size);
  }
  ~GlfwWindow() override { glfwDestroyWindow(window_); }

  WindowKind kind() const override { return WindowKind::kGlfw; }
  void makeCurrent() override { glfwMakeContextCurrent(window_); }

  PixelSize framebufferSize() const override {
    PixelSize size;
    glfwGetFramebufferSize(window_, &size.width, &size.height);
    return size;
  }

  void resize(PixelSize size) override {
    const Vec2 ratio = pixelsPerUnit();
    glfwSetWindowSize(window_, static_cast<int>(std::lround(static_cast<float>(size.width) / ratio.x)),
                      static_cast<int>(std::lround(static_cast<float>(size.height) / ratio.y)));
  }

  float contentScale() const override {
    Vec2 scale{1};
    glfwGetWindowContentScale(window_, &scale.x, &scale.y);
    return std::max(1.0f, scale.x);
  }

  void pollEvents() override { glfwPollEvents(); }

  void waitEvents(double seconds) override {
    if (hasInput()) {
      glfwPollEvents();
    } else {
      glfwWaitEventsTimeout(seconds);
    }
  }

  void wake() noexcept override { glfwPostEmptyEvent(); }

  std::string clipboard() const override {
    const char* const text = glfwGetClipboardString(window_);
    return text != nullptr ? text : "";
  }
  void setClipboard(const std::string& text) override { glfwSetClipboardString(window_, text.c_str()); }

  void present(const GlFramebuffer& picture) override {
    const PixelSize from = picture.size();
    const PixelSize to = framebufferSize();
    const int width = std::min(from.width, to.width);
    const int height = std::min(from.height, to.height);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, picture.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    // Rows count from below: the tops are laid together. While a window grows the rest stays black for a frame.
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glBlitFramebuffer(0, from.height - height, width, from.height, 0, to.height - height, width, to.height,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
    checkGl("showing the picture");
    glFinish();
    const Stopwatch drawn;
    glfwSwapBuffers(window_);
    swapSeconds_ = drawn.seconds();
  }
  double swapSeconds() const override { return swapSeconds_; }

  bool shouldClose() const override { return glfwWindowShouldClose(window_) == GLFW_TRUE; }
  void requestClose() override { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
  void setTitle(const std::string& title) override { glfwSetWindowTitle(window_, title.c_str()); }

 private:
  static GlfwWindow& of(GLFWwindow* window) { return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window)); }

  /// GLFW counts windows and pointers in units that are larger than a pixel on some systems.
  Vec2 pixelsPerUnit() const {
    const PixelSize pixels = framebufferSize();
    PixelSize units;
    glfwGetWindowSize(window_, &units.width, &units.height);
    if (pixels.empty() || units.empty()) return Vec2(1);
    return Vec2(pixels.width, pixels.height) / Vec2(units.width, units.height);
  }

  void listen() {
    glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
      of(window).post(MouseMove{Vec2(x, y) * of(window).pixelsPerUnit()});
    });
    glfwSetCursorEnterCallback(window_, [](GLFWwindow* window, int entered) {
      if (entered == GLFW_FALSE) of(window).post(MouseLeave{});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int /*modifiers*/) {
      if (const auto known = buttonFromGlfw(button)) of(window).post(MouseButtonChange{*known, action == GLFW_PRESS});
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double x, double y) { of(window).post(Scroll{Vec2(x, y)}); });
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int /*scancode*/, int action, int /*modifiers*/) {
      if (action == GLFW_REPEAT) return;
      if (const auto known = keyFromGlfw(key)) of(window).post(KeyChange{*known, action == GLFW_PRESS});
    });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned character) {
      of(window).post(TextInput{static_cast<char32_t>(character)});
    });
    glfwSetWindowFocusCallback(
        window_, [](GLFWwindow* window, int focused) { of(window).post(FocusChange{focused == GLFW_TRUE}); });
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** files) {
      for (int i = 0; i < count; ++i) of(window).postDrop(files[i]);
    });
  }

  GlfwLibrary library_;
  double swapSeconds_ = 0;
  GLFWwindow* window_ = nullptr;
};

}  // namespace

std::unique_ptr<Window> openGlfwWindow(const WindowSettings& settings) {
  return std::make_unique<GlfwWindow>(settings);
}

}  // namespace cellcut
