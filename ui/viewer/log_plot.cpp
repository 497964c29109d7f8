#include "ui/viewer/log_plot.h"

#include "ui/overlays/color_scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <imgui.h>

namespace cellcut {
namespace {

/// Source: Okabe and Ito 2008, colours that colour-blind readers can tell apart; the first is white here.
constexpr std::array<ImU32, 7> kColors{
    IM_COL32(245, 245, 245, 255), IM_COL32(230, 159, 0, 255), IM_COL32(86, 180, 233, 255), IM_COL32(0, 158, 115, 255),
    IM_COL32(240, 228, 66, 255),  IM_COL32(213, 94, 0, 255),  IM_COL32(204, 121, 167, 255)};

/// Enough that 100 to 5000 are written out; each tick has one digit that is not 0.
constexpr int kTickDigits = 4;

bool canBeShown(const glm::dvec2& p) {
  return p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y);
}

/// Decimal logarithms.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    low = std::min(low, std::log10(value));
    high = std::max(high, std::log10(value));
  }
  /// At least half a decade, and a little more than there is.
  void widen() {
    const double half = std::max(0.25, 0.55 * (high - low)), middle = 0.5 * (low + high);
    low = middle - half;
    high = middle + half;
  }
  double share(double log) const { return (log - low) / (high - low); }
};

struct PlotFrame {
  ImVec2 lower, upper;
  Range x, y;
  float atX(double log) const { return lower.x + static_cast<float>(x.share(log)) * (upper.x - lower.x); }
  float atY(double log) const { return upper.y - static_cast<float>(y.share(log)) * (upper.y - lower.y); }
};

/// Powers of ten, or where fewer than two lie in the range 1, 2 and 5 times these.
std::vector<double> ticksOf(const Range& range) {
  std::vector<double> ticks;
  for (const bool fine : {false, true}) {
    ticks.clear();
    for (int decade = static_cast<int>(std::floor(range.low)); decade <= range.high; ++decade) {
      for (const double factor : {1.0, 2.0, 5.0}) {
        const double log = decade + std::log10(factor);
        if ((fine || factor == 1) && log >= range.low && log <= range.high) ticks.push_back(log);
      }
    }
    if (ticks.size() >= 2) break;
  }
  return ticks;
}

void drawAxes(const PlotFrame& f, ImDrawList* list) {
  constexpr ImU32 kGrid = IM_COL32(255, 255, 255, 40), kText = IM_COL32(190, 192, 196, 255);
  const float font = ImGui::GetFontSize();
  list->AddRect(f.lower, f.upper, IM_COL32(255, 255, 255, 90));
  float free = -1e9f;
  for (const double log : ticksOf(f.x)) {
    const float at = f.atX(log);
    list->AddLine(ImVec2(at, f.lower.y), ImVec2(at, f.upper.y), kGrid);
    const std::string label = shortNumber(std::pow(10, log), kTickDigits);
    const float width = ImGui::CalcTextSize(label.c_str()).x;
    const float left = std::clamp(at - 0.5f * width, f.lower.x, f.upper.x - width);
    if (left < free) continue;
    list->AddText(ImVec2(left, f.upper.y + 0.15f * font), kText, label.c_str());
    free = left + width + 0.5f * font;
  }
  free = 1e9f;  // from below
  for (const double log : ticksOf(f.y)) {
    const float at = f.atY(log);
    list->AddLine(ImVec2(f.lower.x, at), ImVec2(f.upper.x, at), kGrid);
    const float top = std::clamp(at - 0.5f * font, f.lower.y, f.upper.y - font);
    if (top + font > free) continue;
    const std::string label = shortNumber(std::pow(10, log), kTickDigits);
    list->AddText(ImVec2(f.lower.x - ImGui::CalcTextSize(label.c_str()).x - 0.3f * font, top), kText, label.c_str());
    free = top;
  }
}

}  // namespace

void drawLogPlot(const std::vector<PlotCurve>& curves, const char* xTitle, const char* yTitle) {
  PlotFrame f;
  for (const PlotCurve& curve : curves) {
    for (const glm::dvec2& p : curve.points) {
      if (!canBeShown(p)) continue;
      f.x.add(p.x);
      f.y.add(p.y);
    }
  }
  if (!(f.x.low <= f.x.high)) {
    ImGui::TextDisabled("nothing measured yet");
    return;
  }
  f.x.widen();
  f.y.widen();
  const float font = ImGui::GetFontSize(), width = ImGui::GetContentRegionAvail().x, height = 11 * font;
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s over %s", yTitle, xTitle);
  ImGui::PopTextWrapPos();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::Dummy(ImVec2(width, height));
  f.lower = ImVec2(corner.x + 3.6f * font, corner.y + 0.2f * font);
  f.upper = ImVec2(corner.x + width - 0.5f * font, corner.y + height - 1.4f * font);
  ImDrawList* list = ImGui::GetWindowDrawList();
  drawAxes(f, list);
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const ImU32 color = kColors[c % kColors.size()];
    std::vector<ImVec2> line;
    for (const glm::dvec2& p : curves[c].points) {
      if (canBeShown(p)) line.emplace_back(f.atX(std::log10(p.x)), f.atY(std::log10(p.y)));
    }
    list->AddPolyline(line.data(), static_cast<int>(line.size()), color, 0, 0.1f * font);
    for (const ImVec2& p : line) list->AddCircleFilled(p, 0.15f * font, color);
  }
  for (std::size_t c = 0; c < curves.size(); ++c) {
    ImGui::PushStyleColor(ImGuiCol_Text, kColors[c % kColors.size()]);
    ImGui::TextWrapped("%s", curves[c].name.c_str());
    ImGui::PopStyleColor();
  }
}

}  // namespace cellcut
