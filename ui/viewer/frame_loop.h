/// \file frame_loop.h
/// When the next frame of a viewer is drawn: at once for input, now and then for news of the rendering.
#pragma once

#include "ui/viewer/viewer.h"
#include "ui/window.h"

#include <chrono>

namespace cellcut {

class FrameLoop {
 public:
  /// Both outlive it.
  FrameLoop(Viewer& viewer, Window& window) : viewer_(viewer), window_(window) {}

  /// Waits for input, news, or the end of the viewer's sleep, and draws a frame.
  void step();
  /// That the last frame took.
  double frameSeconds() const { return frameSeconds_; }

 private:
  using Clock = std::chrono::steady_clock;

  Viewer& viewer_;
  Window& window_;
  Clock::time_point began_ = Clock::now(), ended_ = began_;
  double frameSeconds_ = 0;
};

}  // namespace cellcut
