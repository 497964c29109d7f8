/// \file widgets.h
/// Dear ImGui's widgets, each remembered with its label, place and value, so that a script finds them as a person does.
#pragma once

#include "renderer/base/math.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cellcut {

/// What a frame showed under a label.
struct WidgetItem {
  enum class Kind { kButton, kCheckbox, kNumber, kChoice, kOption, kText } kind;
  std::string label;
  std::string value;  ///< as shown: "on", "off", a number, the chosen name, a text
  Vec2 lower, upper;  ///< framebuffer pixels, visible part
};

/// One per frame; labels are unique in a frame. Between Gui::beginFrame and endFrame.
class Widgets {
 public:
  const std::vector<WidgetItem>& items() const { return items_; }
  /// By its label, upper and lower case alike; null if the frame did not show it.
  const WidgetItem* find(std::string_view label) const;

  bool button(const char* label, const char* tooltip = nullptr);
  bool checkbox(const char* label, bool& value, const char* tooltip = nullptr);
  bool slider(const char* label, float& value, float least, float most, const char* tooltip, bool logarithmic = false);
  bool slider(const char* label, int& value, int least, int most, const char* tooltip, bool logarithmic = false);
  /// A field for a number of its own; 0 means none.
  bool number(const char* label, double& value, const char* tooltip);
  /// \return whether another index was chosen
  bool choice(const char* label, int& index, std::span<const std::string_view> names, const char* tooltip);
  /// "label  value" on a line.
  void text(const char* label, const std::string& value, const char* tooltip = nullptr);

 private:
  void remember(WidgetItem::Kind kind, const char* label, std::string value);

  std::vector<WidgetItem> items_;
};

}  // namespace cellcut
