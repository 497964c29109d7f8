#include "ui/viewer/duel.h"

#include <algorithm>
#include <cmath>

namespace cellcut {
namespace {

/// Seconds of a turn: long enough that a frame between two turns costs little, short enough to be fair to look at.
constexpr double kTurnSeconds = 0.25;
constexpr double kMostSteps = 1000;

std::uint64_t stepsOf(const Snapshot& s) {
  if (s.passes == 0 || !(s.seconds > 0)) return 1;
  const double perPass = s.seconds / static_cast<double>(s.passes);
  return static_cast<std::uint64_t>(std::clamp(std::floor(kTurnSeconds / perPass), 1.0, kMostSteps));
}

}  // namespace

SessionInput Duel::edit(const SessionInput& input, Strategy second) {
  SessionInput both = input;
  both.paused = true;
  both.passLimit.reset();  // equal passes or equal noise are no equal time
  both.noiseLimit.reset();
  both.timeLimit.reset();  // looked at by drive(), for a session past its limit takes no steps
  timeLimit_ = input.timeLimit;
  turn_.reset();
  finished_ = false;
  SessionInput other = both;
  other.settings.strategy = second;
  generation_ = second_.edit(std::move(other));
  return both;
}

void Duel::drive(RenderSession& first, std::uint64_t generation) {
  const std::shared_ptr<const Snapshot> a = first.snapshot(), b = second_.snapshot();
  if (a->generation < generation || b->generation < generation_) return;
  const auto passesOf = [](const Snapshot& s) { return s.preview ? 0 : s.passes; };
  const auto secondsOf = [](const Snapshot& s) { return s.preview ? 0.0 : s.seconds; };
  if (turn_ && passesOf(turn_->second ? *b : *a) < turn_->passes) return;
  turn_.reset();
  const bool second = secondsOf(*b) < secondsOf(*a);
  // The first one may have had more before the duel began.
  finished_ = timeLimit_ && !second && secondsOf(*a) >= *timeLimit_;
  if (finished_) return;
  const Snapshot& next = second ? *b : *a;
  const std::uint64_t steps = next.preview ? 1 : stepsOf(next);
  turn_ = Turn{second, passesOf(next) + steps};
  for (std::uint64_t i = 0; i < steps; ++i) (second ? second_ : first).singleStep();
}

}  // namespace cellcut
