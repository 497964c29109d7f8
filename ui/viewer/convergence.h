/// \file convergence.h
/// Errors of a rendering against a reference as it goes on, measured on a thread of their own.
#pragma once

#include "renderer/trace/snapshot.h"

#include <future>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace cellcut {

struct ConvergencePoint {
  double seconds;  ///< of rendering
  std::uint64_t passes;
  double mse, relmse;
  double flip;  ///< NaN where it was not measured: it takes as long as a pass
};

struct ConvergenceRun {
  std::string name;
  std::vector<ConvergencePoint> points;
};

/// One rendering at a time. Threads: one (the UI's).
class Convergence {
 public:
  /// Another rendering: its run is empty.
  void restart(std::string name);
  /// Measures a snapshot unless one is being measured or it has hardly more samples than the last.
  /// \param last  there will be no further ones: measure it anyway
  /// \pre both pictures have one size
  void offer(const std::shared_ptr<const Snapshot>& snapshot, std::shared_ptr<const ImageRgb> reference, bool last);
  /// Collects what was measured meanwhile.
  void update();
  bool busy() const { return pending_.valid(); }
  const ConvergenceRun& run() const { return run_; }
  /// The samples that the newest point is of; 0: there is none.
  std::uint64_t measured() const { return run_.points.empty() ? 0 : run_.points.back().passes; }

 private:
  ConvergenceRun run_;
  std::uint64_t flipPasses_ = 0;  ///< of the newest point with FLIP
  std::uint64_t number_ = 0;      ///< of the run
  std::uint64_t pendingNumber_ = 0;
  std::future<ConvergencePoint> pending_;
};

/// relMSE × seconds of a over that of b, at the newest point of each: below 1 a is the better one. Nothing before both
/// have a point.
std::optional<double> efficiencyRatio(const ConvergenceRun& a, const ConvergenceRun& b);

/// "run,spp,seconds,mse,relmse,flip" and a line per point; what was not measured is empty.
std::string toCsv(std::span<const ConvergenceRun> runs);

}  // namespace cellcut
