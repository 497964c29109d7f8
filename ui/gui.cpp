#include "ui/gui.h"

#include "ui/gui_input.h"
#include "ui/gui_renderer.h"
#include "ui/gui_style.h"
#include "ui/window.h"

#include <algorithm>
#include <string>
#include <utility>

#include <imgui.h>

namespace cellcut {

struct DestroyContext {
  void operator()(ImGuiContext* context) const { ImGui::DestroyContext(context); }
};
using ContextOwner = std::unique_ptr<ImGuiContext, DestroyContext>;

namespace {

ContextOwner makeContext(float scale) {
  ContextOwner context(ImGui::CreateContext());
  ImGui::SetCurrentContext(context.get());
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  io.BackendRendererName = "cellcut";
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  setStyle(ImGui::GetStyle(), scale);
  addFont(*io.Fonts, scale);
  return context;
}

}  // namespace

struct Gui::State {
  State(Window& window_, float scale)
      : window(window_), context(makeContext(scale)), input(ImGui::GetIO()), renderer(*ImGui::GetIO().Fonts) {
    ImGuiIO& io = ImGui::GetIO();
    io.ClipboardUserData = this;
    io.GetClipboardTextFn = [](void* state) {
      auto& self = *static_cast<State*>(state);
      self.clipboard = self.window.clipboard();
      return self.clipboard.c_str();
    };
    io.SetClipboardTextFn = [](void* state, const char* text) {
      static_cast<State*>(state)->window.setClipboard(text);
    };
  }

  Window& window;
  std::string clipboard;  ///< what ImGui was lent last
  ContextOwner context;
  GuiInput input;
  GuiRenderer renderer;
};

Gui::Gui(Window& window, const GuiSettings& settings)
    : settings_(settings), state_(std::make_unique<State>(window, settings.scale)) {}

Gui::~Gui() = default;

void Gui::beginFrame(PixelSize size, double seconds, std::span<const InputEvent> events) {
  ImGui::SetCurrentContext(state_->context.get());
  queue_.push(events);
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = ImVec2(static_cast<float>(size.width), static_cast<float>(size.height));
  constexpr float kShortest = 1e-6f;  // ImGui wants more than 0
  io.DeltaTime = std::max(static_cast<float>(seconds), kShortest);
  state_->input.feed(io, queue_.takeFrame());
  ImGui::NewFrame();
  inFrame_ = true;
}

void Gui::abandonFrame() {
  if (std::exchange(inFrame_, false)) ImGui::EndFrame();
}

void Gui::endFrame() {
  inFrame_ = false;
  ImGui::Render();
  state_->renderer.draw(*ImGui::GetDrawData());
}

bool Gui::wantsMouse() const {
  ImGui::SetCurrentContext(state_->context.get());
  return ImGui::GetIO().WantCaptureMouse;
}

bool Gui::wantsKeyboard() const {
  ImGui::SetCurrentContext(state_->context.get());
  return ImGui::GetIO().WantCaptureKeyboard || ImGui::GetIO().WantTextInput;
}

bool Gui::keyDown(Key key) const {
  return guiKeyDown(key);
}
bool Gui::keyPressed(Key key, bool repeat) const {
  return guiKeyPressed(key, repeat);
}
bool Gui::controlDown() const {
  return ImGui::GetIO().KeyCtrl;
}
bool Gui::shiftDown() const {
  return ImGui::GetIO().KeyShift;
}

}  // namespace cellcut
