#include "ui/input_queue.h"

#include <bitset>

namespace cellcut {

namespace {

bool editsText(Key key) {
  switch (key) {
    case Key::kTab:
    case Key::kLeft:
    case Key::kRight:
    case Key::kUp:
    case Key::kDown:
    case Key::kPageUp:
    case Key::kPageDown:
    case Key::kHome:
    case Key::kEnd:
    case Key::kInsert:
    case Key::kDelete:
    case Key::kBackspace:
    case Key::kEnter:
    case Key::kKeypadEnter:
    case Key::kEscape:
      return true;
    default:
      return false;
  }
}

/// What a frame has been dealt so far; each member says whether the event may join and, if so, notes it.
class Run {
 public:
  bool accept(const MouseMove&) { return acceptPointer(); }
  bool accept(const MouseLeave&) { return acceptPointer(); }

  bool accept(const MouseButtonChange& change) {
    const auto button = static_cast<std::size_t>(change.button);
    if (lostFocus_ || text_ || wheel_ || buttons_[button]) return false;
    buttons_.set(button);
    return true;
  }

  bool accept(const Scroll&) {
    if (lostFocus_ || text_ || buttons_.any()) return false;
    wheel_ = true;
    return true;
  }

  bool accept(const KeyChange& change) {
    const auto key = static_cast<std::size_t>(change.key);
    if (lostFocus_ || text_ || buttons_.any() || keys_[key] || (keys_.any() && keysGoDown_ != change.down))
      return false;
    keys_.set(key);
    keysGoDown_ = change.down;
    edits_ = edits_ || editsText(change.key);
    return true;
  }

  bool accept(const TextInput&) {
    if (lostFocus_ || edits_ || buttons_.any()) return false;
    text_ = true;
    return true;
  }

  bool accept(const FocusChange& change) {
    if (lostFocus_) return false;
    lostFocus_ = !change.focused;
    return true;
  }

 private:
  bool acceptPointer() const { return !lostFocus_ && !text_ && !wheel_ && buttons_.none() && keys_.none(); }

  std::bitset<kMouseButtonCount> buttons_;
  std::bitset<kKeyCount> keys_;
  bool keysGoDown_ = false;
  bool edits_ = false;
  bool wheel_ = false;
  bool text_ = false;
  bool lostFocus_ = false;
};

}  // namespace

void InputQueue::push(std::span<const InputEvent> events) {
  events_.insert(events_.end(), events.begin(), events.end());
}

std::vector<InputEvent> InputQueue::takeFrame() {
  std::vector<InputEvent> frame;
  Run run;
  while (!events_.empty() && std::visit([&run](const auto& event) { return run.accept(event); }, events_.front())) {
    frame.push_back(events_.front());
    events_.pop_front();
  }
  return frame;
}

}  // namespace cellcut
