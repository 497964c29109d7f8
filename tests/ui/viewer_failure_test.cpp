#include "renderer/scene/camera.h"
#include "tests/ui/viewer_fixture.h"
#include "ui/gl_error.h"
#include "ui/memory_window.h"
#include "ui/viewer/viewer.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcut::test {
namespace {

using testing::HasSubstr;

TEST_F(ViewerTest, AWindowWithoutAreaIsNoReasonToStop) {
  play("wait idle\n");
  window_->post(KeyChange{Key::kW, true});
  viewer_->frame(1.0 / 60);
  for (const PixelSize size : {PixelSize{0, 0}, PixelSize{300, 0}, PixelSize{0, 300}}) {
    window_->resize(size);
    viewer_->frame(1.0 / 60);
    EXPECT_GT(viewer_->sleepSeconds(), 0) << "nothing is drawn: it sleeps";
  }
  window_->post(KeyChange{Key::kW, false});
  viewer_->frame(1.0 / 60);
  window_->resize({400, 720});
  play("wait idle\n");
  const Camera there = *viewer_->state().settings.view;
  play("wait idle\n");
  EXPECT_TRUE(isSameView(*viewer_->state().settings.view, there)) << "the key that was released flies no farther";
  window_->resize({1, 1});
  play("wait idle\nsize 400 720\nwait idle\n");
  EXPECT_EQ(viewer_->problem(), "");
}

/// A window whose context is lost for some frames.
class FlakyWindow final : public MemoryWindow {
 public:
  explicit FlakyWindow(PixelSize size) : MemoryWindow(size), inner_(openWindow(WindowKind::kEgl, {.size = size})) {}
  WindowKind kind() const override { return inner_->kind(); }
  void makeCurrent() override {
    if (lost) throw GlError("the context is lost");
    inner_->makeCurrent();
  }
  bool lost = false;

 private:
  std::unique_ptr<Window> inner_;
};

TEST_F(ViewerTest, AContextThatFailsIsWaitedForAndThenGivenUp) {
  viewer_.reset();
  auto flaky = std::make_unique<FlakyWindow>(PixelSize{400, 720});
  FlakyWindow& window = *flaky;
  window_ = std::move(flaky);
  open({});
  play("wait idle\n");
  window.lost = true;
  for (int i = 0; i < 5; ++i) viewer_->frame(1.0 / 60);
  EXPECT_THAT(viewer_->problem(), HasSubstr("lost"));
  window.lost = false;
  play("click Dismiss\nwait idle\nset Strategy power\nwait idle\n");
  EXPECT_EQ(viewer_->problem(), "");
  // A framebuffer that no driver has.
  window.resize({100'000, 100'000});
  viewer_->frame(1.0 / 60);
  EXPECT_NE(viewer_->problem(), "");
  window.resize({400, 720});
  play("click Dismiss\nwait idle\n");
  window.lost = true;
  const auto forEver = [this] {
    for (int i = 0; i < 1000; ++i) viewer_->frame(1.0 / 60);
  };
  EXPECT_THROW(forEver(), GlError);
  window.lost = false;  // for what the viewer gives back
  window.makeCurrent();
}

/// A window that holds every thread that wakes it: nothing beside the UI gets on, as if a scene were being built.
class HoldingWindow final : public MemoryWindow {
 public:
  explicit HoldingWindow(PixelSize size) : MemoryWindow(size), inner_(openWindow(WindowKind::kEgl, {.size = size})) {}
  WindowKind kind() const override { return inner_->kind(); }
  void makeCurrent() override {
    inner_->makeCurrent();
    const std::lock_guard lock(mutex_);
    lastFrame_ = Clock::now();
  }
  void wake() noexcept override {
    std::unique_lock lock(mutex_);
    ++held_;
    // A UI that draws no frame waits for us: it is let go on, and found out.
    while (!free_ && !stuck_) {
      released_.wait_until(lock, lastFrame_ + kPatience);
      stuck_ = !free_ && Clock::now() >= lastFrame_ + kPatience;
    }
    --held_;
    lock.unlock();
    MemoryWindow::wake();
  }
  void release() {
    const std::lock_guard lock(mutex_);
    free_ = true;
    released_.notify_all();
  }
  int held() const {
    const std::lock_guard lock(mutex_);
    return held_;
  }
  /// Whether the UI has drawn nothing for two minutes while threads were held.
  bool stuck() const {
    const std::lock_guard lock(mutex_);
    return stuck_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::minutes kPatience{2};  ///< of any frame, on a busy machine
  std::unique_ptr<Window> inner_;
  mutable std::mutex mutex_;
  std::condition_variable released_;
  Clock::time_point lastFrame_ = Clock::now();
  int held_ = 0;
  bool free_ = false, stuck_ = false;
};

TEST_F(ViewerTest, SessionsThatEndAreNotWaitedFor) {
  viewer_.reset();
  auto holding = std::make_unique<HoldingWindow>(PixelSize{400, 720});
  HoldingWindow& window = *holding;
  window_ = std::move(holding);
  open({});
  const auto untilHeld = [&](int sessions) {
    while (window.held() < sessions && !window.stuck()) {
      viewer_->frame(1.0 / 60);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  };
  untilHeld(1);
  viewer_->state().duel = true;
  untilHeld(2);
  window.post(KeyChange{Key::kJ, true});
  window.post(KeyChange{Key::kJ, false});
  untilHeld(3);
  // The picture, the duel and the reference stand still. All of them are edited and ended, again and again.
  for (int i = 0; i < 3; ++i) {
    viewer_->state().duel = false;
    viewer_->state().settings.strategy = Strategy::kPower;
    viewer_->frame(1.0 / 60);
    viewer_->state().duel = true;
    viewer_->state().opponent = Strategy::kUniform;
    window.post(KeyChange{Key::kJ, true});
    window.post(KeyChange{Key::kJ, false});
    for (int frame = 0; frame < 5; ++frame) viewer_->frame(1.0 / 60);
  }
  viewer_->state().duel = false;
  viewer_->frame(1.0 / 60);
  EXPECT_FALSE(window.stuck());
  window.release();
  play("wait idle\n");
  EXPECT_EQ(viewer_->problem(), "");
  EXPECT_TRUE(viewer_->session().snapshot()->sampler.grid == std::nullopt);
}

}  // namespace
}  // namespace cellcut::test
