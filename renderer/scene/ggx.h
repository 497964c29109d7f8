/// \file ggx.h
/// The Trowbridge–Reitz (GGX) distribution of microfacets, isotropic.
///
/// Directions are unit, in the shading frame (z = shading normal), and point away from the surface.
#pragma once

#include "renderer/base/warp.h"

namespace cellcut {

/// Smallest α. Below it the lobe is narrower than the half vectors that float directions can express (10⁻⁷ against
/// α² = 10⁻⁶).
inline constexpr float kMinGgxAlpha = 1e-3f;

/// α of glTF's perceptual roughness in [0, 1].
inline float ggxAlpha(float roughness) {
  return std::max(kMinGgxAlpha, roughness * roughness);
}

/// Density of microfacet normals. Source: Walter et al. 2007, written without a tangent so that it is precise at
/// α = kMinGgxAlpha.
inline float ggxD(float alpha, const Vec3& h) {
  const float a2 = alpha * alpha;
  const float e = (h.x * h.x + h.y * h.y) / a2 + h.z * h.z;
  return kInvPi / (a2 * (e * e));
}

/// Smith's Λ: 1 / (1 + Λ(w)) of the microfacets are not masked from w.
inline float ggxLambda(float alpha, const Vec3& w) {
  const float a2 = alpha * alpha * (w.x * w.x + w.y * w.y) / (w.z * w.z);
  return 0.5f * (std::sqrt(1 + a2) - 1);
}

/// Normal visible from wo. Source: Heitz 2018, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4).
inline Vec3 sampleVisibleNormal(float alpha, const Vec3& wo, Vec2 u) {
  const Vec3 stretched = glm::normalize(Vec3(alpha * wo.x, alpha * wo.y, wo.z));
  const bool tilted = stretched.x != 0 || stretched.y != 0;
  const Vec3 horizontal = tilted ? glm::normalize(Vec3(-stretched.y, stretched.x, 0)) : Vec3(1, 0, 0);
  const Vec3 vertical = glm::cross(stretched, horizontal);
  const float s = 0.5f * (1 + stretched.z);
  Vec2 d = concentricDisk(u);
  d.y = (1 - s) * safeSqrt(1 - d.x * d.x) + s * d.y;
  const Vec3 h = d.x * horizontal + d.y * vertical + safeSqrt(1 - d.x * d.x - d.y * d.y) * stretched;
  return glm::normalize(Vec3(alpha * h.x, alpha * h.y, std::max(0.0f, h.z)));
}

/// Schlick 1994.
inline float schlickWeight(float cosine) {
  const float m = std::clamp(1 - cosine, 0.0f, 1.0f);
  return (m * m) * (m * m) * m;
}

}  // namespace cellcut
