/// \file run.h
/// One rendering, with its error against the reference at passes 1, 2, 4, 8, … and the last.
#pragma once

#include "renderer/base/image.h"
#include "renderer/measure/metrics.h"
#include "renderer/trace/render_settings.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace cellcut {

/// The state of a rendering after a number of passes.
struct Checkpoint {
  std::uint64_t passes = 0;  ///< samples per pixel
  double seconds = 0;        ///< of rendering: neither the build before nor the comparisons between
  double passSeconds = 0;    ///< median of the passes so far: what the first one, which makes the cells, does not sway
  double mse = 0, relmse = 0, smape = 0, flip = 0, flipLdr = 0;  ///< as in ImageComparison
  double cutSize = 0;                                            ///< clusters per kept cut, mean; 0 without cuts
  std::uint64_t cells = 0;                                       ///< made so far; 0 without a grid
  std::uint64_t bytes = 0;                                       ///< of the lights and the strategy's tables
};

struct MeasuredRun {
  double buildSeconds = 0;  ///< ray-tracing structure, lights, trees
  std::uint64_t badSamples = 0;
  std::vector<Checkpoint> checkpoints;
  ImageRgb picture;  ///< at the last checkpoint
};

/// When a run ends: with the pass that reaches `passes` where they are set, else with the first that reaches `seconds`.
struct RunLimit {
  double seconds = 0;  ///< of rendering
  std::optional<std::uint64_t> passes;
};

/// \param onPass  passes and seconds so far
/// \return nothing when `cancel` became true
std::optional<MeasuredRun> measureRun(const Scene& scene, const RenderSettings& settings, const RunLimit& limit,
                                      const ImageRgb& reference, const std::atomic<bool>& cancel,
                                      const std::function<void(std::uint64_t, double)>& onPass);

}  // namespace cellcut
