/// \file ray.h
/// Rays, and how they leave a surface without meeting it again.
#pragma once

#include "renderer/base/math.h"

namespace cellcut {

/// Points origin + t · direction for 0 < t < tMax. The direction need not be unit.
struct Ray {
  Vec3 origin;
  Vec3 direction;
  float tMax = kInfinity;
};

/// Bound per axis on the rounding error of a point interpolated in a triangle.
/// Seven roundings (pbrt 4th ed. section 6.8.4), taken at the largest vertex and not at the point: Embree's distance to
/// the plane is as uncertain as the vertices that it is computed from.
inline Vec3 triangleError(const Vec3& v0, const Vec3& v1, const Vec3& v2) {
  return gammaBound(7) * glm::max(glm::abs(v0), glm::max(glm::abs(v1), glm::abs(v2)));
}

/// Moves a point off its surface to the side that `direction` leaves on, past its error bound and one float further on
/// each axis. Source: pbrt 4th ed. section 6.8.6. Scales with the scene: no absolute distance.
/// \param normal  unit geometric normal, either side
inline Vec3 offsetRayOrigin(const Vec3& p, const Vec3& error, const Vec3& normal, const Vec3& direction) {
  const float distance = glm::dot(glm::abs(normal), error);
  const Vec3 offset = (glm::dot(direction, normal) < 0 ? -distance : distance) * normal;
  Vec3 moved = p + offset;
  for (int i = 0; i < 3; ++i) {
    if (offset[i] > 0) moved[i] = nextFloatUp(moved[i]);
    if (offset[i] < 0) moved[i] = -nextFloatUp(-moved[i]);
  }
  return moved;
}

/// A shadow ray stops this much short of its end, relative to its length: the distance that Embree computes to the
/// light's own triangle carries a rounding error, and where the end was not moved off a surface (a point light inside a
/// bulb's wall) the same. Eight roundings of Embree's robust intersector, at grazing angles up to 1 : 64.
inline constexpr float kShadowRayEnd = 1 - 64 * gammaBound(8);

/// Ray whose t = 1 is at `to`; it ends just before.
inline Ray shadowRay(const Vec3& from, const Vec3& to) {
  return {from, to - from, kShadowRayEnd};
}

}  // namespace cellcut
