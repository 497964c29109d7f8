#include "ui/viewer/panel_parts.h"
#include "ui/viewer/panels.h"

namespace cellcut {
namespace {

void drawBookmarks(Widgets& widgets, ViewerState& state, ViewerCommand& command) {
  std::vector<std::string> names;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < kBookmarks; ++i) {
    if (!state.bookmarks[i]) continue;
    names.push_back("view " + std::to_string(i + 1));
    places.push_back(i);
  }
  std::vector<std::string_view> shown(names.begin(), names.end());
  shown.insert(shown.begin(), names.empty() ? "none" : "go to …");
  int index = 0;
  if (widgets.choice("Bookmarks", index, shown, "Views that were kept; also Shift+1 … 9, and Ctrl+1 … 9 to keep") &&
      index > 0) {
    state.chosen = places[static_cast<std::size_t>(index) - 1];
    command = ViewerCommand::kRecallView;
  }
  if (widgets.button("Keep view", "As the first bookmark that is free, or the last one")) {
    const auto free =
        std::find_if(state.bookmarks.begin(), state.bookmarks.end(), [](const auto& bookmark) { return !bookmark; });
    state.chosen = std::min(static_cast<std::size_t>(free - state.bookmarks.begin()), kBookmarks - 1);
    command = ViewerCommand::kKeepView;
  }
}

void drawRecent(Widgets& widgets, const ViewerFacts& facts, ViewerState& state, ViewerCommand& command) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : facts.recent) names.push_back(RecentFiles::nameOf(file));
  std::vector<std::string_view> shown(names.begin(), names.end());
  shown.insert(shown.begin(), names.empty() ? "none" : "open …");
  int index = 0;
  if (widgets.choice("Recent", index, shown, "Scenes that were opened last; Ctrl+O opens the one before this") &&
      index > 0) {
    state.chosen = static_cast<std::size_t>(index) - 1;
    command = ViewerCommand::kOpenRecent;
  }
}

}  // namespace

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
  besideIfRoom("Copy");
  button("Copy", ViewerCommand::kCopyCamera, "The view as JSON (Ctrl+C)");
  besideIfRoom("Paste");
  button("Paste", ViewerCommand::kPasteCamera, "A view that was copied (Ctrl+V)");
  besideIfRoom("Reload");
  button("Reload", ViewerCommand::kReload, "The scene's file again (F5)");
  drawBookmarks(widgets, state, command);
  drawRecent(widgets, facts, state, command);
  button("Store", ViewerCommand::kStore, "Keep this picture to compare with (T)");
  if (facts.hasStored) {
    besideIfRoom("Forget");
    button("Forget", ViewerCommand::kForget, "Drop the stored picture");
    widgets.slider("Split", d.split, 0, 1, "Live picture left of it, stored one right; hold B to flip");
  }
  besideIfRoom("Save");
  button("Save", ViewerCommand::kSave, "Window as PNG and rendering as EXR (F12)");
  return command;
}

}  // namespace cellcut
