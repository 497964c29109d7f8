#include "ui/gui.h"

#include "tests/ui/canvas.h"

#include <array>
#include <functional>

#include <gtest/gtest.h>
#include <imgui.h>

namespace cellcut {
namespace {

using test::Canvas;
using test::Rgba8;

constexpr double kFrameSeconds = 1.0 / 60;

/// A window of ImGui's at a known place, drawn frame by frame.
class GuiTest : public testing::Test {
 protected:
  /// One frame with what is posted; `body` fills the window.
  void frame(const std::function<void()>& body) {
    gui.beginFrame(canvas.framebuffer.size(), kFrameSeconds, canvas.window->takeEvents());
    ImGui::SetNextWindowPos(ImVec2(20, 20));
    ImGui::SetNextWindowSize(ImVec2(200, 120));
    ImGui::Begin("Window");
    body();
    ImGui::End();
    canvas.framebuffer.clear(Vec4(0, 0, 0, 1));
    gui.endFrame();
  }
  void framesUntilAllIsSeen(const std::function<void()>& body) {
    do frame(body);
    while (gui.inputPending());
  }
  void post(std::initializer_list<InputEvent> events) {
    for (const InputEvent& event : events) canvas.window->post(event);
  }
  /// Where the last widget is, its middle.
  static Vec2 middleOfItem() {
    const ImVec2 lower = ImGui::GetItemRectMin();
    const ImVec2 upper = ImGui::GetItemRectMax();
    return {(lower.x + upper.x) / 2, (lower.y + upper.y) / 2};
  }

  Canvas canvas{{320, 240}};
  Gui gui{*canvas.window, {}};
};

TEST_F(GuiTest, DrawsItsWindowWhereItIsAndNothingElse) {
  frame([] { ImGui::TextUnformatted("text"); });
  const ImageRgba8 picture = canvas.framebuffer.read();
  EXPECT_EQ(picture.at(10, 10), Rgba8(0, 0, 0, 255));
  EXPECT_EQ(picture.at(230, 150), Rgba8(0, 0, 0, 255));
  EXPECT_NE(picture.at(100, 120), Rgba8(0, 0, 0, 255));
  EXPECT_NE(picture.at(100, 25), Rgba8(0, 0, 0, 255));
  EXPECT_NE(picture.at(100, 25), picture.at(100, 120)) << "the title is at the top";
}

TEST_F(GuiTest, CutsItsTextAtTheWindowsEdge) {
  frame([] {});
  frame([] {
    for (int i = 0; i < 20; ++i)
      ImGui::TextUnformatted("MMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMM");
  });
  const ImageRgba8 picture = canvas.framebuffer.read();
  int brightInside = 0;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      const bool inside = x >= 20 && x < 220 && y >= 20 && y < 140;
      EXPECT_TRUE(inside || picture.at(x, y) == Rgba8(0, 0, 0, 255)) << x << ' ' << y;
      if (inside && y > 45) brightInside += picture.at(x, y).r > 150 ? 1 : 0;
    }
  EXPECT_GT(brightInside, 500);  // most of five lines of text
}

TEST_F(GuiTest, AButtonIsClickedOnceByAClickWithinOneFrame) {
  int clicks = 0;
  Vec2 button(0);
  const auto body = [&] {
    clicks += ImGui::Button("Button") ? 1 : 0;
    button = middleOfItem();
  };
  frame(body);
  frame(body);  // ImGui 1.90 passes over a click in the frame after a window's first
  post({MouseMove{button}, MouseButtonChange{MouseButton::kLeft, true}, MouseButtonChange{MouseButton::kLeft, false}});
  framesUntilAllIsSeen(body);
  EXPECT_EQ(clicks, 1);
  EXPECT_TRUE(gui.wantsMouse());

  post({MouseMove{Vec2(300, 230)}, MouseButtonChange{MouseButton::kLeft, true},
        MouseButtonChange{MouseButton::kLeft, false}});
  framesUntilAllIsSeen(body);
  frame(body);
  EXPECT_EQ(clicks, 1) << "beside the window";
  EXPECT_FALSE(gui.wantsMouse());
}

TEST_F(GuiTest, AKeyPressedAndReleasedWithinOneFrameIsSeenOnce) {
  int presses = 0;
  int others = 0;
  const auto body = [&] {
    presses += gui.keyPressed(Key::kF2) ? 1 : 0;
    others += gui.keyPressed(Key::kF3) || gui.keyDown(Key::kF3) ? 1 : 0;
  };
  post({KeyChange{Key::kF2, true}, KeyChange{Key::kF2, false}});
  framesUntilAllIsSeen(body);
  EXPECT_EQ(presses, 1);
  EXPECT_EQ(others, 0);
  frame([&] { EXPECT_FALSE(gui.keyDown(Key::kF2)); });
}

TEST_F(GuiTest, EveryKeyIsItself) {
  for (int i = 0; i < kKeyCount; ++i) {
    const auto key = static_cast<Key>(i);
    post({KeyChange{key, true}});
    frame([&] {
      for (int j = 0; j < kKeyCount; ++j)
        EXPECT_EQ(gui.keyDown(static_cast<Key>(j)), i == j) << keyName(key) << ' ' << keyName(static_cast<Key>(j));
    });
    post({KeyChange{key, false}});
    frame([&] { EXPECT_FALSE(gui.keyDown(key)); });
  }
}

TEST_F(GuiTest, AHeldKeyStaysDownUntilTheFocusIsLost) {
  post({KeyChange{Key::kLeftShift, true}, KeyChange{Key::kW, true}});
  for (int i = 0; i < 3; ++i)
    frame([&] {
      EXPECT_TRUE(gui.keyDown(Key::kW));
      EXPECT_TRUE(gui.shiftDown());
      EXPECT_EQ(gui.keyPressed(Key::kW), i == 0);
    });
  post({FocusChange{false}});
  frame([&] {
    EXPECT_FALSE(gui.keyDown(Key::kW));
    EXPECT_FALSE(gui.shiftDown());
  });
}

TEST_F(GuiTest, ATextFieldIsTypedIntoAndKeepsTheKeyboard) {
  std::array<char, 64> text{};
  Vec2 field(0);
  const auto body = [&] {
    ImGui::InputText("##field", text.data(), text.size());
    field = middleOfItem();
  };
  frame(body);
  EXPECT_FALSE(gui.wantsKeyboard());
  post({MouseMove{field}, MouseButtonChange{MouseButton::kLeft, true}, MouseButtonChange{MouseButton::kLeft, false},
        TextInput{U'a'}, TextInput{U'b'}, KeyChange{Key::kBackspace, true}, KeyChange{Key::kBackspace, false},
        TextInput{U'\u03bb'}});
  framesUntilAllIsSeen(body);
  frame(body);
  EXPECT_STREQ(text.data(), "a\u03bb");
  EXPECT_TRUE(gui.wantsKeyboard());
}

TEST_F(GuiTest, CopiesAndPastesThroughTheWindowsClipboard) {
  std::array<char, 64> text{"copied"};
  Vec2 field(0);
  const auto body = [&] {
    ImGui::InputText("##field", text.data(), text.size());
    field = middleOfItem();
  };
  const auto shortcut = [&](Key key) {
    post({KeyChange{Key::kLeftControl, true}, KeyChange{key, true}, KeyChange{key, false},
          KeyChange{Key::kLeftControl, false}});
    framesUntilAllIsSeen(body);
  };
  frame(body);
  post({MouseMove{field}, MouseButtonChange{MouseButton::kLeft, true}, MouseButtonChange{MouseButton::kLeft, false}});
  framesUntilAllIsSeen(body);
  shortcut(Key::kA);
  shortcut(Key::kC);
  EXPECT_EQ(canvas.window->clipboard(), "copied");
  canvas.window->setClipboard("pasted");
  shortcut(Key::kA);
  shortcut(Key::kV);
  EXPECT_STREQ(text.data(), "pasted");
}

TEST_F(GuiTest, TheWheelTurns) {
  float turned = 0;
  post({Scroll{Vec2(0, 1)}, Scroll{Vec2(0, 2)}});
  for (int i = 0; i < 3; ++i) frame([&] { turned += ImGui::GetIO().MouseWheel; });
  EXPECT_EQ(turned, 3);
}

TEST_F(GuiTest, ADragMayLeaveTheWindow) {
  post({MouseMove{Vec2(5, 5)}, MouseButtonChange{MouseButton::kLeft, true}});
  framesUntilAllIsSeen([] {});
  post({MouseLeave{}});
  frame([] { EXPECT_EQ(ImGui::GetIO().MousePos.x, 5); });
  post({MouseButtonChange{MouseButton::kLeft, false}, MouseLeave{}});
  framesUntilAllIsSeen([] {});
  frame([] { EXPECT_FALSE(ImGui::IsMousePosValid()); });
}

TEST_F(GuiTest, TheSameFrameIsTheSamePicture) {
  const auto body = [] { ImGui::TextUnformatted("0.123 \u2264 \u03bb"); };
  frame(body);
  frame(body);  // ImGui lays a new window out in its first frame
  const ImageRgba8 first = canvas.framebuffer.read();
  frame(body);
  EXPECT_TRUE(std::ranges::equal(first, canvas.framebuffer.read()));
}

TEST(Gui, ScalesItsText) {
  Canvas canvas({100, 100});
  const auto height = [&canvas](float scale) {
    Gui gui(*canvas.window, {.scale = scale});
    gui.beginFrame({100, 100}, kFrameSeconds, {});
    const float text = ImGui::GetTextLineHeight();
    gui.endFrame();
    return text;
  };
  const float plain = height(1);
  EXPECT_GE(plain, 13);
  EXPECT_NEAR(height(2), 2 * plain, 1);  // whole pixels
}

TEST(Gui, AnEmptyFramebufferIsNoError) {
  Canvas canvas({10, 10});
  Gui gui(*canvas.window, {});
  gui.beginFrame({0, 0}, 0, {});
  gui.endFrame();
  gui.beginFrame({10, 10}, kFrameSeconds, {});
  gui.endFrame();
}

TEST(Gui, ShowsATextureOfOurs) {
  Canvas canvas({60, 60});
  ImageRgba8 image(2, 1);
  image[0] = Rgba8(255, 0, 0, 255);
  image[1] = Rgba8(0, 0, 255, 255);
  GlTexture texture;
  texture.upload(image);
  Gui gui(*canvas.window, {});
  gui.beginFrame({60, 60}, kFrameSeconds, {});
  const auto id = (ImTextureID) static_cast<std::intptr_t>(texture.name());  // NOLINT: a pointer in ImGui's eyes
  ImGui::GetForegroundDrawList()->AddImage(id, ImVec2(10, 10), ImVec2(50, 30));
  canvas.framebuffer.clear(Vec4(0, 0, 0, 1));
  gui.endFrame();
  const ImageRgba8 picture = canvas.framebuffer.read();
  EXPECT_EQ(picture.at(12, 12), image[0]);
  EXPECT_EQ(picture.at(48, 28), image[1]);
  EXPECT_EQ(picture.at(12, 32), Rgba8(0, 0, 0, 255));
}

}  // namespace
}  // namespace cellcut
