/// \file widgets.h
/// Dear ImGui's widgets, each remembered with its label, place and value, so that a script finds them as a person does.
#pragma once

#include "renderer/base/math.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cellcut {

/// The number that all of the text is, decimal digits alone; nothing for any other and from 2^64 on.
std::optional<std::uint64_t> wholeNumber(std::string_view text);

/// What a frame showed under a label.
struct WidgetItem {
  enum class Kind { kButton, kCheckbox, kNumber, kWhole, kChoice, kOption, kText } kind;
  std::string label;
  std::string value;    ///< as shown: "on", "off", a number, the chosen name, a text
  Vec2 lower, upper;    ///< framebuffer pixels
  bool visible = true;  ///< its middle is not scrolled out of its panel
};

/// What a person changed in a frame.
struct WidgetEdit {
  std::string label;
  std::optional<std::string> value;  ///< what it was set to, exactly; nothing: it was clicked
};

/// One per frame; labels are unique in a frame. Between Gui::beginFrame and endFrame.
class Widgets {
 public:
  /// \param reveal  the label of what its panel is to scroll to, unless it is empty
  explicit Widgets(std::string reveal = "") : reveal_(std::move(reveal)) {}

  const std::vector<WidgetItem>& items() const { return items_; }
  /// By its label, upper and lower case alike; null if the frame did not show it.
  const WidgetItem* find(std::string_view label) const;
  /// An entry of the open list; null if no list shows it.
  const WidgetItem* findOption(std::string_view name) const;

  const std::vector<WidgetEdit>& edits() const { return edits_; }

  /// A headline that opens and closes what is below it; whether that is open.
  bool section(const char* title, bool beginsOpen = true);
  bool button(const char* label, const char* tooltip = nullptr);
  bool checkbox(const char* label, bool& value, const char* tooltip = nullptr);
  bool slider(const char* label, float& value, float least, float most, const char* tooltip, bool logarithmic = false);
  bool slider(const char* label, int& value, int least, int most, const char* tooltip, bool logarithmic = false);
  /// A field for a whole number of its own; what is none is not taken.
  bool whole(const char* label, std::uint64_t& value, const char* tooltip);
  /// A field for a number of its own; 0 means none.
  bool number(const char* label, double& value, const char* tooltip);
  /// \return whether another index was chosen
  bool choice(const char* label, int& index, std::span<const std::string_view> names, const char* tooltip);
  /// A row of a table over all of its columns, begun in its first. \return whether it was clicked
  bool row(const char* label, const char* shown, bool selected);
  /// "label  value" on a line.
  void text(const char* label, const std::string& value, const char* tooltip = nullptr);

 private:
  void remember(WidgetItem::Kind kind, const char* label, std::string value);
  void changed(const char* label, std::optional<std::string> value) { edits_.push_back({label, std::move(value)}); }

  std::string reveal_;
  std::vector<WidgetItem> items_;
  std::vector<WidgetEdit> edits_;
};

}  // namespace cellcut
