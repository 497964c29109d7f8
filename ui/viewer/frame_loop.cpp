#include "ui/viewer/frame_loop.h"

#include <algorithm>

namespace cellcut {
namespace {

/// Frames that nobody asked for take at most this share of the time: OpenGL by software needs the cores that render.
constexpr double kIdleShare = 0.06;

}  // namespace

void FrameLoop::step() {
  const auto secondsSince = [](Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); };
  const double sleep = viewer_.sleepSeconds();
  window_.pollEvents();
  if (sleep > 0 && !window_.hasInput()) {
    window_.waitEvents(sleep);
    const double rest = frameSeconds_ * (1 / kIdleShare - 1);
    while (!window_.hasInput() && !window_.shouldClose() && !viewer_.hasNewsOfEdits() && secondsSince(ended_) < rest) {
      window_.waitEvents(std::min(sleep, rest - std::min(rest, secondsSince(ended_))));
    }
  }
  const double elapsed = secondsSince(began_);
  began_ = Clock::now();
  viewer_.frame(elapsed);
  ended_ = Clock::now();
  // Waiting for the display costs nobody anything.
  frameSeconds_ = std::chrono::duration<double>(ended_ - began_).count() - window_.swapSeconds();
}

}  // namespace cellcut
