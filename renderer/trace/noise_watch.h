/// \file noise_watch.h
/// Looks at a rendering's noise now and then, for a limit on it.
#pragma once

#include "renderer/trace/film.h"
#include "renderer/trace/noise.h"

#include <deque>
#include <limits>

namespace cellcut {

/// After passes 16, 20, 25, 32, 40, 50, 64 …: who looks after every pass stops at the first one that happens to look
/// good. Keeps 72 bytes per pixel from pass 8 on.
class NoiseWatch {
 public:
  /// To be called after every pass, once or more often; whether noise() is new. One that begins in the middle knows
  /// nothing until it has met half of the passes.
  bool look(const Film& film);

  /// Of the last look; infinite before the first.
  const NoiseEstimate& noise() const { return noise_; }

 private:
  static constexpr double kUnknown = std::numeric_limits<double>::infinity();
  std::deque<FilmState> earlier_;  ///< the last looks, up to one with half of the passes
  NoiseEstimate noise_{kUnknown, kUnknown};
};

}  // namespace cellcut
