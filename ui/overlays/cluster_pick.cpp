#include "ui/overlays/cluster_pick.h"

#include <algorithm>
#include <limits>

namespace cellcut {
namespace {

float cross(const Vec2& a, const Vec2& b) {
  return a.x * b.y - a.y * b.x;
}

float areaOf(const std::vector<Vec2>& hull) {
  float sum = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) sum += cross(hull[i], hull[(i + 1) % hull.size()]);
  return 0.5f * std::abs(sum);
}

float distanceToSegment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const float length2 = glm::dot(along, along);
  const float t = length2 > 0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0f, 1.0f) : 0;
  return glm::length(p - a - t * along);
}

bool covers(const std::vector<Vec2>& hull, const Vec2& p, float slack) {
  bool inside = hull.size() > 2;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
    if (distanceToSegment(p, a, b) <= slack) return true;
    inside = inside && cross(b - a, p - a) >= 0;
  }
  return inside;
}

}  // namespace

std::vector<Vec2> convexHull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> hull;
  const auto chain = [&hull](auto begin, auto end) {
    const std::size_t first = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= first + 2 && cross(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= 0) {
        hull.pop_back();
      }
      hull.push_back(*p);
    }
    hull.pop_back();  // begins the other chain
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

std::optional<std::size_t> clusterAt(std::span<const ClusterRow> rows, const Projection2& project, const Vec2& position,
                                     float slack) {
  std::optional<std::size_t> found;
  float smallest = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Bounds& box = rows[i].cluster.box;
    if (rows[i].cluster.distant || box.empty()) continue;
    std::vector<Vec2> corners;
    for (unsigned corner = 0; corner < 8; ++corner) {
      if (const auto at = project(box.corner(corner))) corners.push_back(*at);
    }
    if (corners.size() < 8) continue;
    const std::vector<Vec2> hull = convexHull(std::move(corners));
    const float area = areaOf(hull);
    if (area < smallest && covers(hull, position, slack)) {
      smallest = area;
      found = i;
    }
  }
  return found;
}

}  // namespace cellcut
