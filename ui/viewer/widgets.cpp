#include "ui/viewer/widgets.h"

#include <algorithm>
#include <cctype>
#include <cstdio>

#include <imgui.h>

namespace cellcut {
namespace {

std::string shown(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

void explain(const char* tooltip) {
  if (tooltip && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", tooltip);
}

/// The name goes before the field, where a narrow panel never cuts it off.
void nameOfField(const char* label) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  ImGui::SameLine(0.42f * ImGui::GetWindowWidth());
  ImGui::SetNextItemWidth(-1);
}

std::string hidden(const char* label) {
  return std::string("##") + label;
}

bool sameText(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

const WidgetItem* Widgets::find(std::string_view label) const {
  const auto found =
      std::find_if(items_.begin(), items_.end(), [&](const WidgetItem& item) { return sameText(item.label, label); });
  return found == items_.end() ? nullptr : &*found;
}

void Widgets::remember(WidgetItem::Kind kind, const char* label, std::string value) {
  const ImVec2 lower = ImGui::GetItemRectMin(), upper = ImGui::GetItemRectMax();
  items_.push_back({kind, label, std::move(value), {lower.x, lower.y}, {upper.x, upper.y}});
}

bool Widgets::button(const char* label, const char* tooltip) {
  const bool pressed = ImGui::Button(label);
  remember(WidgetItem::Kind::kButton, label, "");
  explain(tooltip);
  return pressed;
}

bool Widgets::checkbox(const char* label, bool& value, const char* tooltip) {
  const bool changed = ImGui::Checkbox(label, &value);
  remember(WidgetItem::Kind::kCheckbox, label, value ? "on" : "off");
  explain(tooltip);
  return changed;
}

bool Widgets::slider(const char* label, float& value, float least, float most, const char* tooltip, bool logarithmic) {
  nameOfField(label);
  const ImGuiSliderFlags flags =
      ImGuiSliderFlags_AlwaysClamp |
      (logarithmic ? static_cast<int>(ImGuiSliderFlags_Logarithmic) | ImGuiSliderFlags_NoRoundToFormat : 0);
  const bool changed =
      ImGui::SliderFloat(hidden(label).c_str(), &value, least, most, logarithmic ? "%.2g" : "%.2f", flags);
  remember(WidgetItem::Kind::kNumber, label, shown(static_cast<double>(value)));
  explain(tooltip);
  return changed;
}

bool Widgets::slider(const char* label, int& value, int least, int most, const char* tooltip, bool logarithmic) {
  nameOfField(label);
  const ImGuiSliderFlags flags =
      ImGuiSliderFlags_AlwaysClamp | (logarithmic ? static_cast<int>(ImGuiSliderFlags_Logarithmic) : 0);
  const bool changed = ImGui::SliderInt(hidden(label).c_str(), &value, least, most, "%d", flags);
  remember(WidgetItem::Kind::kNumber, label, std::to_string(value));
  explain(tooltip);
  return changed;
}

bool Widgets::number(const char* label, double& value, const char* tooltip) {
  nameOfField(label);
  double edited = value;
  const bool changed = ImGui::InputDouble(hidden(label).c_str(), &edited, 0, 0, edited == 0 ? "none" : "%g",
                                          ImGuiInputTextFlags_EnterReturnsTrue);
  if (changed && edited >= 0) value = edited;
  remember(WidgetItem::Kind::kNumber, label, shown(value));
  explain(tooltip);
  return changed;
}

bool Widgets::choice(const char* label, int& index, std::span<const std::string_view> names, const char* tooltip) {
  nameOfField(label);
  const std::string current(names[static_cast<std::size_t>(index)]);
  const bool open = ImGui::BeginCombo(hidden(label).c_str(), current.c_str(), ImGuiComboFlags_HeightLarge);
  remember(WidgetItem::Kind::kChoice, label, current);
  explain(open ? nullptr : tooltip);
  if (!open) return false;
  bool changed = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name(names[i]);
    if (ImGui::Selectable(name.c_str(), static_cast<int>(i) == index)) {
      changed = static_cast<int>(i) != index;
      index = static_cast<int>(i);
    }
    remember(WidgetItem::Kind::kOption, name.c_str(), "");
  }
  ImGui::EndCombo();
  return changed;
}

void Widgets::text(const char* label, const std::string& value, const char* tooltip) {
  nameOfField(label);
  ImGui::TextUnformatted(value.c_str());
  remember(WidgetItem::Kind::kText, label, value);
  explain(tooltip);
}

}  // namespace cellcut
