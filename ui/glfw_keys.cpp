#include "ui/glfw_keys.h"

#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace cellcut {

namespace {

/// What is not a letter, a digit or a function key, which both sides number in order.
constexpr std::pair<int, Key> kKeys[] = {{GLFW_KEY_TAB, Key::kTab},
                                         {GLFW_KEY_LEFT, Key::kLeft},
                                         {GLFW_KEY_RIGHT, Key::kRight},
                                         {GLFW_KEY_UP, Key::kUp},
                                         {GLFW_KEY_DOWN, Key::kDown},
                                         {GLFW_KEY_PAGE_UP, Key::kPageUp},
                                         {GLFW_KEY_PAGE_DOWN, Key::kPageDown},
                                         {GLFW_KEY_HOME, Key::kHome},
                                         {GLFW_KEY_END, Key::kEnd},
                                         {GLFW_KEY_INSERT, Key::kInsert},
                                         {GLFW_KEY_DELETE, Key::kDelete},
                                         {GLFW_KEY_BACKSPACE, Key::kBackspace},
                                         {GLFW_KEY_SPACE, Key::kSpace},
                                         {GLFW_KEY_ENTER, Key::kEnter},
                                         {GLFW_KEY_ESCAPE, Key::kEscape},
                                         {GLFW_KEY_APOSTROPHE, Key::kApostrophe},
                                         {GLFW_KEY_COMMA, Key::kComma},
                                         {GLFW_KEY_MINUS, Key::kMinus},
                                         {GLFW_KEY_PERIOD, Key::kPeriod},
                                         {GLFW_KEY_SLASH, Key::kSlash},
                                         {GLFW_KEY_SEMICOLON, Key::kSemicolon},
                                         {GLFW_KEY_EQUAL, Key::kEqual},
                                         {GLFW_KEY_LEFT_BRACKET, Key::kLeftBracket},
                                         {GLFW_KEY_BACKSLASH, Key::kBackslash},
                                         {GLFW_KEY_RIGHT_BRACKET, Key::kRightBracket},
                                         {GLFW_KEY_GRAVE_ACCENT, Key::kGrave},
                                         {GLFW_KEY_KP_ENTER, Key::kKeypadEnter},
                                         {GLFW_KEY_KP_ADD, Key::kKeypadAdd},
                                         {GLFW_KEY_KP_SUBTRACT, Key::kKeypadSubtract},
                                         {GLFW_KEY_LEFT_SHIFT, Key::kLeftShift},
                                         {GLFW_KEY_RIGHT_SHIFT, Key::kRightShift},
                                         {GLFW_KEY_LEFT_CONTROL, Key::kLeftControl},
                                         {GLFW_KEY_RIGHT_CONTROL, Key::kRightControl},
                                         {GLFW_KEY_LEFT_ALT, Key::kLeftAlt},
                                         {GLFW_KEY_RIGHT_ALT, Key::kRightAlt},
                                         {GLFW_KEY_LEFT_SUPER, Key::kLeftSuper},
                                         {GLFW_KEY_RIGHT_SUPER, Key::kRightSuper}};

Key offset(Key first, int count) {
  return static_cast<Key>(static_cast<int>(first) + count);
}

}  // namespace

std::optional<Key> keyFromGlfw(int key) {
  if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z) return offset(Key::kA, key - GLFW_KEY_A);
  if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return offset(Key::k0, key - GLFW_KEY_0);
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return offset(Key::kF1, key - GLFW_KEY_F1);
  for (const auto& [theirs, ours] : kKeys)
    if (theirs == key) return ours;
  return std::nullopt;
}

std::optional<MouseButton> buttonFromGlfw(int button) {
  switch (button) {
    case GLFW_MOUSE_BUTTON_LEFT:
      return MouseButton::kLeft;
    case GLFW_MOUSE_BUTTON_RIGHT:
      return MouseButton::kRight;
    case GLFW_MOUSE_BUTTON_MIDDLE:
      return MouseButton::kMiddle;
    default:
      return std::nullopt;
  }
}

}  // namespace cellcut
