/// \file triangle_light.h
/// One emissive triangle as a light: corners, sampling, density, form factor.
#pragma once

#include "renderer/scene/scene.h"

#include <array>
#include <optional>
#include <vector>

namespace cellcut {

/// A triangle whose emission is not black everywhere.
struct TriangleLight {
  MeshId mesh;
  std::uint32_t triangle;
  float meanRadiance;  ///< scalar emission, mean over the triangle, W/(m² sr), > 0; includes coverage
};

/// All triangle lights of a scene, ordered by mesh and triangle. Parallel.
std::vector<TriangleLight> collectTriangleLights(const Scene& scene);

/// The corners of a triangle in world space with what the formulas below need.
struct TriangleGeometry {
  std::array<Vec3, 3> corners;
  Vec3 normal;  ///< unit, front side
  float area;   ///< m²; computed in double, so that it does not underflow for micrometre triangles
};
TriangleGeometry triangleGeometry(const Mesh& mesh, std::uint32_t triangle);

/// Barycentric weights of corners 1 and 2 where the ray from p meets the triangle's plane, or the nearest on its edge.
/// In double. Nothing for a ray along the plane.
std::optional<Vec2> intersectPlane(const TriangleGeometry& triangle, const Vec3& p, const Vec3& direction);

/// A point on the triangle as seen from elsewhere.
struct TrianglePoint {
  Vec2 barycentric;  ///< weights of corners 1 and 2
  Vec3 position;
  float pdf;  ///< over solid angle at the observer
};

/// By solid angle where that is stable, else by area. Source: pbrt 4th ed. section 6.5.4.
/// Nothing when `p` lies in the triangle's plane or the triangle is too far for its solid angle to be a float.
std::optional<TrianglePoint> sampleTriangle(const TriangleGeometry& triangle, const Vec3& p, Vec2 u);

/// Density of sampleTriangle at point `q` of the triangle; 0 where it samples nothing.
float trianglePdf(const TriangleGeometry& triangle, const Vec3& p, const Vec3& q);

/// Whether a triangle light sends anything to the side of its plane that p is on. From the distance of a corner to the
/// plane, in the arithmetic that a hit uses too: sampling and importance must not decide differently.
bool emitsTowards(const TriangleGeometry& triangle, bool doubleSided, const Vec3& p);

/// ∫ cosθ dω over the part of the triangle above the horizon of normal n at p, from either side of the triangle, [0,
/// π]. Source: Lambert's polygon formula (Baum et al. 1989), after clipping. In double.
double triangleFormFactor(const TriangleGeometry& triangle, const Vec3& p, const Vec3& n);

/// What the irradiance from a triangle light is made of, without the scene.
struct TriangleEmitter {
  TriangleGeometry geometry;
  double meanRadiance;  ///< scalar emission, in any unit
  bool doubleSided;

  /// Unoccluded irradiance at a point with unit normal n, in the unit of meanRadiance · sr: exact where the radiance is
  /// uniform.
  double irradiance(const Vec3& p, const Vec3& n) const;
};

}  // namespace cellcut
