/// \file quality_choice.h
/// Settings for a scene, chosen by trying a few on it: `--quality auto`.
#pragma once

#include "renderer/measure/quality_trials.h"
#include "renderer/trace/renderer.h"

#include <atomic>
#include <span>
#include <vector>

namespace cellcut {

/// What is tried: `balanced` first, which stays unless another is better beyond doubt; then from cheap to dear.
std::vector<Quality> autoQualities();

struct QualityChoice {
  Quality chosen;
  double seconds = 0;                ///< that choosing took, wall-clock
  std::vector<QualityTrial> trials;  ///< of what was there to choose from, the first one first
};

/// Tries `candidates` on the scene of `renderer`, on films of a sixteenth of its pixels (at least 64×36, where it has
/// them), whose samples are thrown away.
/// Candidates that this rendering cannot tell apart (those of a strategy without cuts) are tried as one. `renderer`
/// then has the chosen settings, and renders the picture of a renderer that was made with them, bit for bit.
///
/// The choice depends on how long things take: another run may choose otherwise.
/// \param cancel  ends the trials when it becomes true
/// \pre `renderer` has no passes yet and the settings of candidates[0]
QualityChoice chooseQuality(Renderer& renderer, std::span<const Quality> candidates, const PlannedLength& length,
                            const std::atomic<bool>& cancel);

}  // namespace cellcut
