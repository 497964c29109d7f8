#include "ui/window.h"

#include "tests/ui/canvas.h"
#include "ui/gl_error.h"
#include "ui/gl_program.h"

#include <chrono>
#include <cstdlib>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

/// Asked by the leak sanitizer: OSMesa 22.3 forgets half a kilobyte in OSMesaMakeCurrent, once per process.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa.so\n";
}  // NOLINT

namespace cellcut {
namespace {

using test::Canvas;
using test::Rgba8;
using testing::HasSubstr;

/// Takes the display away from this process.
void hideDisplay() {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
}

double secondsToWait(Window& window, double seconds) {
  const auto start = std::chrono::steady_clock::now();
  window.waitEvents(seconds);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(Window, ADisplayThatIsNotThereIsSaidAndReplacedByMemory) {
  hideDisplay();
  try {
    openWindow(WindowKind::kGlfw, {});
    FAIL() << "a window without a display";
  } catch (const GlError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no window on a display"));
  }
  const OpenedWindow opened = openAnyWindow({.size = {40, 30}});
  EXPECT_NE(opened.window->kind(), WindowKind::kGlfw);
  EXPECT_THAT(opened.notice, HasSubstr("no window on a display"));
  EXPECT_THAT(opened.notice, HasSubstr("drawing into memory"));
  EXPECT_EQ(opened.notice.find('\n'), std::string::npos);
}

TEST(Window, WhatIsClearedIsReadBack) {
  Canvas canvas({7, 5});
  canvas.framebuffer.clear(Vec4(1, 0.2f, 0, 0));
  const ImageRgba8 picture = canvas.framebuffer.read();
  ASSERT_EQ(picture.width(), 7);
  ASSERT_EQ(picture.height(), 5);
  for (const Rgba8& pixel : picture) EXPECT_EQ(pixel, Rgba8(255, 51, 0, 255));
}

TEST(Window, TakesAndKeepsInputInOrder) {
  const auto window = openWindow(WindowKind::kEgl, {});
  window->post(MouseMove{Vec2(3, 4)});
  window->post(KeyChange{Key::kF1, true});
  window->postDrop("scene.glb");
  EXPECT_EQ(window->takeEvents(), (std::vector<InputEvent>{MouseMove{Vec2(3, 4)}, KeyChange{Key::kF1, true}}));
  EXPECT_TRUE(window->takeEvents().empty());
  EXPECT_EQ(window->takeDroppedFiles(), std::vector<std::filesystem::path>{"scene.glb"});
  EXPECT_TRUE(window->takeDroppedFiles().empty());
}

TEST(Window, SleepsUntilItIsWokenOrHasInput) {
  const auto window = openWindow(WindowKind::kEgl, {});
  constexpr double kLong = 60;  // far more than a slow machine needs to wake a thread
  EXPECT_GE(secondsToWait(*window, 0.02), 0.02);

  std::thread worker([&window] { window->wake(); });
  EXPECT_LT(secondsToWait(*window, kLong), kLong);
  worker.join();

  window->wake();  // before the wait: not lost
  EXPECT_LT(secondsToWait(*window, kLong), kLong);
  EXPECT_GE(secondsToWait(*window, 0.02), 0.02) << "one wake-up is good for one wait";

  window->post(KeyChange{Key::kA, true});
  EXPECT_LT(secondsToWait(*window, kLong), kLong);
}

TEST(Window, ClosesWhenAsked) {
  const auto window = openWindow(WindowKind::kEgl, {});
  EXPECT_FALSE(window->shouldClose());
  window->requestClose();
  EXPECT_TRUE(window->shouldClose());
}

TEST(Window, StartsAndStopsAHundredTimes) {
  for (int i = 0; i < 100; ++i) {
    const PixelSize size{1 + i % 9, 2};
    Canvas canvas(size);
    ImageView view;
    view.setImage(ImageSlot::kA, ImageRgb(size.width, size.height, Vec3(0, 1, 0)));
    const ImageRgba8 picture = canvas.draw(view, {}, {.toneMap = false});
    ASSERT_EQ(picture.at(size.width - 1, 1), Rgba8(0, 255, 0, 255)) << "start " << i;
  }
}

TEST(Window, TwoWindowsKeepTheirOwn) {
  Canvas first({2, 2});
  first.framebuffer.clear(Vec4(1, 0, 0, 1));
  {
    Canvas second({2, 2});
    second.framebuffer.clear(Vec4(0, 0, 1, 1));
    first.window->makeCurrent();
    EXPECT_EQ(first.framebuffer.read().at(0, 0), Rgba8(255, 0, 0, 255));
    second.window->makeCurrent();
    EXPECT_EQ(second.framebuffer.read().at(0, 0), Rgba8(0, 0, 255, 255));
  }
  first.window->makeCurrent();
  EXPECT_EQ(first.framebuffer.read().at(1, 1), Rgba8(255, 0, 0, 255));
}

TEST(Window, ResizesFromOnePixelTo4K) {
  Canvas canvas({64, 64});
  ImageView view;
  view.setImage(ImageSlot::kA, ImageRgb(1, 1, Vec3(1)));
  for (const PixelSize size : {PixelSize{1, 1}, PixelSize{3840, 2160}, PixelSize{2, 999}}) {
    canvas.window->resize(size);
    ASSERT_EQ(canvas.window->framebufferSize(), size);
    canvas.framebuffer = GlFramebuffer(size);
    const ImagePlacement placement = fitImage(view.imageSize(), {Vec2(0), Vec2(size.width, size.height)});
    const ImageRgba8 picture = canvas.draw(view, placement, {.toneMap = false});
    EXPECT_EQ(picture.at(size.width / 2, size.height / 2), Rgba8(255));
  }
}

TEST(Window, OsmesaDrawsTheSame) {
  ImageRgb image(2, 2);
  image.at(0, 0) = Vec3(1, 0, 0);
  image.at(1, 0) = Vec3(0, 1, 0);
  image.at(0, 1) = Vec3(0, 0, 1);
  const auto drawn = [&image](WindowKind kind) {
    Canvas canvas({6, 4}, kind);
    ImageView view;
    view.setImage(ImageSlot::kA, image);
    return canvas.draw(view, {Vec2(1, 0), 2}, {.toneMap = false});
  };
  const ImageRgba8 byEgl = drawn(WindowKind::kEgl);
  std::optional<ImageRgba8> byOsmesa;
  try {
    byOsmesa = drawn(WindowKind::kOsmesa);
  } catch (const GlError& error) {
    ASSERT_THAT(error.what(), HasSubstr("libosmesa6"));
    GTEST_SKIP() << error.what();
  }
  EXPECT_TRUE(std::ranges::equal(byEgl, *byOsmesa));
  EXPECT_TRUE(std::ranges::equal(byEgl, drawn(WindowKind::kEgl))) << "epoxy's functions came back";
}

TEST(GlProgram, SaysWhatTheCompilerSays) {
  Canvas canvas({1, 1});
  const char* const vertex = "#version 330 core\nvoid main() { gl_Position = vec4(0); }\n";
  try {
    GlProgram::fromText("broken.frag", vertex, "#version 330 core\nout vec4 c;\nvoid main() { c = nonsense; }\n");
    FAIL() << "compiled";
  } catch (const GlError& error) {
    EXPECT_THAT(error.what(), HasSubstr("broken.frag"));
    EXPECT_THAT(error.what(), HasSubstr("nonsense"));
  }
  try {
    GlProgram::fromText("apart", "#version 330 core\nout vec2 both;\nvoid main() { gl_Position = vec4(both, 0, 1); }\n",
                        "#version 330 core\nin vec3 both;\nout vec4 c;\nvoid main() { c = vec4(both, 1); }\n");
    FAIL() << "linked";
  } catch (const GlError& error) {
    EXPECT_THAT(error.what(), HasSubstr("both"));
  }
}

TEST(GlTexture, LargerThanTheDriverTakesIsSaid) {
  Canvas canvas({1, 1});
  GlTexture texture;
  EXPECT_THROW(texture.allocate({1 << 20, 1}), GlError);
  EXPECT_NO_THROW(checkGl("afterwards"));
}

}  // namespace
}  // namespace cellcut
