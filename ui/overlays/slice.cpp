#include "ui/overlays/slice.h"

#include "renderer/scene/camera.h"

#include <cassert>

namespace cellcut {
namespace {

int axisOf(SliceAxis axis) {
  assert(axis != SliceAxis::kNone);
  return static_cast<int>(axis) - 1;
}

/// Around the cells that cover the grid's box.
Bounds boxOf(const GridGeometry& grid) {
  const glm::ivec3 last = grid.resolution() - 1;
  Bounds box;
  box.lower = grid.box({0, 0, 0}).lower;
  box.upper = grid.box({last.x, last.y, last.z}).upper;
  return box;
}

}  // namespace

float coordinateOf(const Slice& slice, const GridGeometry& grid) {
  const int axis = axisOf(slice.axis), layers = grid.resolution()[axis];
  const int layer = std::clamp(static_cast<int>(slice.position * static_cast<float>(layers)), 0, layers - 1);
  const Bounds box = boxOf(grid);
  const float share = (static_cast<float>(layer) + 0.5f) / static_cast<float>(layers);
  return box.lower[axis] + share * (box.upper[axis] - box.lower[axis]);
}

std::optional<Image<FirstHit>> sliceHits(const Slice& slice, const GridGeometry& grid, const Camera& camera,
                                         const Image<FirstHit>& behind, const std::atomic<bool>& cancel) {
  const int axis = axisOf(slice.axis);
  const float plane = coordinateOf(slice, grid);
  const Bounds box = boxOf(grid);
  const glm::ivec2 size(behind.width(), behind.height());
  Image<FirstHit> hits(size.x, size.y);
  for (int y = 0; y < size.y; ++y) {
    if (cancel.load(std::memory_order_relaxed)) return std::nullopt;
    for (int x = 0; x < size.x; ++x) {
      const Ray ray = cameraRay(camera, Vec2(x, y) + Vec2(0.5f), size);
      const float t = (plane - ray.origin[axis]) / ray.direction[axis];
      if (!(t > 0 && t < behind.at(x, y).distance)) continue;
      Vec3 p = ray.origin + t * ray.direction;
      p[axis] = plane;
      bool inside = true;
      for (int i = 0; i < 3; ++i) inside = inside && p[i] >= box.lower[i] && p[i] <= box.upper[i];
      if (!inside) continue;
      Vec3 normal(0.0f);
      normal[axis] = ray.direction[axis] > 0 ? -1.0f : 1.0f;
      hits.at(x, y) = {{p, normal}, normal, Vec3(0.0f), t};
    }
  }
  return hits;
}

std::vector<Segment> sliceSegments(const Slice& slice, const GridGeometry& grid, const Rgba8& color) {
  const int axis = axisOf(slice.axis), u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Bounds box = boxOf(grid);
  const auto at = [&](float a, float b) {
    Vec3 p;
    p[axis] = coordinateOf(slice, grid);
    p[u] = box.lower[u] + a * (box.upper[u] - box.lower[u]);
    p[v] = box.lower[v] + b * (box.upper[v] - box.lower[v]);
    return p;
  };
  std::vector<Segment> segments;
  const int columns = grid.resolution()[u], rows = grid.resolution()[v];
  for (int i = 0; i <= columns; ++i) {
    const float a = static_cast<float>(i) / static_cast<float>(columns);
    segments.push_back({at(a, 0), at(a, 1), color});
  }
  for (int i = 0; i <= rows; ++i) {
    const float b = static_cast<float>(i) / static_cast<float>(rows);
    segments.push_back({at(0, b), at(1, b), color});
  }
  return segments;
}

}  // namespace cellcut
