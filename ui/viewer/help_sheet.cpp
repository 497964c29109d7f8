#include "ui/viewer/panels.h"

#include <algorithm>
#include <array>

#include <imgui.h>

namespace cellcut {

void drawHelp(bool& open) {
  static constexpr std::array<std::array<const char*, 2>, 32> kKeys{
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
       {"Ctrl+1 … 9", "keep the view; Shift+1 … 9 goes back to it"},
       {"Ctrl+O", "open the scene before this one again"},
       {"J", "make a reference, or use it as far as it is"},
       {"Y, Ctrl+E", "keep the convergence curve, save all as CSV"},
       {"I", "try settings and use the best, or stop that"},
       {"U", "duel of two strategies in equal time"},
       {"Escape", "end the inspection"},
       {"drop a file", "open a scene, or an EXR as reference"}}};
  // On a small window the letters are smaller: a sheet that scrolls is one where a key is overlooked.
  const ImVec2 window = ImGui::GetIO().DisplaySize, spacing = ImGui::GetStyle().ItemSpacing;
  const float font = ImGui::GetFontSize(), row = font + spacing.y;
  const float height = (static_cast<float>(kKeys.size()) + 1) * row, width = 33 * font;
  const float rest = ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().WindowPadding.y;
  const float scale = std::min({1.0f, (0.98f * window.y - rest) / height, 0.98f * window.x / width});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(scale * spacing.x, scale * spacing.y));
  ImGui::SetNextWindowSize(ImVec2(scale * width, scale * height + rest), ImGuiCond_Always);
  const ImVec2 middle(0.5f * window.x, 0.5f * window.y);
  ImGui::SetNextWindowPos(middle, ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  if (ImGui::Begin("Keys (F1)", &open, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize)) {
    ImGui::SetWindowFontScale(scale);
    for (const auto& [key, what] : kKeys) {
      ImGui::TextUnformatted(key);
      ImGui::SameLine(9 * ImGui::GetFontSize());
      ImGui::TextUnformatted(what);
    }
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace cellcut
