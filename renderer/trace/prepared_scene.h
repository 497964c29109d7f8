/// \file prepared_scene.h
/// What is built before the first pass, by what it depends on: a scene's own structures, and a strategy over them.
#pragma once

#include "renderer/lights/lights.h"
#include "renderer/sampling/light_sampler.h"
#include "renderer/trace/accel.h"
#include "renderer/trace/render_settings.h"

#include <memory>

namespace cellcut {

/// What depends on the scene alone, and GgxAlbedo's table where the scene needs it. The scene must outlive it.
/// Threads: const members may run concurrently.
struct PreparedScene {
  /// Builds on the threads of the calling TBB arena.
  /// \throws std::bad_alloc, std::runtime_error as Accel does
  explicit PreparedScene(const Scene& s);

  const Scene& scene;
  Accel accel;
  Lights lights;
};

/// The strategy, its grid sized by what the indexed camera sees. Builds on the threads of the calling TBB arena.
/// \pre `settings.camera` exists; `prepared` outlives the sampler
std::unique_ptr<LightSampler> makeLightSampler(const PreparedScene& prepared, const RenderSettings& settings);

/// Whether samplers of one scene made from either are the same. A free view, the size, the seed and the threads never
/// matter; the maximum depth only does where paths are shorter than those that size the grid of cells.
bool haveSameSampler(const RenderSettings& a, const RenderSettings& b);

}  // namespace cellcut
