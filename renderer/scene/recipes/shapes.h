/// \file shapes.h
/// Triangles of simple solids, appended to a surface.
///
/// Space: metres, +Y up. Every solid is wound counter-clockwise seen from outside. Faces that would lie on another
/// surface (a box on the floor, a frame on a wall) are left out by the caller, so that no two surfaces coincide.
#pragma once

#include "renderer/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cellcut {

/// Triangles with shared vertices. An attribute that is not used is empty; otherwise it has one value per position.
struct Surface {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;           ///< unit; empty: flat shading
  std::vector<Vec2> texCoords;         ///< (0, 0) at the top left of the picture
  std::vector<std::uint32_t> indices;  ///< three per triangle

  std::size_t triangleCount() const { return indices.size() / 3; }
  /// Index of a new vertex.
  std::uint32_t add(const Vec3& position);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
};

/// A local frame: moved anywhere, turned about +Y.
struct Pose {
  Vec3 origin{0.0f};
  Vec3 x{1, 0, 0};  ///< unit, horizontal; z = x × (0, 1, 0)

  /// Turned counter-clockwise seen from above.
  /// \param angle radians
  static Pose turned(const Vec3& origin, float angle);
  Vec3 z() const { return {-x.z, 0, x.x}; }
  Vec3 vector(const Vec3& local) const { return local.x * x + Vec3(0, local.y, 0) + local.z * z(); }
  Vec3 point(const Vec3& local) const { return origin + vector(local); }
  /// The same directions around another local point.
  Pose at(const Vec3& local) const { return {point(local), x}; }
  /// Around another local point, turned further by `angle` radians.
  Pose at(const Vec3& local, float angle) const;
};

/// Faces of a box, by the local axis that they look along.
enum Face : std::uint8_t { kLeft = 1, kRight = 2, kBottom = 4, kTop = 8, kBack = 16, kFront = 32 };

void addTriangle(Surface& s, const Vec3& a, const Vec3& b, const Vec3& c);
/// Corners counter-clockwise.
void addQuad(Surface& s, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
/// Box between two local corners, lower < upper in each coordinate.
/// \param without faces to leave out, or-ed
void addBox(Surface& s, const Pose& pose, const Vec3& lower, const Vec3& upper, unsigned without = 0);
/// Pyramid stump around the local vertical through `base`, flat shaded. A radius is ≥ 0 and one of them is > 0.
/// \param without  kBottom, kTop: left open
void addFrustum(Surface& s, const Vec3& base, float bottomRadius, float topRadius, float height, int sides,
                unsigned without = 0);
/// The regular solid with 4 faces, a corner up.
/// \param angle radians about the vertical
void addTetrahedron(Surface& s, const Vec3& centre, float radius, float angle);
/// The regular solid with 8 faces, corners up and down.
void addOctahedron(Surface& s, const Vec3& centre, float radius);
/// Surface of revolution about the vertical through `base`, smooth. `profile` holds (radius, height) from the bottom
/// up, seen from outside; the same point twice in a row makes a sharp edge.
void addLathe(Surface& s, const Vec3& base, std::span<const Vec2> profile, int segments);
/// Smooth ball.
/// \param rings of quads from pole to pole, ≥ 2
void addSphere(Surface& s, const Vec3& centre, float radius, int rings, int segments);

}  // namespace cellcut
