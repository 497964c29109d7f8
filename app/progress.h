/// \file progress.h
/// What a person sees while a picture is rendered.
#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>

namespace cellcut {

struct ProgressState {
  double doneShare = 0;      ///< [0, 1]
  std::uint64_t passes = 0;  ///< samples per pixel so far
  double seconds = 0;        ///< since the first pass began
  double raysPerSecond = 0;
};

/// Seconds that are left if the rest goes as the beginning did; none before anything is done.
std::optional<double> remainingSeconds(const ProgressState& state);

/// 0 … 59.9 s, then minutes, then hours: "3.2 s", "4 min 05 s", "2 h 10 min".
std::string formatDuration(double seconds);

/// "12 spp, 3.2 s, about 13.6 s left, 4.20 Mray/s"
std::string formatProgress(const ProgressState& state);

/// Between two drawings of a line on a terminal.
inline constexpr double kTerminalInterval = 0.1;  // s

/// Draws over the line of a terminal; elsewhere a line of its own.
void drawLine(std::ostream& stream, bool terminal, const std::string& text);

/// On a terminal one line with a bar, redrawn at most ten times a second; elsewhere (a log) a line every two seconds at
/// most. Either way the last state is shown by finish().
class Progress {
 public:
  Progress(std::ostream& stream, bool terminal) : stream_(stream), terminal_(terminal) {}

  void update(const ProgressState& state);
  void finish(const ProgressState& state);

 private:
  void draw(const ProgressState& state);

  std::ostream& stream_;
  bool terminal_;
  std::optional<double> lastDrawn_;  ///< ProgressState::seconds of the last line
};

}  // namespace cellcut
