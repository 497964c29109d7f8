/// \file recording.h
/// What one pass does, written down, so that its parts can be timed on their own.
#pragma once

#include "renderer/scene/camera.h"
#include "renderer/trace/integrator.h"

namespace cellcut {

/// Rays and vertices of the first direct-light pass of a scene's first camera, tile by tile as a pass renders them, but
/// ray by ray.
inline PathRecord recordPass(const Scene& scene, const Accel& accel, const Lights& lights, const LightSampler& sampler,
                             glm::ivec2 size) {
  PathRecord record;
  const PathContext context{scene, accel, lights, sampler, 1, true, false, &record};
  PathCounts counts;
  constexpr int kTile = 16;
  const glm::ivec2 tiles = (size + kTile - 1) / kTile;
  for (int i = 0; i < tiles.x * tiles.y * kTile * kTile; ++i) {
    const int tile = i / (kTile * kTile), inTile = i % (kTile * kTile);
    const int x = tile % tiles.x * kTile + inTile % kTile, y = tile / tiles.x * kTile + inTile / kTile;
    if (x >= size.x || y >= size.y) continue;
    PixelSampler random(PixelSampling::kSobol, 0, x, y, 0);
    const Sample4 position = random.next();
    const Vec2 onFilm(static_cast<float>(x) + position[0], static_cast<float>(y) + position[1]);
    tracePath(context, cameraRay(scene.cameras[0], onFilm, size), random, counts);
  }
  return record;
}

}  // namespace cellcut
