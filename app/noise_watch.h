/// \file noise_watch.h
/// Looks at a rendering's noise now and then, for a limit on it.
#pragma once

#include "renderer/measure/noise.h"
#include "renderer/trace/film.h"

#include <deque>
#include <limits>

namespace cellcut {

/// After passes 16, 20, 25, 32, 40, 50, 64 …: who looks after every pass stops at the first one that happens to look good.
class NoiseWatch {
 public:
  /// To be called after every pass.
  void look(const Film& film);

  /// Of the last look; infinite before the first.
  const NoiseEstimate& noise() const { return noise_; }

 private:
  static constexpr double kUnknown = std::numeric_limits<double>::infinity();
  std::deque<FilmState> earlier_;  ///< the last three looks: the oldest has half of the passes
  NoiseEstimate noise_{kUnknown, kUnknown};
};

}  // namespace cellcut
