#include "app/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cellcut {
namespace {

constexpr double kLogInterval = 2;  // s
constexpr int kBarWidth = 24;       // with the numbers behind it the line stays under 80 columns

/// printf into a string; every text here is far shorter than the buffer.
template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[96];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

std::string bar(double share) {
  std::string text = "[" + std::string(kBarWidth, '.') + "] ";
  std::fill_n(text.begin() + 1, static_cast<int>(share * kBarWidth), '#');
  return text;
}

}  // namespace

std::optional<double> remainingSeconds(const ProgressState& state) {
  if (!(state.doneShare > 0)) return std::nullopt;
  return state.seconds * (1 - state.doneShare) / state.doneShare;
}

std::string formatDuration(double seconds) {
  if (!(seconds < 1e9)) return "very long";  // also what is left at a share of nearly nothing
  if (seconds < 59.95) return format("%.1f s", seconds);
  const long long whole = std::llround(seconds);
  if (whole < 3600) return format("%lld min %02lld s", whole / 60, whole % 60);
  return format("%lld h %02lld min", whole / 3600, whole % 3600 / 60);
}

std::string formatProgress(const ProgressState& state) {
  std::string text = std::to_string(state.passes) + " spp, " + formatDuration(state.seconds);
  const auto remaining = remainingSeconds(state);
  if (remaining && *remaining > 0) text += ", about " + formatDuration(*remaining) + " left";
  return text + format(", %.2f Mray/s", state.raysPerSecond * 1e-6);
}

void drawLine(std::ostream& stream, bool terminal, const std::string& text) {
  constexpr const char* kToLineStart = "\r\x1b[K";  // ECMA-48 EL: the old line may be longer than the new one
  if (terminal) {
    stream << kToLineStart << text << std::flush;
  } else {
    stream << text << std::endl;
  }
}

void Progress::update(const ProgressState& state) {
  const double interval = terminal_ ? kTerminalInterval : kLogInterval;
  if (lastDrawn_.value_or(0) + interval > state.seconds) return;
  draw(state);
}

void Progress::finish(const ProgressState& state) {
  draw(state);
  if (terminal_) stream_ << '\n';
}

void Progress::draw(const ProgressState& state) {
  drawLine(stream_, terminal_, (terminal_ ? bar(state.doneShare) : "") + formatProgress(state));
  lastDrawn_ = state.seconds;
}

}  // namespace cellcut
