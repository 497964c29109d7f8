/// \file integrator.h
/// One camera path: radiance by path tracing with next-event estimation and multiple importance sampling at every
/// vertex.
///
/// The integrator asks a LightSampler for one light and knows nothing of how it was chosen.
#pragma once

#include "renderer/base/pixel_sampler.h"
#include "renderer/sampling/light_sampler.h"
#include "renderer/trace/accel.h"
#include "renderer/trace/film.h"

namespace cellcut {

class LightMask;

/// What paths did, in order: for benchmarks that do the same again piece by piece, and for tests.
struct PathRecord {
  struct TracedRay {
    Ray ray;
    bool shadow;
  };
  std::vector<TracedRay> rays;
  std::vector<ShadingPoint> vertices;  ///< where a light was asked for
};

/// What a path needs to know; everything outlives it.
struct PathContext {
  const Scene& scene;
  const Accel& accel;
  const Lights& lights;
  const LightSampler& sampler;
  int maxDepth;                  ///< path vertices that scatter; 1 is direct light only
  bool bounceCanFind;            ///< BSDF rays can meet radiance: emissive or unlit triangles, or an environment
  bool auxiliary = false;        ///< albedo, normal and depth are wanted too
  PathRecord* record = nullptr;  ///< where to write down what was done; one thread only
  const LightMask* shownLights = nullptr;  ///< null: all
};

struct PathCounts {
  std::uint64_t bounceRays = 0;
  std::uint64_t shadowRays = 0;
  std::uint64_t dropped = 0;  ///< light samples given up: the vertex lies on the light
};

/// Follows one path from a camera ray. Adds to `counts`.
PathSample tracePath(const PathContext& context, const Ray& cameraRay, PixelSampler& random, PathCounts& counts);

/// A path whose first hit is found together with those of its neighbours.
struct CameraPath {
  Ray ray;
  PixelSampler random;
  std::optional<Hit> hit{};
};
/// \param paths  at most kRayPacket
void findFirstHits(const Accel& accel, std::span<CameraPath> paths);
/// \pre findFirstHits()
PathSample tracePath(const PathContext& context, CameraPath& path, PathCounts& counts);

}  // namespace cellcut
