#include "ui/viewer/convergence.h"

#include "renderer/base/exact_number.h"
#include "renderer/measure/metrics.h"
#include "renderer/trace/worker_pool.h"
#include "ui/viewer/is_ready.h"

#include <cmath>

namespace cellcut {
namespace {

/// Samples per pixel from point to point, relative: twenty points per two decades.
constexpr double kStep = 1.25;
/// The same for FLIP, which takes longer.
constexpr double kFlipStep = 2;
/// After the driver and the UI.
constexpr int kNiceness = 15;

}  // namespace

void Convergence::restart(std::string name) {
  run_ = {std::move(name), {}};
  flipPasses_ = 0;
  ++number_;
}

void Convergence::offer(const std::shared_ptr<const Snapshot>& s, std::shared_ptr<const ImageRgb> reference,
                        bool last) {
  if (busy() || s->preview || s->passes <= measured()) return;
  const auto passes = static_cast<double>(s->passes);
  if (!last && passes < kStep * static_cast<double>(measured())) return;
  const bool flip = last || passes >= kFlipStep * static_cast<double>(flipPasses_);
  if (flip) flipPasses_ = s->passes;
  pendingNumber_ = number_;
  pending_ = std::async(std::launch::async, [s, reference = std::move(reference), flip] {
    setThreadNiceness(kNiceness);
    const ImageComparison c = compareImagesOnThisThread(*s->radiance, *reference, flip);
    return ConvergencePoint{s->seconds, s->passes, c.mse, c.relmse, c.flip};
  });
}

void Convergence::update() {
  if (!isReady(pending_)) return;
  const ConvergencePoint point = pending_.get();
  if (pendingNumber_ == number_) run_.points.push_back(point);
}

std::optional<double> efficiencyRatio(const ConvergenceRun& a, const ConvergenceRun& b) {
  if (a.points.empty() || b.points.empty()) return std::nullopt;
  const ConvergencePoint &p = a.points.back(), &q = b.points.back();
  const double other = q.relmse * q.seconds;
  if (!(other > 0)) return std::nullopt;
  return p.relmse * p.seconds / other;
}

std::string toCsv(std::span<const ConvergenceRun> runs) {
  std::string text = "run,spp,seconds,mse,relmse,flip\n";
  for (const ConvergenceRun& run : runs) {
    for (const ConvergencePoint& p : run.points) {
      text += run.name + ',' + std::to_string(p.passes) + ',' + exactNumber(p.seconds) + ',' + exactNumber(p.mse) +
              ',' + exactNumber(p.relmse) + ',' + (std::isnan(p.flip) ? "" : exactNumber(p.flip)) + '\n';
    }
  }
  return text;
}

}  // namespace cellcut
