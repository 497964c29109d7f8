/// \file duel.h
/// Two strategies on one view, each in its turn, so that both have had the same seconds.
///
/// The first one is the viewer's session, paused and driven step by step; the second one has a session of its own.
/// Threads: one (the UI's).
#pragma once

#include "renderer/trace/session.h"

#include <memory>
#include <optional>

namespace cellcut {

class Duel {
 public:
  /// \param wake  as RenderSession's
  explicit Duel(std::function<void()> wake) : second_(std::move(wake)) {}

  /// The same for both but for the strategy. Steps under way are dropped. Returns what the first one is to render.
  SessionInput edit(const SessionInput& input, Strategy second);
  /// Gives the next steps to whoever has had less time, when nobody is at it. To be called in each frame.
  /// \param generation  of the first one's newest edit
  void drive(RenderSession& first, std::uint64_t generation);
  std::shared_ptr<const Snapshot> second() const { return second_.snapshot(); }
  /// Of the second one's newest edit.
  std::uint64_t generation() const { return generation_; }
  /// Both have reached the limit on the time, and the second one the time of the first.
  bool finished() const { return finished_; }

 private:
  struct Turn {
    bool second;
    std::uint64_t passes;  ///< that its snapshot has then
  };

  std::uint64_t generation_ = 0;  ///< of the second one's newest edit
  std::optional<double> timeLimit_;
  std::optional<Turn> turn_;
  bool finished_ = false;
  RenderSession second_;
};

}  // namespace cellcut
