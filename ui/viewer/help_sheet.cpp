#include "ui/viewer/panels.h"

#include <array>

#include <imgui.h>

namespace cellcut {

void drawHelp(bool& open) {
  static constexpr std::array<std::array<const char*, 2>, 26> kKeys{
      {{"F1", "this sheet"},
       {"F2", "hide or show the panels"},
       {"F5", "load the scene's file again"},
       {"F12", "save window (PNG) and rendering (EXR)"},
       {"drag left", "orbit around what is looked at"},
       {"drag right", "look around"},
       {"drag middle", "pan"},
       {"wheel", "nearer, farther"},
       {"W A S D", "fly; Q E or C Space down and up"},
       {"Shift", "fly ten times as fast"},
       {"click", "inspect the cell under the pointer"},
       {"F", "orbit around the point under the pointer"},
       {"R", "back to the scene's camera"},
       {"1 … 6", "strategies"},
       {"O", "next overlay; Shift+O the one before"},
       {"G", "wireframe of the touched cells"},
       {"K, [ ]", "slice through the cells, move it"},
       {"X", "select the cluster whose box is under the pointer"},
       {"L, M", "solo, mute the selected cluster or light"},
       {"N", "all lights again"},
       {"P, .", "pause, one pass"},
       {"T, hold B", "store the picture, flip to it"},
       {"+ −", "exposure"},
       {"Ctrl+C, Ctrl+V", "copy and paste the view"},
       {"Escape", "end the inspection"},
       {"drop a file", "open a scene"}}};
  ImGui::SetNextWindowSize(ImVec2(30 * ImGui::GetFontSize(), 0), ImGuiCond_Always);
  const ImVec2 middle(0.5f * ImGui::GetIO().DisplaySize.x, 0.5f * ImGui::GetIO().DisplaySize.y);
  ImGui::SetNextWindowPos(middle, ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  if (ImGui::Begin("Keys (F1)", &open, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize)) {
    for (const auto& [key, what] : kKeys) {
      ImGui::TextUnformatted(key);
      ImGui::SameLine(9 * ImGui::GetFontSize());
      ImGui::TextUnformatted(what);
    }
  }
  ImGui::End();
}

}  // namespace cellcut
