#include "ui/gui_input.h"

#include <cfloat>
#include <utility>

#include <imgui.h>

namespace cellcut {

namespace {

/// Keys that every version names alike.
constexpr std::pair<Key, int> kEditingKeys[] = {
    {Key::kTab, ImGuiKey_Tab},           {Key::kLeft, ImGuiKey_LeftArrow}, {Key::kRight, ImGuiKey_RightArrow},
    {Key::kUp, ImGuiKey_UpArrow},        {Key::kDown, ImGuiKey_DownArrow}, {Key::kPageUp, ImGuiKey_PageUp},
    {Key::kPageDown, ImGuiKey_PageDown}, {Key::kHome, ImGuiKey_Home},      {Key::kEnd, ImGuiKey_End},
    {Key::kInsert, ImGuiKey_Insert},     {Key::kDelete, ImGuiKey_Delete},  {Key::kBackspace, ImGuiKey_Backspace},
    {Key::kSpace, ImGuiKey_Space},       {Key::kEnter, ImGuiKey_Enter},    {Key::kEscape, ImGuiKey_Escape}};

#if IMGUI_VERSION_NUM >= 18900

constexpr std::pair<Key, int> kOtherKeys[] = {
    {Key::kApostrophe, ImGuiKey_Apostrophe}, {Key::kComma, ImGuiKey_Comma},
    {Key::kMinus, ImGuiKey_Minus},           {Key::kPeriod, ImGuiKey_Period},
    {Key::kSlash, ImGuiKey_Slash},           {Key::kSemicolon, ImGuiKey_Semicolon},
    {Key::kEqual, ImGuiKey_Equal},           {Key::kLeftBracket, ImGuiKey_LeftBracket},
    {Key::kBackslash, ImGuiKey_Backslash},   {Key::kRightBracket, ImGuiKey_RightBracket},
    {Key::kGrave, ImGuiKey_GraveAccent},     {Key::kKeypadEnter, ImGuiKey_KeypadEnter},
    {Key::kKeypadAdd, ImGuiKey_KeypadAdd},   {Key::kKeypadSubtract, ImGuiKey_KeypadSubtract},
    {Key::kLeftShift, ImGuiKey_LeftShift},   {Key::kRightShift, ImGuiKey_RightShift},
    {Key::kLeftControl, ImGuiKey_LeftCtrl},  {Key::kRightControl, ImGuiKey_RightCtrl},
    {Key::kLeftAlt, ImGuiKey_LeftAlt},       {Key::kRightAlt, ImGuiKey_RightAlt},
    {Key::kLeftSuper, ImGuiKey_LeftSuper},   {Key::kRightSuper, ImGuiKey_RightSuper}};

ImGuiKey imguiKey(Key key) {
  const auto offset = [key](ImGuiKey first, Key ours) {
    return static_cast<ImGuiKey>(first + (static_cast<int>(key) - static_cast<int>(ours)));
  };
  if (key >= Key::kA && key <= Key::kZ) return offset(ImGuiKey_A, Key::kA);
  if (key >= Key::k0 && key <= Key::k9) return offset(ImGuiKey_0, Key::k0);
  if (key >= Key::kF1 && key <= Key::kF12) return offset(ImGuiKey_F1, Key::kF1);
  for (const auto& [ours, theirs] : kEditingKeys)
    if (ours == key) return static_cast<ImGuiKey>(theirs);
  for (const auto& [ours, theirs] : kOtherKeys)
    if (ours == key) return static_cast<ImGuiKey>(theirs);
  return ImGuiKey_None;
}

void nameKeys(ImGuiIO& io) {
  io.ConfigInputTrickleEventQueue = false;
}  // InputQueue does it

/// ImGui passes over what it knows already.
void publish(ImGuiIO& io, const std::bitset<kKeyCount>& keys, const std::bitset<kMouseButtonCount>& buttons,
             const Vec2& pointer) {
  const auto eitherDown = [&keys](Key left, Key right) {
    return keys[static_cast<std::size_t>(left)] || keys[static_cast<std::size_t>(right)];
  };
  io.AddMousePosEvent(pointer.x, pointer.y);
  io.AddKeyEvent(ImGuiMod_Ctrl, eitherDown(Key::kLeftControl, Key::kRightControl));
  io.AddKeyEvent(ImGuiMod_Shift, eitherDown(Key::kLeftShift, Key::kRightShift));
  io.AddKeyEvent(ImGuiMod_Alt, eitherDown(Key::kLeftAlt, Key::kRightAlt));
  io.AddKeyEvent(ImGuiMod_Super, eitherDown(Key::kLeftSuper, Key::kRightSuper));
  for (int i = 0; i < kKeyCount; ++i) io.AddKeyEvent(imguiKey(static_cast<Key>(i)), keys[static_cast<std::size_t>(i)]);
  for (int i = 0; i < kMouseButtonCount; ++i) io.AddMouseButtonEvent(i, buttons[static_cast<std::size_t>(i)]);
}

void addWheel(ImGuiIO& io, const Vec2& notches) {
  io.AddMouseWheelEvent(notches.x, notches.y);
}

#else

/// ImGui is told by our own numbers; those that it acts on itself are named to it.
int imguiKey(Key key) {
  return static_cast<int>(key);
}

void nameKeys(ImGuiIO& io) {
  for (const auto& [ours, theirs] : kEditingKeys) io.KeyMap[theirs] = imguiKey(ours);
  io.KeyMap[ImGuiKey_KeyPadEnter] = imguiKey(Key::kKeypadEnter);
  io.KeyMap[ImGuiKey_A] = imguiKey(Key::kA);
  io.KeyMap[ImGuiKey_C] = imguiKey(Key::kC);
  io.KeyMap[ImGuiKey_V] = imguiKey(Key::kV);
  io.KeyMap[ImGuiKey_X] = imguiKey(Key::kX);
  io.KeyMap[ImGuiKey_Y] = imguiKey(Key::kY);
  io.KeyMap[ImGuiKey_Z] = imguiKey(Key::kZ);
}

void publish(ImGuiIO& io, const std::bitset<kKeyCount>& keys, const std::bitset<kMouseButtonCount>& buttons,
             const Vec2& pointer) {
  const auto eitherDown = [&keys](Key left, Key right) {
    return keys[static_cast<std::size_t>(left)] || keys[static_cast<std::size_t>(right)];
  };
  io.MousePos = ImVec2(pointer.x, pointer.y);
  io.KeyCtrl = eitherDown(Key::kLeftControl, Key::kRightControl);
  io.KeyShift = eitherDown(Key::kLeftShift, Key::kRightShift);
  io.KeyAlt = eitherDown(Key::kLeftAlt, Key::kRightAlt);
  io.KeySuper = eitherDown(Key::kLeftSuper, Key::kRightSuper);
  for (std::size_t i = 0; i < keys.size(); ++i) io.KeysDown[i] = keys[i];
  for (std::size_t i = 0; i < buttons.size(); ++i) io.MouseDown[i] = buttons[i];
}

void addWheel(ImGuiIO& io, const Vec2& notches) {
  io.MouseWheelH += notches.x;
  io.MouseWheel += notches.y;
}

#endif

constexpr Vec2 kNowhere{-FLT_MAX};  // ImGui's sign for no pointer

template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

}  // namespace

GuiInput::GuiInput(ImGuiIO& io) : pointer_(kNowhere) {
  nameKeys(io);
}

void GuiInput::feed(ImGuiIO& io, std::span<const InputEvent> events) {
  for (const InputEvent& event : events) apply(io, event);
  publish(io, keys_, buttons_, pointer_);
}

void GuiInput::apply(ImGuiIO& io, const InputEvent& event) {
  std::visit(Overloaded{[&](const MouseMove& move) { pointer_ = move.position; },
                        [&](const MouseLeave&) {
                          if (buttons_.none()) pointer_ = kNowhere;  // a drag may leave the window and return
                        },
                        [&](const MouseButtonChange& change) {
                          buttons_[static_cast<std::size_t>(change.button)] = change.down;
                        },
                        [&](const Scroll& scroll) { addWheel(io, scroll.notches); },
                        [&](const KeyChange& change) { keys_[static_cast<std::size_t>(change.key)] = change.down; },
                        [&](const TextInput& text) { io.AddInputCharacter(static_cast<unsigned>(text.character)); },
                        [&](const FocusChange& change) {
                          if (change.focused) return;
                          keys_.reset();
                          buttons_.reset();
                        }},
             event);
}

bool guiKeyDown(Key key) {
  return ImGui::IsKeyDown(imguiKey(key));
}
bool guiKeyPressed(Key key, bool repeat) {
  return ImGui::IsKeyPressed(imguiKey(key), repeat);
}

}  // namespace cellcut
