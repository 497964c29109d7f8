#include "ui/viewer/panel_parts.h"
#include "ui/viewer/panels.h"

namespace cellcut {

ViewerCommand drawViewPanel(Widgets& widgets, const ViewerFacts& facts, ViewerState& state) {
  ViewerCommand command = ViewerCommand::kNone;
  if (!widgets.section("View")) return command;
  const auto button = [&](const char* label, ViewerCommand what, const char* tooltip) {
    if (widgets.button(label, tooltip)) command = what;
  };
  ImageViewSettings& d = state.display;
  widgets.slider("Exposure", d.exposure, -12, 12, "EV: + and −");
  widgets.checkbox("Tone map", d.toneMap, "Khronos PBR Neutral, else clipped");
  static constexpr std::array<std::string_view, 5> kChannels{"RGB", "red", "green", "blue", "luminance"};
  chooseEnum(widgets, "Channel", d.channel, kChannels, "What is shown");
  std::vector<std::string_view> cameras;
  for (const Camera& camera : facts.scene.cameras) cameras.push_back(camera.name);
  int camera = static_cast<int>(state.settings.camera);
  if (widgets.choice("Camera", camera, cameras, "A camera of the scene")) {
    state.settings.camera = static_cast<std::size_t>(camera);
    state.settings.view.reset();
  }
  button("Reset", ViewerCommand::kResetCamera, "Back to the scene's camera (R)");
  ImGui::SameLine();
  button("Copy", ViewerCommand::kCopyCamera, "The view as JSON (Ctrl+C)");
  ImGui::SameLine();
  button("Paste", ViewerCommand::kPasteCamera, "A view that was copied (Ctrl+V)");
  ImGui::SameLine();
  button("Reload", ViewerCommand::kReload, "The scene's file again (F5)");
  button("Store", ViewerCommand::kStore, "Keep this picture to compare with (T)");
  if (facts.hasStored) {
    ImGui::SameLine();
    button("Forget", ViewerCommand::kForget, "Drop the stored picture");
    widgets.slider("Split", d.split, 0, 1, "Live picture left of it, stored one right; hold B to flip");
  }
  ImGui::SameLine();
  button("Save", ViewerCommand::kSave, "Window as PNG and rendering as EXR (F12)");
  return command;
}

}  // namespace cellcut
