#include "ui/input_queue.h"

#include <gtest/gtest.h>

namespace cellcut {
namespace {

constexpr MouseMove kHere{Vec2(1, 2)};
constexpr MouseMove kThere{Vec2(3, 4)};
constexpr MouseButtonChange kPress{MouseButton::kLeft, true};
constexpr MouseButtonChange kRelease{MouseButton::kLeft, false};
constexpr MouseButtonChange kRightPress{MouseButton::kRight, true};
constexpr Scroll kWheel{Vec2(0, 1)};

KeyChange down(Key key) {
  return {key, true};
}
KeyChange up(Key key) {
  return {key, false};
}
TextInput text(char32_t character) {
  return {character};
}

using FrameEvents = std::vector<InputEvent>;

/// The frames that a burst of input is dealt out to.
std::vector<FrameEvents> dealt(const FrameEvents& events) {
  InputQueue queue;
  queue.push(events);
  std::vector<FrameEvents> frames;
  while (!queue.empty()) frames.push_back(queue.takeFrame());
  return frames;
}
using Frames = std::vector<FrameEvents>;

TEST(InputQueue, NothingGivesNoFrame) {
  InputQueue queue;
  EXPECT_TRUE(queue.empty());
  EXPECT_TRUE(queue.takeFrame().empty());
}

TEST(InputQueue, AKeyPressedAndReleasedTakesTwoFrames) {
  EXPECT_EQ(dealt({down(Key::kF2), up(Key::kF2)}), (Frames{{down(Key::kF2)}, {up(Key::kF2)}}));
}

TEST(InputQueue, AClickTakesTwoFramesAndADoubleClickFour) {
  EXPECT_EQ(dealt({kHere, kPress, kRelease}), (Frames{{kHere, kPress}, {kRelease}}));
  EXPECT_EQ(dealt({kPress, kRelease, kPress, kRelease}), (Frames{{kPress}, {kRelease}, {kPress}, {kRelease}}));
}

TEST(InputQueue, MovesFlowTogetherUntilAButtonChanges) {
  EXPECT_EQ(dealt({kHere, kThere, kHere}), (Frames{{kHere, kThere, kHere}}));
  EXPECT_EQ(dealt({kHere, kPress, kThere, kRelease}), (Frames{{kHere, kPress}, {kThere, kRelease}}));
}

TEST(InputQueue, DifferentButtonsShareAFrame) {
  EXPECT_EQ(dealt({kPress, kRightPress}), (Frames{{kPress, kRightPress}}));
}

TEST(InputQueue, AShortcutIsSeenWithItsModifierDown) {
  EXPECT_EQ(dealt({down(Key::kLeftControl), down(Key::kC), up(Key::kC), up(Key::kLeftControl)}),
            (Frames{{down(Key::kLeftControl), down(Key::kC)}, {up(Key::kC), up(Key::kLeftControl)}}));
  // A fast hand lets the modifier go first.
  EXPECT_EQ(dealt({down(Key::kC), up(Key::kLeftControl)}), (Frames{{down(Key::kC)}, {up(Key::kLeftControl)}}));
}

TEST(InputQueue, AModifierJoinsTheClickThatFollows) {
  EXPECT_EQ(dealt({down(Key::kLeftControl), kPress}), (Frames{{down(Key::kLeftControl), kPress}}));
  EXPECT_EQ(dealt({kPress, up(Key::kLeftControl)}), (Frames{{kPress}, {up(Key::kLeftControl)}}));
}

TEST(InputQueue, TheWheelAndTheButtonsTakeTurns) {
  EXPECT_EQ(dealt({kHere, kWheel, kWheel, kPress, kWheel}), (Frames{{kHere, kWheel, kWheel}, {kPress}, {kWheel}}));
  EXPECT_EQ(dealt({kWheel, kHere}), (Frames{{kWheel}, {kHere}}));
}

TEST(InputQueue, TypingKeepsItsOrder) {
  EXPECT_EQ(dealt({down(Key::kA), text('a'), text('b'), up(Key::kA)}),
            (Frames{{down(Key::kA), text('a'), text('b')}, {up(Key::kA)}}));
  // "a", deleted, "b": ImGui would insert both before it deletes.
  EXPECT_EQ(dealt({text('a'), down(Key::kBackspace), text('b')}),
            (Frames{{text('a')}, {down(Key::kBackspace)}, {text('b')}}));
  EXPECT_EQ(dealt({kPress, text('a')}), (Frames{{kPress}, {text('a')}}));
}

TEST(InputQueue, LosingTheFocusEndsAFrame) {
  EXPECT_EQ(dealt({down(Key::kW), FocusChange{false}, FocusChange{true}, down(Key::kW)}),
            (Frames{{down(Key::kW), FocusChange{false}}, {FocusChange{true}, down(Key::kW)}}));
}

TEST(InputQueue, LaterEventsWaitBehindEarlierOnes) {
  InputQueue queue;
  queue.push(FrameEvents{kPress, kRelease});
  EXPECT_EQ(queue.takeFrame(), FrameEvents{kPress});
  queue.push(FrameEvents{kHere});
  EXPECT_EQ(queue.takeFrame(), FrameEvents{kRelease});
  EXPECT_EQ(queue.takeFrame(), FrameEvents{kHere});
  EXPECT_TRUE(queue.empty());
}

TEST(KeyNames, GoThereAndBack) {
  for (int i = 0; i < kKeyCount; ++i) EXPECT_EQ(keyFromName(keyName(static_cast<Key>(i))), static_cast<Key>(i));
  EXPECT_EQ(keyName(Key::kF12), "F12");
  EXPECT_EQ(keyName(Key::kPageDown), "PageDown");
  EXPECT_EQ(keyFromName("space"), Key::kSpace);
  EXPECT_EQ(keyFromName("Ctrl"), Key::kLeftControl);
  EXPECT_EQ(keyFromName("Hyper"), std::nullopt);
  EXPECT_EQ(keyFromName(""), std::nullopt);
}

}  // namespace
}  // namespace cellcut
