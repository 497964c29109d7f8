/// \file surface.h
/// Where a ray met a triangle.
#pragma once

#include "renderer/lights/triangle_light.h"
#include "renderer/sampling/light_sampler.h"
#include "renderer/scene/material.h"
#include "renderer/trace/accel.h"

namespace cellcut {

struct SurfacePoint {
  SurfaceCoordinates at;
  Vec3 p;
  Vec3 error;   ///< bound on the rounding error of p, per axis
  Vec3 normal;  ///< unit geometric normal, front side
};

inline SurfacePoint surfaceAt(const Scene& scene, const Hit& hit) {
  const Mesh& mesh = scene.meshes[indexOf(hit.mesh)];
  const Triangle& t = mesh.triangles[hit.triangle];
  const Vec3 &v0 = mesh.positions[t.x], &v1 = mesh.positions[t.y], &v2 = mesh.positions[t.z];
  const float b0 = 1 - hit.barycentric.x - hit.barycentric.y;
  const Vec3 p = b0 * v0 + hit.barycentric.x * v1 + hit.barycentric.y * v2;
  return {{&mesh, hit.triangle, hit.barycentric},
          p,
          triangleError(v0, v1, v2),
          triangleGeometry(mesh, hit.triangle).normal};
}

/// The shading normal that a path leaves the surface with.
/// \param geometricNormal  unit, on the side of `outgoing`
inline Vec3 shadingNormalTowards(const Scene& scene, const SurfaceCoordinates& at, const Vec3& geometricNormal,
                                 const Vec3& outgoing) {
  const Vec3 shading = shadingNormal(scene, at, geometricNormal);
  // One that looks away from the viewer would make the surface black: there the flat one serves.
  return glm::dot(shading, outgoing) > 0 ? shading : geometricNormal;
}

/// What a LightSampler may know of the reflection.
/// \param outgoing  unit, world space
inline GlossyLobe lobeOf(const Bsdf& bsdf, const Frame& shading, const Vec3& outgoing) {
  return {outgoing, bsdf.alpha(), bsdf.reflectionShare(shading.toLocal(outgoing))};
}

}  // namespace cellcut
