/// \file frame_loop.h
/// When the next frame of a viewer is drawn: at once for input, now and then for news of the rendering.
#pragma once

#include "renderer/base/stopwatch.h"
#include "ui/viewer/viewer.h"
#include "ui/window.h"

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
  Viewer& viewer_;
  Window& window_;
  Stopwatch sinceBegin_, sinceEnd_;  ///< of the last frame
  double frameSeconds_ = 0;
};

}  // namespace cellcut
