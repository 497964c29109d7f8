/// \file gui_input.h
/// Our input events → ImGui's state, for both ways that its versions take it.
#pragma once

#include "ui/input_event.h"

#include <bitset>
#include <span>

struct ImGuiIO;

namespace cellcut {

class GuiInput {
 public:
  /// Names the keys to ImGui.
  explicit GuiInput(ImGuiIO& io);

  /// \pre the events are a run of InputQueue: ImGui is told only what they leave behind
  void feed(ImGuiIO& io, std::span<const InputEvent> events);

 private:
  void apply(ImGuiIO& io, const InputEvent& event);

  std::bitset<kKeyCount> keys_;
  std::bitset<kMouseButtonCount> buttons_;
  Vec2 pointer_;
};

/// ImGui::IsKeyDown and ImGui::IsKeyPressed of this version of ImGui. \pre within a frame
bool guiKeyDown(Key key);
bool guiKeyPressed(Key key, bool repeat);

}  // namespace cellcut
