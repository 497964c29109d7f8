// The real window with a picture, a button and a text field, for tests/ui/xvfb_test.sh. Prints one line for whatever
// happens; Escape or the window's own button closes it.
//   window_program [PICTURE.png]    also writes what it showed last
//   CELLCUT_UI_SCALE=2 …            scales the user interface

#include "renderer/base/image_io.h"
#include "ui/gl_error.h"
#include "ui/gl_framebuffer.h"
#include "ui/gui.h"
#include "ui/image_view.h"
#include "ui/window.h"

#include <array>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>

#include <imgui.h>

namespace {

using namespace cellcut;

/// A colour chart: hue to the right, brightness downwards over 16 stops.
ImageRgb chart() {
  ImageRgb image(320, 200);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const float hue = 6 * static_cast<float>(x) / 320;
      const auto channel = [hue](float at) {
        return std::clamp(2 - std::min(std::abs(hue - at), 6 - std::abs(hue - at)), 0.05f, 1.0f);
      };
      image.at(x, y) = std::exp2(8 - 16 * static_cast<float>(y) / 200) * Vec3(channel(0), channel(2), channel(4));
    }
  return image;
}

struct Seen {
  int clicks = 0;
  int keys = 0;
  int wheel = 0;
  bool toneMap = true;
  std::array<char, 64> text{};
};

void say(const std::string& line) {
  std::cout << line << std::endl;
}

/// Draws the panel and says what a person did to it.
void panel(Gui& gui, Seen& seen) {
  ImGui::SetNextWindowPos(ImVec2(10, 10));
  ImGui::Begin("Panel", nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove);
  const std::string before = seen.text.data();
  const auto report = [](const char* name) {
    const ImVec2 lower = ImGui::GetItemRectMin();
    const ImVec2 upper = ImGui::GetItemRectMax();
    return std::string(name) + ' ' + std::to_string(static_cast<int>((lower.x + upper.x) / 2)) + ' ' +
           std::to_string(static_cast<int>((lower.y + upper.y) / 2));
  };
  if (ImGui::Button("Press")) say("clicked " + std::to_string(++seen.clicks));
  const std::string button = report("button");
  ImGui::InputText("text \u2264 \u03bb", seen.text.data(), seen.text.size());
  if (before != seen.text.data()) say("text " + std::string(seen.text.data()));
  const std::string field = report("field");
  ImGui::Checkbox("tone map", &seen.toneMap);
  ImGui::Text("0.1234 %6d clicks", seen.clicks);
  ImGui::End();
  if (ImGui::GetFrameCount() == 3) say(button + '\n' + field + "\nready");
  if (gui.keyPressed(Key::kF2)) say("F2 " + std::to_string(++seen.keys));
  if (ImGui::GetIO().MouseWheel != 0) say("wheel " + std::to_string(++seen.wheel));
}

int run(const std::optional<std::string>& pictureFile) {
  OpenedWindow opened = openAnyWindow({.size = {640, 400}, .title = "cellcut test"});
  Window& window = *opened.window;
  say("window " + std::string(nameOf(window.kind())) + (opened.notice.empty() ? "" : ": " + opened.notice));
  const char* const scale = std::getenv("CELLCUT_UI_SCALE");
  Gui gui(window, {.scale = scale != nullptr ? std::strtof(scale, nullptr) : 1});
  ImageView view;
  view.setImage(ImageSlot::kA, chart());
  std::optional<GlFramebuffer> framebuffer;
  Seen seen;
  for (int frame = 0; !window.shouldClose(); ++frame) {
    if (frame < 4 || gui.inputPending()) {
      window.pollEvents();
    } else {
      window.waitEvents(0.1);
    }
    const PixelSize size = window.framebufferSize();
    if (size.empty()) continue;
    if (!framebuffer || framebuffer->size() != size) {
      framebuffer.emplace(size);
      say("size " + std::to_string(size.width) + " " + std::to_string(size.height));
    }
    gui.beginFrame(size, 1.0 / 60, window.takeEvents());
    panel(gui, seen);
    framebuffer->clear(Vec4(0.05f, 0.05f, 0.06f, 1));
    const PixelRect area{Vec2(0), Vec2(size.width, size.height)};
    view.draw(size, area, fitImage(view.imageSize(), area), {.toneMap = seen.toneMap});
    if (gui.keyPressed(Key::kEscape)) window.requestClose();
    gui.endFrame();
    window.present(*framebuffer);
    if (window.kind() != WindowKind::kGlfw && frame == 5) break;  // nobody is there to close it
  }
  if (pictureFile && framebuffer) writeFileAtomically(*pictureFile, encodePng(framebuffer->read()));
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    const int result = run(count > 1 ? std::optional<std::string>(arguments[1]) : std::nullopt);
    say("closed");
    return result;
  } catch (const std::exception& error) {
    std::cerr << "window_program: " << error.what() << '\n';
    return 1;
  }
}
