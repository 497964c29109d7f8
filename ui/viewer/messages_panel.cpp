#include "ui/viewer/panels.h"

#include <imgui.h>

namespace cellcut {

ViewerCommand drawMessages(Widgets& widgets, const ViewerFacts& facts) {
  if (facts.problem.empty() && facts.notice.empty()) return ViewerCommand::kNone;
  if (!facts.problem.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 0.55f, 0.45f, 1.0f));
    ImGui::TextWrapped("%s", facts.problem.c_str());
    ImGui::PopStyleColor();
  }
  if (!facts.notice.empty()) ImGui::TextWrapped("%s", facts.notice.c_str());
  return widgets.button("Dismiss") ? ViewerCommand::kDismiss : ViewerCommand::kNone;
}

}  // namespace cellcut
