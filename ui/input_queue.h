/// \file input_queue.h
/// Deals input out to frames so that none is lost: a key that goes down and up within one slow frame takes two frames.
///
/// ImGui 1.86 knows only the state at the start of a frame; 1.87 and later do this themselves, but not the same from
/// version to version, so ours is used with all. Source of the rules: ImGui 1.87, UpdateInputEvents.
#pragma once

#include "ui/input_event.h"

#include <deque>
#include <span>
#include <vector>

namespace cellcut {

class InputQueue {
 public:
  void push(std::span<const InputEvent> events);

  /// The longest run of events from the front whose order can be told from what they leave behind:
  ///   a button, or a key, changes once;
  ///   keys go down or up, not both, so that Ctrl+C is seen as such;
  ///   the pointer moves before everything else; the wheel and the buttons take turns;
  ///   keys change before buttons and before text; text never comes with buttons, nor with a key that edits text
  ///   (Enter, Backspace, arrows …);
  ///   losing the focus comes last.
  /// Not empty unless the queue is.
  std::vector<InputEvent> takeFrame();

  bool empty() const { return events_.empty(); }

 private:
  std::deque<InputEvent> events_;
};

}  // namespace cellcut
