#include "renderer/scene/triangulate.h"

#include <cassert>
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

/// Twice the area of the corner at `i` of the remaining polygon; not > 0: it is no convex one.
double cornerArea(const std::vector<glm::dvec2>& points, const std::vector<std::uint32_t>& left, std::size_t i) {
  const std::size_t n = left.size();
  return area(points[left[(i + n - 1) % n]], points[left[i]], points[left[(i + 1) % n]]);
}

/// True if the corner at `i` of the remaining polygon can be cut off: convex, with no other corner inside. If there are
/// any inside, that farthest from the cut is not convex: to look at those, `hollow`, will do.
bool isEar(const std::vector<glm::dvec2>& points, const std::vector<std::uint32_t>& left, std::size_t i,
           const std::vector<std::uint32_t>& hollow, std::size_t& looks) {
  const std::size_t n = left.size();
  const glm::dvec2 &a = points[left[(i + n - 1) % n]], &b = points[left[i]], &c = points[left[(i + 1) % n]];
  if (!(area(a, b, c) > 0)) return false;
  for (const std::uint32_t corner : hollow) {
    ++looks;
    const glm::dvec2& p = points[corner];
    if (p == a || p == b || p == c) continue;  // polygons with a hole touch themselves along a seam
    if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const glm::dvec3> polygon, std::size_t& looks) {
  assert(polygon.size() >= 3);
  std::vector<std::uint32_t> left(polygon.size());
  std::iota(left.begin(), left.end(), 0u);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<glm::dvec2> points;
  if (polygon.size() > 3) points = project(polygon);
  std::vector<std::uint32_t> hollow;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(cornerArea(points, left, i) > 0)) hollow.push_back(left[i]);
  }
  // Go on where the last ear was: a convex polygon then takes one look per triangle. What is no ear becomes one only
  // when a corner beside it is cut off, and is not looked at before (O'Rourke 1998, section 1.4).
  std::vector<bool> isBlocked(points.size(), false);
  std::size_t at = 1, misses = 0;
  while (left.size() > 3) {
    ++looks;
    at %= left.size();
    const std::uint32_t corner = left[at];
    if (misses < left.size() && (isBlocked[corner] || !isEar(points, left, at, hollow, looks))) {
      isBlocked[corner] = true;
      ++misses, ++at;
      continue;
    }
    const std::size_t before = (at + left.size() - 1) % left.size(), after = (at + 1) % left.size();
    triangles.push_back({left[before], corner, left[after]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    std::erase(hollow, corner);
    for (const std::size_t i : {(at + left.size() - 1) % left.size(), at % left.size()}) {
      isBlocked[left[i]] = false;
      if (cornerArea(points, left, i) > 0) std::erase(hollow, left[i]);
    }
    misses = 0;
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace cellcut
