#include "renderer/base/warp.h"

namespace cellcut {
namespace {

/// Angle between unit vectors, precise near 0 and π. Source: Kahan 2006.
float angleBetween(const Vec3& a, const Vec3& b) {
  return glm::dot(a, b) < 0 ? kPi - 2 * std::asin(std::min(1.0f, 0.5f * glm::length(a + b)))
                            : 2 * std::asin(std::min(1.0f, 0.5f * glm::length(b - a)));
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

float sphericalTriangleArea(const std::array<Vec3, 3>& c) {
  // The triple product of differences keeps its digits where the corners are close together.
  const float triple = glm::dot(c[0], glm::cross(c[1] - c[0], c[2] - c[0]));
  const float denominator = 1 + glm::dot(c[0], c[1]) + glm::dot(c[1], c[2]) + glm::dot(c[2], c[0]);
  return std::abs(2 * std::atan2(triple, denominator));
}

std::optional<Vec3> uniformSphericalTriangle(const std::array<Vec3, 3>& c, Vec2 u) {
  const auto [a, b, d] = c;
  const Vec3 nAb = glm::cross(a, b), nBc = glm::cross(b, d), nCa = glm::cross(d, a);
  const float lAb = glm::length(nAb), lBc = glm::length(nBc), lCa = glm::length(nCa);
  if (lAb == 0 || lBc == 0 || lCa == 0) return std::nullopt;

  const Vec3 uAb = nAb / lAb, uBc = nBc / lBc, uCa = nCa / lCa;
  const float alpha = angleBetween(uAb, -uCa);
  const float beta = angleBetween(uBc, -uAb);
  const float gamma = angleBetween(uCa, -uBc);

  // A sub-triangle of area u₀ · A fixes the point C' on the edge AC.
  const float areaPlusPi = kPi + u.x * (alpha + beta + gamma - kPi);
  const float cosAlpha = std::cos(alpha), sinAlpha = std::sin(alpha);
  const float sinPhi = std::sin(areaPlusPi) * cosAlpha - std::cos(areaPlusPi) * sinAlpha;
  const float cosPhi = std::cos(areaPlusPi) * cosAlpha + std::sin(areaPlusPi) * sinAlpha;
  const float k1 = cosPhi + cosAlpha;
  const float k2 = sinPhi - sinAlpha * glm::dot(a, b);
  float cosB = (k2 + (k2 * cosPhi - k1 * sinPhi) * cosAlpha) / ((k2 * sinPhi + k1 * cosPhi) * sinAlpha);
  if (!std::isfinite(cosB)) return std::nullopt;
  cosB = std::clamp(cosB, -1.0f, 1.0f);

  const Vec3 towardsC = d - glm::dot(d, a) * a;
  const Vec3 cPrime = cosB * a + safeSqrt(1 - cosB * cosB) * glm::normalize(towardsC);
  const float cosTheta = 1 - u.y * (1 - glm::dot(cPrime, b));
  const Vec3 towardsCPrime = cPrime - glm::dot(cPrime, b) * b;
  const float length = glm::length(towardsCPrime);
  if (length == 0) return b;
  return glm::normalize(cosTheta * b + safeSqrt(1 - cosTheta * cosTheta) * (towardsCPrime / length));
}

}  // namespace cellcut
