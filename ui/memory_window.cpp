#include "ui/memory_window.h"

#include <chrono>

#include <epoxy/gl.h>

namespace cellcut {

void MemoryWindow::present(const GlFramebuffer& /*picture*/) {
  glFinish();
}

void MemoryWindow::waitEvents(double seconds) {
  if (hasInput()) return;
  std::unique_lock lock(mutex_);
  wakened_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return awake_; });
  awake_ = false;
}

void MemoryWindow::wake() noexcept {
  {
    const std::lock_guard lock(mutex_);
    awake_ = true;
  }
  wakened_.notify_one();
}

}  // namespace cellcut
