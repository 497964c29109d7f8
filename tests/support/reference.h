/// \file reference.h
/// What the lights do, computed another way: from the scene's plain data, in double, without the code under test.
#pragma once

#include "renderer/base/rng.h"
#include "renderer/lights/lights.h"
#include "renderer/trace/accel.h"

#include <cstdint>

namespace cellcut::test {

/// Irradiance of one light at a point with unit normal n, RGB in W/m². Triangles and the environment by quadrature with
/// `resolution`² cells per triangle or texel; uniform emission is assumed of triangles.
/// \param occluders  what stands between; null: nothing does
glm::dvec3 referenceIrradiance(const Lights& lights, LightId light, const Vec3& p, const Vec3& n, int resolution,
                               const Accel* occluders = nullptr);

/// Radiance of a lat-long picture along a unit direction, in double: the convention of environment.h, written once
/// more.
glm::dvec3 referenceEnvironment(const Environment& environment, const glm::dvec3& direction);

/// A path tracer that chooses no light: at every vertex it sums over all of them, triangles by uniform points, the
/// environment by the cosine, without MIS or roulette. Scatters by Bsdf::sample, which has its own tests.
class ReferenceTracer {
 public:
  ReferenceTracer(const Scene& scene, const Accel& accel) : scene_(scene), accel_(accel) {}

  /// Radiance of one path.
  Vec3 trace(Ray ray, int maxDepth, Rng& random) const;

 private:
  struct Vertex;
  Vec3 directLight(const Vertex& vertex, Rng& random) const;
  Vec3 punctualLight(const Vertex& vertex, Rng& random) const;
  Vec3 triangleLight(const Vertex& vertex, Rng& random) const;
  Vec3 environmentLight(const Vertex& vertex, Rng& random) const;
  bool visible(const Vertex& vertex, const Vec3& direction, float distance, Rng& random) const;

  const Scene& scene_;
  const Accel& accel_;
};

}  // namespace cellcut::test
