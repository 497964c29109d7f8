#include "renderer/measure/convergence.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace cellcut {

double interpolateLogLog(std::span<const CurvePoint> curve, double x) {
  assert(!curve.empty());
  if (!(x > curve.front().x)) return curve.front().y;
  if (x >= curve.back().x) return curve.back().y;
  const auto after =
      std::upper_bound(curve.begin(), curve.end(), x, [](double v, const CurvePoint& p) { return v < p.x; });
  const CurvePoint a = *(after - 1), b = *after;
  const double t = std::log(x / a.x) / std::log(b.x / a.x);
  if (a.y > 0 && b.y > 0) return a.y * std::pow(b.y / a.y, t);
  return a.y + t * (b.y - a.y);
}

double logLogSlope(std::span<const CurvePoint> points) {
  double n = 0, meanX = 0, meanY = 0;
  const auto isUsed = [](const CurvePoint& p) { return p.x > 0 && p.y > 0; };
  for (const CurvePoint& p : points) {
    if (!isUsed(p)) continue;
    ++n;
    meanX += std::log(p.x);
    meanY += std::log(p.y);
  }
  meanX /= n;
  meanY /= n;
  double xx = 0, xy = 0;
  for (const CurvePoint& p : points) {
    if (!isUsed(p)) continue;
    const double x = std::log(p.x) - meanX;
    xx += x * x;
    xy += x * (std::log(p.y) - meanY);
  }
  return n >= 2 && xx > 0 ? xy / xx : std::numeric_limits<double>::quiet_NaN();
}

std::vector<std::size_t> paretoFront(std::span<const CurvePoint> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].x != points[b].x ? points[a].x < points[b].x : points[a].y < points[b].y;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    if (front.empty() || points[i].y < points[front.back()].y) front.push_back(i);
  }
  return front;
}

}  // namespace cellcut
