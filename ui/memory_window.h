/// \file memory_window.h
/// What the windows without a display have in common: input by post() only, a clipboard of their own.
#pragma once

#include "ui/window.h"

#include <condition_variable>
#include <mutex>
#include <string>

namespace cellcut {

class MemoryWindow : public Window {
 public:
  PixelSize framebufferSize() const override { return size_; }
  void resize(PixelSize size) override { size_ = size; }
  void pollEvents() override {}
  void waitEvents(double seconds) override;
  void wake() noexcept override;
  std::string clipboard() const override { return clipboard_; }
  void setClipboard(const std::string& text) override { clipboard_ = text; }
  /// The picture stays where it is.
  void present(const GlFramebuffer& /*picture*/) override;
  bool shouldClose() const override { return shouldClose_; }
  void requestClose() override { shouldClose_ = true; }
  void setTitle(const std::string& /*title*/) override {}

 protected:
  explicit MemoryWindow(PixelSize size) : size_(size) {}

 private:
  PixelSize size_;
  std::string clipboard_;
  bool shouldClose_ = false;

  std::mutex mutex_;  // held for a moment only
  std::condition_variable wakened_;
  bool awake_ = false;  // guarded by mutex_
};

}  // namespace cellcut
