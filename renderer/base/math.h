/// \file math.h
/// Vectors (GLM), colour and the few formulas that every room uses.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace cellcut {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kInvPi = std::numbers::inv_pi_v<float>;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Rec. 709 luminance of linear RGB. Unit in, unit out.
template <class T>
constexpr T luminance(const glm::vec<3, T, glm::defaultp>& rgb) {
  return T(0.2126) * rgb.x + T(0.7152) * rgb.y + T(0.0722) * rgb.z;
}

inline bool isFinite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline bool isBlack(const Vec3& v) {
  return v.x == 0 && v.y == 0 && v.z == 0;
}
inline float maxComponent(const Vec3& v) {
  return std::max({v.x, v.y, v.z});
}
inline float safeSqrt(float x) {
  return std::sqrt(std::max(0.0f, x));
}

/// The next float towards +∞. \pre x is finite
inline float nextFloatUp(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x + 0.0f);  // −0 becomes +0
  return std::bit_cast<float>(x < 0 ? bits - 1 : bits + 1);
}

/// Relative error bound of n chained float operations, n·u / (1 − n·u) with the unit round-off u = 2⁻²⁴.
/// Source: Higham, Accuracy and Stability of Numerical Algorithms, section 3.1; pbrt 4th ed. section 6.8.1.
constexpr float gammaBound(int n) {
  constexpr float u = std::numeric_limits<float>::epsilon() / 2;
  return static_cast<float>(n) * u / (1 - static_cast<float>(n) * u);
}

/// Orthonormal frame around a unit vector. Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
struct Frame {
  Vec3 x, y, z;

  explicit Frame(const Vec3& unitZ) : z(unitZ) {
    const float sign = std::copysign(1.0f, z.z);
    const float a = -1 / (sign + z.z);
    const float b = z.x * z.y * a;
    x = {1 + sign * z.x * z.x * a, sign * b, -sign * z.x};
    y = {b, sign + z.y * z.y * a, -z.y};
  }
  Vec3 toLocal(const Vec3& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
  Vec3 toWorld(const Vec3& v) const { return v.x * x + v.y * y + v.z * z; }
};

/// Axis-aligned box; empty until something is added.
template <class Point>
struct BoundsOf {
  using Real = typename Point::value_type;
  Point lower{std::numeric_limits<Real>::infinity()};
  Point upper{-std::numeric_limits<Real>::infinity()};

  bool empty() const { return lower.x > upper.x; }
  void add(const Point& p) {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  void add(const BoundsOf& b) {
    lower = glm::min(lower, b.lower);
    upper = glm::max(upper, b.upper);
  }
  /// Bit k says whether coordinate k is the upper one. \pre bits < 8
  Point corner(unsigned bits) const {
    return {(bits & 1 ? upper : lower).x, (bits & 2 ? upper : lower).y, (bits & 4 ? upper : lower).z};
  }
  /// The origin when empty.
  Point centre() const { return empty() ? Point(0) : Real{0.5} * lower + Real{0.5} * upper; }
  /// Half of the diagonal: the radius of the smallest sphere around centre() that holds the box; 0 when empty.
  Real radius() const { return empty() ? Real{0} : glm::length(Real{0.5} * upper - Real{0.5} * lower); }
};
using Bounds = BoundsOf<Vec3>;
/// Before positions are floats around a middle of the scene.
using DoubleBounds = BoundsOf<glm::dvec3>;

}  // namespace cellcut
