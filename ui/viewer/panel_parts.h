/// \file panel_parts.h
/// What the panels share: numbers as text, choices of enumerators. Between Gui::beginFrame and endFrame.
#pragma once

#include "ui/viewer/widgets.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>

#include <imgui.h>

namespace cellcut {

template <class... Values>
std::string formatted(const char* format, Values... values) {
  char text[128];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

template <class Entries>
constexpr auto namesOf(const Entries& entries) {
  std::array<std::string_view, std::tuple_size_v<std::remove_cvref_t<Entries>>> names{};
  std::transform(entries.begin(), entries.end(), names.begin(), [](const auto& entry) { return entry.name; });
  return names;
}

/// The next button goes beside the last item where there is room for it.
inline void besideIfRoom(const char* next) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float width = ImGui::CalcTextSize(next).x + 2 * style.FramePadding.x;
  const float right = ImGui::GetItemRectMax().x + style.ItemSpacing.x + width;
  if (right <= ImGui::GetWindowPos().x + ImGui::GetContentRegionMax().x) ImGui::SameLine();
}

template <class Enum>
bool chooseEnum(Widgets& widgets, const char* label, Enum& value, std::span<const std::string_view> names,
                const char* tooltip) {
  int index = static_cast<int>(value);
  if (!widgets.choice(label, index, names, tooltip)) return false;
  value = static_cast<Enum>(index);
  return true;
}

}  // namespace cellcut
