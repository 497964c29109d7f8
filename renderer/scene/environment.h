/// \file environment.h
/// The mapping between directions and lat-long coordinates, and the radiance that comes from a direction.
///
/// Convention (as in three.js and Blender's glTF): +Y up, the middle column of the picture looks along +X, a quarter
/// further right along +Z; the top row is up. Rotation turns the picture about +Y, counter-clockwise seen from above.
///     u = 1/2 + atan2(z, x) / 2π,   v = acos(y) / π
#pragma once

#include "renderer/scene/scene.h"

namespace cellcut {

/// [0, 1)² coordinates of a unit direction in the picture.
Vec2 latLongFromDirection(const Environment& environment, const Vec3& direction);
/// Unit direction of picture coordinates. Inverse of latLongFromDirection but at the poles.
Vec3 directionFromLatLong(const Environment& environment, Vec2 uv);

/// Radiance at picture coordinates: bilinear between texel centres, wrapping at the seam, clamped at the poles.
Vec3 environmentRadiance(const Environment& environment, Vec2 uv);
/// Radiance seen along a unit direction.
inline Vec3 environmentRadiance(const Environment& environment, const Vec3& direction) {
  return environmentRadiance(environment, latLongFromDirection(environment, direction));
}

}  // namespace cellcut
