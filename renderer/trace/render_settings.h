/// \file render_settings.h
/// What a rendering is told besides the scene, and what it counts.
#pragma once

#include "renderer/base/pixel_sampler.h"
#include "renderer/sampling/sampler_settings.h"
#include "renderer/sampling/strategy.h"
#include "renderer/scene/scene.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace cellcut {

class LightMask;

struct RenderSettings {
  int width = 1280;
  int height = 720;
  int maxDepth = 8;  ///< path vertices that scatter: 1 is direct light only; ≥ 0
  Strategy strategy = Strategy::kCellCut;
  SamplerSettings sampler;
  PixelSampling sampling = PixelSampling::kSobol;
  std::uint64_t seed = 0;
  int threads = 0;             ///< 0: one per hardware thread
  int niceness = 0;            ///< of the threads of a Renderer: setThreadNiceness(); a session has its own
  std::size_t camera = 0;      ///< index into Scene::cameras; sizes the grid of cells even where `view` is set
  std::optional<Camera> view;  ///< a free camera that is looked through instead
  bool auxiliary = true;       ///< albedo, normal and depth layers
  std::shared_ptr<const LightMask> shownLights;  ///< light_mask.h; null: all
};

/// The camera that is looked through. \pre `settings.camera` exists
inline const Camera& viewOf(const Scene& scene, const RenderSettings& settings) {
  return settings.view ? *settings.view : scene.cameras[settings.camera];
}

/// Passes before a limit on the noise is looked at: from a few samples the variance is mostly unknown, and the bright
/// rare paths that make up the error have not been met.
inline constexpr std::uint64_t kMinNoisePasses = 16;

struct RayCounts {
  std::uint64_t camera = 0;
  std::uint64_t bounce = 0;
  std::uint64_t shadow = 0;
};

}  // namespace cellcut
