/// \file trade.h
/// What other settings of a strategy's cuts would cost and give on the view that is shown: trials beside the picture.
#pragma once

#include "renderer/measure/quality_choice.h"
#include "renderer/trace/session_input.h"

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cellcut {

/// Seconds of a rendering that the trials are made for: they take up to kTrialShare of it, and spread the time for cells
/// over it.
inline constexpr double kTradeLength = 240;

/// What the trials said.
struct Trade {
  SessionInput input;                ///< that they were made of
  std::vector<QualityTrial> trials;  ///< the settings of the input first; others than presets have no name
  std::size_t best = 0;              ///< the first one unless another is better beyond doubt

  /// Whether it says something about a rendering of that input: another view is taken to be alike.
  bool fits(const SessionInput& rendered) const;
};

/// The settings, the presets, and the settings with each of them alone made smaller and larger.
std::vector<Quality> tradeCandidates(const RenderSettings& settings);

/// Tries settings with threads and structures of its own, while a session goes on with its picture at a part of its speed.
/// Threads: one (the UI's).
class TradeTrials {
 public:
  /// \param wake  as RenderSession's
  explicit TradeTrials(std::function<void()> wake) : wake_(std::move(wake)) {}
  ~TradeTrials() { stop(); }

  /// What was under way is stopped.
  void start(const SessionInput& input);
  void stop();
  bool busy() const { return made_.valid(); }
  /// When it is done.
  std::optional<Trade> take();
  /// What went wrong, for a person; told once.
  std::string takeProblem() { return std::exchange(problem_, {}); }

 private:
  std::function<void()> wake_;
  std::shared_ptr<std::atomic<bool>> cancel_;
  std::future<Trade> made_;
  std::vector<std::future<Trade>> ending_;  ///< may be building structures still
  std::string problem_;
};

}  // namespace cellcut
