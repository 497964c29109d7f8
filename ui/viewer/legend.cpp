#include "ui/viewer/panels.h"

#include <algorithm>

#include <imgui.h>

namespace cellcut {

void drawLegend(const OverlayPicture& overlay, const OverlayChoice& choice, const PixelRect& area, float uiScale) {
  const OverlayName& name = describe(overlay.overlay);
  const ColorScale scale(overlay.values, scaleOf(overlay.overlay, choice.scale));
  const Legend legend = makeLegend(scale, overlay.title, name.unit, name.integral);
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  const float font = ImGui::GetFontSize(), width = std::min(16 * font, area.size.x - 2 * font), height = 0.9f * font;
  const float pad = 0.5f * font;
  const ImVec2 corner(area.origin.x + font, area.origin.y + area.size.y - 4.2f * font);
  list->AddRectFilled(ImVec2(corner.x - pad, corner.y - pad),
                      ImVec2(corner.x + width + 2 * pad, corner.y + 3.6f * font), IM_COL32(15, 15, 18, 205),
                      4 * uiScale);
  const std::string title = legend.unit.empty() ? legend.title : legend.title + ", " + legend.unit;
  const bool hasValues = legend.range && overlay.statistics.count > 0;
  list->AddText(corner, IM_COL32_WHITE, (hasValues ? title : title + ": no values").c_str());
  if (!hasValues) return;
  const ImVec2 bar(corner.x, corner.y + 1.2f * font);
  constexpr int kSteps = 128;
  for (int i = 0; i < kSteps; ++i) {
    const Rgb8 c = colorOf(choice.scale.colormap, (i + 0.5) / kSteps);
    const float x0 = bar.x + width * static_cast<float>(i) / kSteps,
                x1 = bar.x + width * static_cast<float>(i + 1) / kSteps;
    list->AddRectFilled(ImVec2(x0, bar.y), ImVec2(x1, bar.y + height), IM_COL32(c.x, c.y, c.z, 255));
  }
  float free = -1e9f;  // labels that would touch the one before are left out
  for (const LegendTick& tick : legend.ticks) {
    const float x = bar.x + width * static_cast<float>(tick.position);
    list->AddLine(ImVec2(x, bar.y), ImVec2(x, bar.y + height + 0.2f * font), IM_COL32_WHITE);
    const float half = 0.5f * ImGui::CalcTextSize(tick.label.c_str()).x;
    const float left = std::clamp(x - half, bar.x, std::max(bar.x, bar.x + width - 2 * half));
    if (left < free) continue;
    list->AddText(ImVec2(left, bar.y + height + 0.2f * font), IM_COL32_WHITE, tick.label.c_str());
    free = left + 2 * half + 0.5f * font;
  }
}

}  // namespace cellcut
