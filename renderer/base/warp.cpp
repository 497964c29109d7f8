#include "renderer/base/warp.h"

namespace cellcut {
namespace {

using DVec3 = glm::dvec3;

/// Angle between unit vectors, precise near 0 and π. Source: Kahan 2006.
double angleBetween(const DVec3& a, const DVec3& b) {
  return glm::dot(a, b) < 0 ? std::numbers::pi - 2 * std::asin(std::min(1.0, 0.5 * glm::length(a + b)))
                            : 2 * std::asin(std::min(1.0, 0.5 * glm::length(b - a)));
}

}  // namespace

Vec2 concentricDisk(Vec2 u) {
  const Vec2 offset = 2.0f * u - Vec2(1);
  if (offset.x == 0 && offset.y == 0) return Vec2(0);
  const bool horizontal = std::abs(offset.x) > std::abs(offset.y);
  const float r = horizontal ? offset.x : offset.y;
  const float theta = horizontal ? kPi / 4 * (offset.y / offset.x) : kPi / 2 - kPi / 4 * (offset.x / offset.y);
  return {r * std::cos(theta), r * std::sin(theta)};
}

Vec3 cosineHemisphere(Vec2 u) {
  const Vec2 d = concentricDisk(u);
  return {d.x, d.y, safeSqrt(1 - d.x * d.x - d.y * d.y)};
}

Vec2 uniformTriangle(Vec2 u) {
  if (u.x < u.y) return {0.5f * u.x, u.y - 0.5f * u.x};
  return {u.x - 0.5f * u.y, 0.5f * u.y};
}

// In double: from close to an edge its ends are all but opposite, where float sums of angles and triple products are
// right to 10⁻³ only.
float sphericalTriangleArea(const std::array<glm::dvec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  // The triple product of differences keeps its digits where the corners are close together.
  const double triple = glm::dot(a, glm::cross(b - a, c - a));
  const double denominator = 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a);
  return static_cast<float>(std::abs(2 * std::atan2(triple, denominator)));
}

std::optional<Vec3> uniformSphericalTriangle(const std::array<glm::dvec3, 3>& corners, Vec2 u) {
  const DVec3 a = glm::normalize(DVec3(corners[0])), b = glm::normalize(DVec3(corners[1])),
              c = glm::normalize(DVec3(corners[2]));
  const DVec3 nAb = glm::cross(a, b), nBc = glm::cross(b, c), nCa = glm::cross(c, a);
  const double lAb = glm::length(nAb), lBc = glm::length(nBc), lCa = glm::length(nCa);
  if (lAb == 0 || lBc == 0 || lCa == 0) return std::nullopt;

  const DVec3 uAb = nAb / lAb, uBc = nBc / lBc, uCa = nCa / lCa;
  const double alpha = angleBetween(uAb, -uCa);
  const double beta = angleBetween(uBc, -uAb);
  const double gamma = angleBetween(uCa, -uBc);

  // A sub-triangle of area u₀ · A fixes the point C' on the edge AC.
  const double areaPlusPi = std::numbers::pi + static_cast<double>(u.x) * (alpha + beta + gamma - std::numbers::pi);
  const double cosAlpha = std::cos(alpha), sinAlpha = std::sin(alpha);
  const double cosArea = std::cos(areaPlusPi), sinArea = std::sin(areaPlusPi);
  const double sinPhi = sinArea * cosAlpha - cosArea * sinAlpha;
  const double cosPhi = cosArea * cosAlpha + sinArea * sinAlpha;
  const double k1 = cosPhi + cosAlpha;
  const double k2 = sinPhi - sinAlpha * glm::dot(a, b);
  double cosB = (k2 + (k2 * cosPhi - k1 * sinPhi) * cosAlpha) / ((k2 * sinPhi + k1 * cosPhi) * sinAlpha);
  if (!std::isfinite(cosB)) return std::nullopt;
  cosB = std::clamp(cosB, -1.0, 1.0);

  const DVec3 towardsC = c - glm::dot(c, a) * a;
  const DVec3 cPrime = cosB * a + std::sqrt(1 - cosB * cosB) * glm::normalize(towardsC);
  const double cosTheta = 1 - static_cast<double>(u.y) * (1 - glm::dot(cPrime, b));
  const DVec3 towardsCPrime = cPrime - glm::dot(cPrime, b) * b;
  const double length = glm::length(towardsCPrime);
  if (length == 0) return Vec3(b);
  const double sinTheta = std::sqrt(std::max(0.0, 1 - cosTheta * cosTheta));
  return Vec3(glm::normalize(cosTheta * b + sinTheta * (towardsCPrime / length)));
}

}  // namespace cellcut
