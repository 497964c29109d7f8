#include "renderer/scene/triangulate.h"

#include <cassert>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace cellcut {
namespace {

glm::dvec3 newellNormal(std::span<const glm::dvec3> polygon) {
  glm::dvec3 normal(0);
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    // Relative to the first corner, so that a polygon far from zero keeps its digits.
    normal += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  }
  return normal;
}

/// The polygon seen along the axis that its normal is nearest to, counter-clockwise.
std::vector<glm::dvec2> project(std::span<const glm::dvec3> polygon) {
  const glm::dvec3 normal = newellNormal(polygon);
  const glm::dvec3 size = glm::abs(normal);
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<glm::dvec2> points;
  for (const glm::dvec3& corner : polygon) {
    const glm::dvec3 p = corner - polygon[0];
    points.emplace_back(normal[axis] < 0 ? glm::dvec2(p[v], p[u]) : glm::dvec2(p[u], p[v]));
  }
  return points;
}

/// Twice the signed area; > 0: counter-clockwise.
double area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// True if the corner at `i` of the remaining polygon can be cut off: convex, with no other corner inside.
bool isEar(const std::vector<glm::dvec2>& points, const std::vector<std::uint32_t>& left, std::size_t i) {
  const std::size_t n = left.size();
  const glm::dvec2 &a = points[left[(i + n - 1) % n]], &b = points[left[i]], &c = points[left[(i + 1) % n]];
  if (!(area(a, b, c) > 0)) return false;
  for (std::size_t k = 2; k < n - 1; ++k) {
    const glm::dvec2& p = points[left[(i + k) % n]];
    if (p == a || p == b || p == c) continue;  // polygons with a hole touch themselves along a seam
    if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const glm::dvec3> polygon) {
  assert(polygon.size() >= 3);
  std::vector<std::uint32_t> left(polygon.size());
  std::iota(left.begin(), left.end(), 0u);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<glm::dvec2> points;
  if (polygon.size() > 3) points = project(polygon);
  // Go on where the last ear was: a convex polygon then takes one look per triangle.
  std::size_t at = 1, misses = 0;
  while (left.size() > 3) {
    const std::size_t n = left.size();
    at %= n;
    if (misses < n && !isEar(points, left, at)) {
      ++misses, ++at;
      continue;
    }
    triangles.push_back({left[(at + n - 1) % n], left[at], left[(at + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    misses = 0;
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace cellcut
