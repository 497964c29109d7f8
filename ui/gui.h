/// \file gui.h
/// Dear ImGui on our windows: context, style, font, input, drawing. Between beginFrame and endFrame the owner calls
/// ImGui's functions as usual.
///
/// Sizes: framebuffer pixels; ImGui's units are the same. Threads: the window's.
#pragma once

#include "ui/input_event.h"
#include "ui/input_queue.h"
#include "ui/pixel_size.h"

#include <memory>
#include <span>

namespace cellcut {

class Window;

struct GuiSettings {
  float scale = 1;  ///< of text and spacing, --ui-scale times Window::contentScale(); [0.5, 4]
};

class Gui {
 public:
  /// The window lends its clipboard and must outlive this. No file is read or written but the font
  /// (fonts-dejavu-core; without it ImGui's own, scaled).
  /// \pre the window's context is current, here and in every other member
  Gui(Window& window, const GuiSettings& settings);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  /// \param seconds since the last frame; a fixed number makes the picture repeatable
  /// \param events  what is new. ImGui sees of it what one frame can tell apart; the rest waits for the next frames.
  void beginFrame(PixelSize size, double seconds, std::span<const InputEvent> events);
  /// Draws over what the bound framebuffer holds. Framebuffer binding and viewport (all of `size`) remain; blending,
  /// scissor, program, vertex array and texture bindings of unit 0 are left at OpenGL's defaults.
  void endFrame();
  /// Ends a frame without drawing, if one was begun: after a failure between panels.
  void abandonFrame();

  /// Events wait for the next frame, which should then come without sleeping.
  bool inputPending() const { return !queue_.empty(); }
  /// The pointer is over, or a drag began in, a window of ImGui: what the mouse does is not meant for the scene.
  bool wantsMouse() const;
  /// A text field or the like has the keyboard: what is typed is no short-cut.
  bool wantsKeyboard() const;

  // Keys as of the current frame, whoever wants them. \pre between beginFrame and endFrame
  bool keyDown(Key key) const;
  /// It went down in this frame; with `repeat` also at the rate of a held key.
  bool keyPressed(Key key, bool repeat = false) const;
  bool controlDown() const;
  bool shiftDown() const;

  float scale() const { return settings_.scale; }

 private:
  struct State;
  GuiSettings settings_;
  InputQueue queue_;
  bool inFrame_ = false;
  std::unique_ptr<State> state_;
};

}  // namespace cellcut
