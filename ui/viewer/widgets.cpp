#include "ui/viewer/widgets.h"

#include "renderer/base/exact_number.h"
#include "ui/input_event.h"

#include <algorithm>
#include <charconv>
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

/// The name goes before the field, where a narrow panel never cuts it off, or above it where one of them is too long for
/// that.
/// \param least  width that the field needs, framebuffer pixels
void nameOfField(const char* label, float least = 0) {
  const float column = 0.42f * ImGui::GetWindowWidth();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  const float end = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x;
  const bool fits = column + least <= ImGui::GetWindowContentRegionMax().x;
  if (fits && end + ImGui::GetStyle().ItemInnerSpacing.x <= column) ImGui::SameLine(column);
  ImGui::SetNextItemWidth(-1);
}

std::string hidden(const char* label) {
  return std::string("##") + label;
}

}  // namespace

std::optional<std::uint64_t> wholeNumber(std::string_view text) {
  std::uint64_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

const WidgetItem* Widgets::find(std::string_view label) const {
  const auto found = std::find_if(items_.begin(), items_.end(),
                                  [&](const WidgetItem& item) { return equalIgnoringCase(item.label, label); });
  return found == items_.end() ? nullptr : &*found;
}

const WidgetItem* Widgets::findOption(std::string_view name) const {
  const auto found = std::find_if(items_.begin(), items_.end(), [&](const WidgetItem& item) {
    return item.kind == WidgetItem::Kind::kOption && equalIgnoringCase(item.label, name);
  });
  return found == items_.end() ? nullptr : &*found;
}

void Widgets::remember(WidgetItem::Kind kind, const char* label, std::string value) {
  const ImVec2 lower = ImGui::GetItemRectMin(), upper = ImGui::GetItemRectMax();
  const float middle = 0.5f * (lower.y + upper.y), top = ImGui::GetWindowPos().y;
  const bool visible = middle >= top && middle < top + ImGui::GetWindowHeight();
  items_.push_back({kind, label, std::move(value), {lower.x, lower.y}, {upper.x, upper.y}, visible});
  if (!reveal_.empty() && equalIgnoringCase(reveal_, label)) ImGui::SetScrollHereY(0.5f);
}

bool Widgets::section(const char* title, bool beginsOpen) {
  const ImGuiTreeNodeFlags flags = beginsOpen ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None;
  const bool open = ImGui::CollapsingHeader(title, flags);
  remember(WidgetItem::Kind::kButton, title, open ? "open" : "closed");
  if (ImGui::IsItemToggledOpen()) changed(title, std::nullopt);
  return open;
}

bool Widgets::button(const char* label, const char* tooltip) {
  const bool pressed = ImGui::Button(label);
  remember(WidgetItem::Kind::kButton, label, "");
  explain(tooltip);
  if (pressed) changed(label, std::nullopt);
  return pressed;
}

bool Widgets::checkbox(const char* label, bool& value, const char* tooltip) {
  const bool edited = ImGui::Checkbox(label, &value);
  remember(WidgetItem::Kind::kCheckbox, label, value ? "on" : "off");
  explain(tooltip);
  if (edited) changed(label, value ? "on" : "off");
  return edited;
}

bool Widgets::slider(const char* label, float& value, float least, float most, const char* tooltip, bool logarithmic) {
  nameOfField(label);
  const ImGuiSliderFlags flags =
      ImGuiSliderFlags_AlwaysClamp |
      (logarithmic ? static_cast<int>(ImGuiSliderFlags_Logarithmic) | ImGuiSliderFlags_NoRoundToFormat : 0);
  const bool edited =
      ImGui::SliderFloat(hidden(label).c_str(), &value, least, most, logarithmic ? "%.2g" : "%.2f", flags);
  remember(WidgetItem::Kind::kNumber, label, shown(static_cast<double>(value)));
  explain(tooltip);
  if (edited) changed(label, exactNumber(value));
  return edited;
}

bool Widgets::slider(const char* label, int& value, int least, int most, const char* tooltip, bool logarithmic) {
  nameOfField(label);
  const ImGuiSliderFlags flags =
      ImGuiSliderFlags_AlwaysClamp | (logarithmic ? static_cast<int>(ImGuiSliderFlags_Logarithmic) : 0);
  const bool edited = ImGui::SliderInt(hidden(label).c_str(), &value, least, most, "%d", flags);
  remember(WidgetItem::Kind::kWhole, label, std::to_string(value));
  explain(tooltip);
  if (edited) changed(label, std::to_string(value));
  return edited;
}

bool Widgets::whole(const char* label, std::uint64_t& value, const char* tooltip) {
  nameOfField(label);
  char text[32];
  std::snprintf(text, sizeof text, "%s", std::to_string(value).c_str());
  const bool entered = ImGui::InputText(hidden(label).c_str(), text, sizeof text,
                                        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  const std::optional<std::uint64_t> number = entered ? wholeNumber(text) : std::nullopt;
  if (number) value = *number;
  remember(WidgetItem::Kind::kWhole, label, std::to_string(value));
  explain(tooltip);
  if (number) changed(label, std::to_string(value));
  return number.has_value();
}

bool Widgets::number(const char* label, double& value, const char* tooltip) {
  nameOfField(label);
  double entered = value;
  const bool edited = ImGui::InputDouble(hidden(label).c_str(), &entered, 0, 0, entered == 0 ? "none" : "%g",
                                         ImGuiInputTextFlags_EnterReturnsTrue);
  if (edited && entered >= 0) value = entered;
  remember(WidgetItem::Kind::kNumber, label, shown(value));
  explain(tooltip);
  if (edited) changed(label, exactNumber(value));
  return edited;
}

bool Widgets::choice(const char* label, int& index, std::span<const std::string_view> names, const char* tooltip) {
  const std::string current(names[static_cast<std::size_t>(index)]);
  const float arrow = ImGui::GetFrameHeight();
  nameOfField(label, ImGui::CalcTextSize(current.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x + arrow);
  const bool open = ImGui::BeginCombo(hidden(label).c_str(), current.c_str(), ImGuiComboFlags_HeightLarge);
  remember(WidgetItem::Kind::kChoice, label, current);
  explain(open ? nullptr : tooltip);
  if (!open) return false;
  bool edited = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name(names[i]);
    if (ImGui::Selectable(name.c_str(), static_cast<int>(i) == index)) {
      edited = static_cast<int>(i) != index;
      index = static_cast<int>(i);
      changed(label, name);
    }
    remember(WidgetItem::Kind::kOption, name.c_str(), "");
  }
  ImGui::EndCombo();
  return edited;
}

bool Widgets::row(const char* label, const char* shown, bool selected) {
  const std::string id = std::string(shown) + "###" + label;
  const bool clicked = ImGui::Selectable(id.c_str(), selected, ImGuiSelectableFlags_SpanAllColumns);
  remember(WidgetItem::Kind::kButton, label, selected ? "on" : "off");
  if (clicked) changed(label, std::nullopt);
  return clicked;
}

void Widgets::text(const char* label, const std::string& value, const char* tooltip) {
  nameOfField(label);
  ImGui::TextWrapped("%s", value.c_str());
  remember(WidgetItem::Kind::kText, label, value);
  explain(tooltip);
}

}  // namespace cellcut
