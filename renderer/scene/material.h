/// \file material.h
/// A material at a point of a triangle: radiance, coverage, shading normal, BSDF.
#pragma once

#include "renderer/scene/bsdf.h"
#include "renderer/scene/lit_texels.h"
#include "renderer/scene/scene.h"

namespace cellcut {

/// A point of a triangle by its barycentric weights of corners 1 and 2.
struct SurfaceCoordinates {
  const Mesh* mesh;
  std::uint32_t triangle;
  Vec2 barycentric;
};

/// Emitted radiance towards the front (and the back, if doubleSided), W/(m² sr), before coverage.
Vec3 emission(const Scene& scene, const SurfaceCoordinates& at);

/// Share of light that meets the surface: the rest passes as if it were not there. [0, 1]; MASK gives 0 or 1, OPAQUE 1.
float coverage(const Scene& scene, const SurfaceCoordinates& at);

/// Base colour without alpha, as an albedo [0, 1] or as the radiance of an unlit material.
Vec3 baseColor(const Scene& scene, const SurfaceCoordinates& at);

/// Shading normal, unit, on the side of the geometric normal given: interpolated, then perturbed by the normal texture.
Vec3 shadingNormal(const Scene& scene, const SurfaceCoordinates& at, const Vec3& geometricNormal);

/// False only if the material has no BSDF but a Lambertian one.
bool canReflect(const Material& material);

/// The BSDF of a material that is not unlit.
Bsdf bsdfAt(const Scene& scene, const SurfaceCoordinates& at);

/// Number n of parts per edge, [1, 64], so that n² parts of the triangle are about as fine as the textures of emission
/// and coverage.
int emissionResolution(const Scene& scene, const Mesh& mesh, std::uint32_t triangle);

/// False only if no surface of the material can have a positive emission: it is black or unlit, or its texture is black.
/// \param lit  of the scene
bool canEmit(const Scene& scene, const Material& material, LitTexelsOfScene& lit);

/// False only if no point of the triangle can have a positive emission: every texel that a lookup on it can touch is
/// black.
bool canEmit(const Scene& scene, const Mesh& mesh, std::uint32_t triangle, LitTexelsOfScene& lit);

}  // namespace cellcut
