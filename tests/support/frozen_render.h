/// \file frozen_render.h
/// A few passes of a scene with everything that was used still there to be looked at.
#pragma once

#include "tests/support/images.h"

#include <vector>

namespace cellcut::test {

struct FrozenSettings {
  glm::ivec2 size{32, 24};
  std::size_t passes = 2;
  int maxDepth = 3;
  Strategy strategy = Strategy::kCellCut;
  SamplerSettings sampler{.gridResolution = 8, .countVisits = true};
};

/// Renders on the calling thread with the scene's first camera, which must outlive it.
struct FrozenRender {
  FrozenRender(const Scene& scene, const FrozenSettings& settings);

  const Scene& scene;
  FrozenSettings settings;
  Accel accel;
  Lights lights;
  std::vector<Vec3> pilot;
  std::unique_ptr<LightSampler> sampler;
  Film film;
  std::vector<ShadingPoint> vertices;  ///< where a light was asked for, all passes

  const Camera& camera() const { return scene.cameras[0]; }
};

}  // namespace cellcut::test
