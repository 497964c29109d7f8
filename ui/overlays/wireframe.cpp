#include "ui/overlays/wireframe.h"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace cellcut {
namespace {

/// How much farther than the surface a line may be and still be seen, relative to the distance.
constexpr double kDepthMargin = 0.005;
/// Depth of the plane in front of a perspective camera that lines are clipped at, relative to the segment's extent from
/// the camera: lines nearer than that are not seen, and their quotients stay finite.
constexpr double kNearShare = 1e-4;
/// Least probability that has a colour of its own, relative to the largest.
constexpr double kProbabilityDecades = 1e-3;

/// A point in the camera's frame: right, up, and forward in metres.
glm::dvec3 toView(const Camera& camera, const Vec3& p) {
  const glm::dvec3 d = glm::dvec3(p) - glm::dvec3(camera.position);
  return {glm::dot(d, glm::dvec3(camera.right)), glm::dot(d, glm::dvec3(camera.up)),
          -glm::dot(d, glm::dvec3(camera.back))};
}

/// An end of a line on the film. `w` varies linearly along it there: 1 / forward in perspective, else forward.
struct FilmPoint {
  double x, y, w;
};

/// The camera of camera.h, the other way round.
class Projection {
 public:
  Projection(const Camera& camera, glm::ivec2 size) : camera_(camera), half_(0.5 * glm::dvec2(size)) {}

  FilmPoint project(const glm::dvec3& view) const {
    const double scale = half_.y / static_cast<double>(camera_.halfHeight) / (camera_.orthographic ? 1 : view.z);
    return {half_.x + scale * view.x, half_.y - scale * view.y, camera_.orthographic ? view.z : 1 / view.z};
  }
  /// Distance along the unit ray through a film point, for a line of that w there.
  double distance(double x, double y, double w) const {
    if (camera_.orthographic) return w;
    const double perPixel = static_cast<double>(camera_.halfHeight) / half_.y;
    const double across = (x - half_.x) * perPixel, up = (half_.y - y) * perPixel;
    return std::sqrt(1 + across * across + up * up) / w;
  }

 private:
  const Camera& camera_;
  glm::dvec2 half_;
};

/// Cuts the part off that lies behind forward = `near`; false: nothing is left.
bool clipNear(glm::dvec3& a, glm::dvec3& b, double near) {
  if (a.z < near && b.z < near) return false;
  if (a.z < near) a = b + (a - b) * ((b.z - near) / (b.z - a.z));
  if (b.z < near) b = a + (b - a) * ((a.z - near) / (a.z - b.z));
  return true;
}

/// Narrows [t0, t1] to where from + t · step lies in [low, high].
bool narrow(double from, double step, double low, double high, double& t0, double& t1) {
  if (step == 0) return from >= low && from <= high;
  const double a = (low - from) / step, b = (high - from) / step;
  t0 = std::max(t0, std::min(a, b));
  t1 = std::min(t1, std::max(a, b));
  return t0 <= t1;
}

class Canvas {
 public:
  Canvas(ImageRgba8& image, const Image<float>& depth, const Camera& camera)
      : image_(image), depth_(depth), camera_(camera), projection_(camera, {image.width(), image.height()}) {}

  void draw(const Segment& segment) {
    glm::dvec3 from = toView(camera_, segment.from), to = toView(camera_, segment.to);
    const double extent = std::sqrt(std::max(glm::dot(from, from), glm::dot(to, to)));
    if (!clipNear(from, to, camera_.orthographic ? 0 : kNearShare * extent)) return;
    if (extent > 0) drawOnFilm(projection_.project(from), projection_.project(to), segment.color);
  }

 private:
  /// One pixel per row or column, whichever the line crosses more of, at the middle of it.
  void drawOnFilm(const FilmPoint& from, const FilmPoint& to, const Rgba8& color) {
    const double dx = to.x - from.x, dy = to.y - from.y;
    const bool alongX = std::abs(dx) >= std::abs(dy);
    double t0 = 0, t1 = 1;
    // A pixel beyond the border, so that no pixel in the picture is lost to rounding; plot() asks again.
    if (!narrow(from.x, dx, -1, image_.width() + 1.0, t0, t1)) return;
    if (!narrow(from.y, dy, -1, image_.height() + 1.0, t0, t1)) return;
    const double start = alongX ? from.x : from.y, along = alongX ? dx : dy;
    const double a = start + t0 * along, b = start + t1 * along;
    const int first = static_cast<int>(std::floor(std::min(a, b))), last = static_cast<int>(std::floor(std::max(a, b)));
    for (int i = first; i <= last; ++i) {
      const double t = along == 0 ? t0 : std::clamp((i + 0.5 - start) / along, t0, t1);
      const double x = from.x + t * dx, y = from.y + t * dy;
      plot(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)), from.w + t * (to.w - from.w), color);
    }
  }

  void plot(int x, int y, double w, const Rgba8& color) {
    if (x < 0 || y < 0 || x >= image_.width() || y >= image_.height()) return;
    const double surface = static_cast<double>(depth_.at(x, y));
    if (projection_.distance(x + 0.5, y + 0.5, w) > surface * (1 + kDepthMargin)) return;
    image_.at(x, y) = over(image_.at(x, y), color);
  }

  ImageRgba8& image_;
  const Image<float>& depth_;
  const Camera& camera_;
  Projection projection_;
};

/// An edge of the grid: from a corner one cell along an axis. Corners are named by the cell that they are the lower one
/// of.
struct GridEdge {
  CellCoordinates corner;
  int axis;
  auto key() const { return std::tuple(corner.x, corner.y, corner.z, corner.coarse, axis); }
};

std::vector<GridEdge> edgesOf(const CutInspector& inspector) {
  std::vector<GridEdge> edges;
  inspector.forEachCell([&](const CellCoordinates& cell, const Cut&) {
    // Coarse cells among the fine ones are those of bounces.
    if (cell.coarse && !inspector.grid()->isRemote(cell)) return;
    for (int corner = 0; corner < 8; ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        if ((corner >> axis & 1) != 0) continue;
        edges.push_back(
            {{cell.x + (corner & 1), cell.y + (corner >> 1 & 1), cell.z + (corner >> 2 & 1), cell.coarse}, axis});
      }
    }
  });
  std::sort(edges.begin(), edges.end(), [](const GridEdge& a, const GridEdge& b) { return a.key() < b.key(); });
  const auto same = [](const GridEdge& a, const GridEdge& b) { return a.key() == b.key(); };
  edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
  return edges;
}

void appendCross(std::vector<Segment>& segments, const Vec3& centre, float size, const Rgba8& color) {
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 arm(0);
    arm[axis] = 0.5f * size;
    segments.push_back({centre - arm, centre + arm, color});
  }
}

}  // namespace

void appendBox(std::vector<Segment>& segments, const Bounds& box, const Rgba8& color) {
  if (box.empty()) return;
  for (unsigned corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1) != 0 || box.lower[axis] == box.upper[axis]) continue;
      // In a box that is flat on another axis the edges of both sides are one.
      bool doubled = false;
      for (int other = 0; other < 3; ++other)
        doubled |= (corner >> other & 1) != 0 && box.lower[other] == box.upper[other];
      if (!doubled) segments.push_back({box.corner(corner), box.corner(corner | 1u << axis), color});
    }
  }
}

std::vector<Segment> touchedCellSegments(const CutInspector& inspector, const Rgba8& color) {
  std::vector<Segment> segments;
  if (!inspector.grid()) return segments;
  for (const auto& [corner, axis] : edgesOf(inspector)) {
    CellCoordinates next = corner;
    (axis == 0 ? next.x : axis == 1 ? next.y : next.z) += 1;
    segments.push_back({inspector.grid()->box(corner).lower, inspector.grid()->box(next).lower, color});
  }
  return segments;
}

ColorScale probabilityScale(std::span<const ClusterInspection> clusters, Colormap colormap) {
  double largest = 0;
  for (const ClusterInspection& c : clusters) largest = std::max(largest, c.probability);
  return {
      {},
      {.pinned = ValueRange{kProbabilityDecades * largest, largest}, .kind = ScaleKind::kLog, .colormap = colormap}};
}

std::vector<Segment> clusterSegments(std::span<const ClusterInspection> clusters, const ColorScale& scale,
                                     std::uint8_t alpha, float pointSize) {
  std::vector<const ClusterInspection*> order;
  for (const ClusterInspection& c : clusters) {
    if (!c.distant) order.push_back(&c);
  }
  std::stable_sort(order.begin(), order.end(), [](const ClusterInspection* a, const ClusterInspection* b) {
    return a->probability < b->probability;
  });
  std::vector<Segment> segments;
  for (const ClusterInspection* c : order) {
    const Rgba8 color(scale.color(c->probability), alpha);
    if (c->box.lower == c->box.upper) {
      appendCross(segments, c->box.lower, pointSize, color);
    } else {
      appendBox(segments, c->box, color);
    }
  }
  return segments;
}

Image<float> depthOf(const Image<FirstHit>& firstHits) {
  Image<float> depth(firstHits.width(), firstHits.height());
  std::transform(firstHits.begin(), firstHits.end(), depth.begin(), [](const FirstHit& hit) { return hit.distance; });
  return depth;
}

void drawSegments(ImageRgba8& image, const Image<float>& depth, const Camera& camera,
                  std::span<const Segment> segments) {
  assert(image.width() == depth.width() && image.height() == depth.height());
  Canvas canvas(image, depth, camera);
  for (const Segment& segment : segments) canvas.draw(segment);
}

}  // namespace cellcut
