#include "ui/viewer/panels.h"

#include <imgui.h>

namespace cellcut {

ViewerCommand drawProblem(Widgets& widgets, const ViewerFacts& facts) {
  if (facts.problem.empty()) return ViewerCommand::kNone;
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 0.55f, 0.45f, 1.0f));
  ImGui::TextWrapped("%s", facts.problem.c_str());
  ImGui::PopStyleColor();
  return widgets.button("Dismiss") ? ViewerCommand::kDismiss : ViewerCommand::kNone;
}

}  // namespace cellcut
