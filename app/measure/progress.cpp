#include "app/measure/progress.h"

#include "app/progress.h"

#include <algorithm>

namespace cellcut {
namespace {

constexpr double kMeasureLogInterval = 30;  // s

}  // namespace

std::string MeasureProgress::left(double done) const {
  const auto remaining = remainingSeconds({.doneShare = std::min(1.0, done / expected_), .seconds = watch_.seconds()});
  return remaining && *remaining > 0 ? "; about " + formatDuration(*remaining) + " left" : "";
}

void MeasureProgress::update(const std::string& label, double share, double seconds) {
  const double interval = terminal_ ? kTerminalInterval : kMeasureLogInterval;
  if (watch_.seconds() < drawn_ + interval) return;
  draw(label + left(done_ + std::clamp(share, 0.0, 1.0) * seconds));
}

void MeasureProgress::finish(const std::string& label, double seconds) {
  done_ += seconds;
  draw(label + left(done_));
  if (terminal_) stream_ << '\n';
}

void MeasureProgress::draw(const std::string& text) {
  drawLine(stream_, terminal_, text);
  drawn_ = watch_.seconds();
}

}  // namespace cellcut
