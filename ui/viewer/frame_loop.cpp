#include "ui/viewer/frame_loop.h"

#include <algorithm>

namespace cellcut {
namespace {

/// Frames that nobody asked for take at most this share of the time: OpenGL by software needs the cores that render.
constexpr double kIdleShare = 0.06;

}  // namespace

void FrameLoop::step() {
  const double sleep = viewer_.sleepSeconds();
  window_.pollEvents();
  if (sleep > 0 && !window_.hasInput()) {
    window_.waitEvents(sleep);
    const double rest = frameSeconds_ * (1 / kIdleShare - 1);
    while (!window_.hasInput() && !window_.shouldClose() && !viewer_.hasNewsOfEdits() && sinceEnd_.seconds() < rest) {
      window_.waitEvents(std::min(sleep, rest - std::min(rest, sinceEnd_.seconds())));
    }
  }
  const double elapsed = sinceBegin_.seconds();
  sinceBegin_ = {};
  viewer_.frame(elapsed);
  sinceEnd_ = {};
  // Waiting for the display costs nobody anything.
  frameSeconds_ = sinceBegin_.seconds() - window_.swapSeconds();
}

}  // namespace cellcut
