/// \file input_event.h
/// What a person, or a script in a person's place, does to a window.
///
/// Positions are framebuffer pixels, origin top left, x right, y down.
#pragma once

#include "renderer/base/math.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

namespace cellcut {

/// A key by its place on the US layout.
enum class Key : std::uint8_t {
  // clang-format off
  kA, kB, kC, kD, kE, kF, kG, kH, kI, kJ, kK, kL, kM, kN, kO, kP, kQ, kR, kS, kT, kU, kV, kW, kX, kY, kZ,
  k0, k1, k2, k3, k4, k5, k6, k7, k8, k9,
  kF1, kF2, kF3, kF4, kF5, kF6, kF7, kF8, kF9, kF10, kF11, kF12,
  kTab, kLeft, kRight, kUp, kDown, kPageUp, kPageDown, kHome, kEnd, kInsert, kDelete, kBackspace, kSpace, kEnter,
  kEscape, kApostrophe, kComma, kMinus, kPeriod, kSlash, kSemicolon, kEqual, kLeftBracket, kBackslash, kRightBracket,
  kGrave, kKeypadEnter, kKeypadAdd, kKeypadSubtract,
  kLeftShift, kRightShift, kLeftControl, kRightControl, kLeftAlt, kRightAlt, kLeftSuper, kRightSuper
  // clang-format on
};
inline constexpr int kKeyCount = static_cast<int>(Key::kRightSuper) + 1;

/// "A", "7", "F12", "Space", "LeftShift", "Comma" …: the enumerator without its k.
std::string_view keyName(Key key);
/// Its inverse, upper and lower case alike; also "Ctrl", "Shift", "Alt", "Esc" and "Return". Nothing if there is no
/// such key.
std::optional<Key> keyFromName(std::string_view name);

/// Whether two names, of keys or of widgets, are the same but for the case of their letters.
bool equalIgnoringCase(std::string_view a, std::string_view b);

enum class MouseButton : std::uint8_t { kLeft, kRight, kMiddle };
inline constexpr int kMouseButtonCount = 3;
/// As scripts call them.
inline constexpr std::array<std::string_view, kMouseButtonCount> kMouseButtonNames{"left", "right", "middle"};

struct MouseMove {
  Vec2 position{0};
  bool operator==(const MouseMove&) const = default;
};
/// The pointer left the window.
struct MouseLeave {
  bool operator==(const MouseLeave&) const = default;
};
struct MouseButtonChange {
  MouseButton button = MouseButton::kLeft;
  bool down = false;
  bool operator==(const MouseButtonChange&) const = default;
};
/// Notches of the wheel: y > 0 away from the person, x > 0 to the left.
struct Scroll {
  Vec2 notches{0};
  bool operator==(const Scroll&) const = default;
};
/// A press or a release; a held key is not repeated here.
struct KeyChange {
  Key key = Key::kA;
  bool down = false;
  bool operator==(const KeyChange&) const = default;
};
/// A character that was typed, after the keyboard's layout: a Unicode code point.
struct TextInput {
  char32_t character = 0;
  bool operator==(const TextInput&) const = default;
};
/// The window got or lost the keyboard. On loss every key and button counts as released.
struct FocusChange {
  bool focused = false;
  bool operator==(const FocusChange&) const = default;
};

using InputEvent = std::variant<MouseMove, MouseLeave, MouseButtonChange, Scroll, KeyChange, TextInput, FocusChange>;

}  // namespace cellcut
