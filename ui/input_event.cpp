#include "ui/input_event.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace cellcut {

namespace {

/// In the order of Key.
constexpr std::array<std::string_view, kKeyCount> kNames{
    // clang-format off
    "A", "B", "C", "D", "E", "F", "G", "H", "I", "J", "K", "L", "M", "N", "O", "P", "Q", "R", "S", "T", "U", "V", "W",
    "X", "Y", "Z",
    "0", "1", "2", "3", "4", "5", "6", "7", "8", "9",
    "F1", "F2", "F3", "F4", "F5", "F6", "F7", "F8", "F9", "F10", "F11", "F12",
    "Tab", "Left", "Right", "Up", "Down", "PageUp", "PageDown", "Home", "End", "Insert", "Delete", "Backspace",
    "Space", "Enter", "Escape", "Apostrophe", "Comma", "Minus", "Period", "Slash", "Semicolon", "Equal", "LeftBracket",
    "Backslash", "RightBracket", "Grave", "KeypadEnter", "KeypadAdd", "KeypadSubtract",
    "LeftShift", "RightShift", "LeftControl", "RightControl", "LeftAlt", "RightAlt", "LeftSuper", "RightSuper"
    // clang-format on
};
static_assert(kNames.back() == "RightSuper");

constexpr std::pair<std::string_view, Key> kShortNames[] = {{"Ctrl", Key::kLeftControl},
                                                            {"Shift", Key::kLeftShift},
                                                            {"Alt", Key::kLeftAlt},
                                                            {"Esc", Key::kEscape},
                                                            {"Return", Key::kEnter}};

}  // namespace

bool equalIgnoringCase(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::string_view keyName(Key key) {
  return kNames[static_cast<std::size_t>(key)];
}

std::optional<Key> keyFromName(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (equalIgnoringCase(kNames[i], name)) return static_cast<Key>(i);
  for (const auto& [shortName, key] : kShortNames)
    if (equalIgnoringCase(shortName, name)) return key;
  return std::nullopt;
}

}  // namespace cellcut
