/// \file stop_rule.h
/// When a rendering is done.
#pragma once

#include "renderer/trace/render_settings.h"

#include <cstdint>

namespace cellcut {

/// Exactly one limit counts, the one that `kind` names.
struct StopRule {
  enum class Kind : std::uint8_t { kPasses, kSeconds, kNoise };
  Kind kind = Kind::kPasses;
  std::uint64_t passes = 64;  ///< samples per pixel, ≥ 1
  double seconds = 0;         ///< of rendering, > 0
  double noise = 0;           ///< √relMSE, > 0
};

/// How far a rendering is, after a whole pass.
struct RenderState {
  std::uint64_t passes = 0;
  double seconds = 0;        ///< since the first pass began
  double relativeError = 0;  ///< NoiseEstimate::bound of a NoiseWatch; only looked at where needsNoise() says so
};

/// Whether the rule wants RenderState::relativeError after `passes` passes.
bool needsNoise(const StopRule& rule, std::uint64_t passes);

/// True when nothing is left to do. A picture without any light in it has an undefined relative error and is done.
bool isReached(const StopRule& rule, const RenderState& state);

/// Share of the work that is done, in [0, 1]: passes and seconds by count, noise by the passes that it will take if the
/// error falls with the square root of their number.
double doneShare(const StopRule& rule, const RenderState& state);

}  // namespace cellcut
