/// \file warp.h
/// Uniform numbers → directions and points, with their densities.
#pragma once

#include "renderer/base/math.h"

#include <array>
#include <optional>

namespace cellcut {

/// Unit disk, area-preserving. Source: Shirley and Chiu 1997.
Vec2 concentricDisk(Vec2 u);

/// Cosine-distributed direction around +z; density cosθ/π.
Vec3 cosineHemisphere(Vec2 u);

/// Barycentric weights of two corners, uniform in area. Source: Heitz 2019, "A Low-Distortion Map Between Triangle and
/// Square".
Vec2 uniformTriangle(Vec2 u);

/// Solid angle of a triangle seen from the origin, [0, 2π]. Source: Van Oosterom and Strackee 1983.
/// \param corners unit directions
float sphericalTriangleArea(const std::array<glm::dvec3, 3>& corners);

/// Uniform direction inside a spherical triangle. Source: Arvo 1995; pbrt 4th ed. section 6.5.4.
/// \param corners unit directions; nothing when they span no area
std::optional<Vec3> uniformSphericalTriangle(const std::array<glm::dvec3, 3>& corners, Vec2 u);

}  // namespace cellcut
