#include "renderer/sampling/facing.h"

#include "renderer/base/octahedral.h"

#include <array>

namespace cellcut {
namespace {

/// Rounding of a normal's coordinates, radians: normals on a border may be counted to either side.
constexpr float kRounding = 1e-5f;

Vec3 corner(std::size_t x, std::size_t y) {
  constexpr float kStep = 2.0f / kFacingsPerSide;
  return fromOctahedral({static_cast<float>(x) * kStep - 1, static_cast<float>(y) * kStep - 1});
}

std::size_t toSquare(float coordinate) {
  const auto square = static_cast<int>((0.5f * coordinate + 0.5f) * kFacingsPerSide);
  return static_cast<std::size_t>(std::clamp(square, 0, static_cast<int>(kFacingsPerSide) - 1));
}

}  // namespace

std::size_t facingOf(const Vec3& n) {
  const Vec2 p = octahedral(n);
  return toSquare(p.y) * kFacingsPerSide + toSquare(p.x);
}

Facing facing(std::size_t i) {
  const std::size_t x = i % kFacingsPerSide, y = i / kFacingsPerSide;
  const std::array corners{corner(x, y), corner(x + 1, y), corner(x, y + 1), corner(x + 1, y + 1)};
  const Vec3 axis = glm::normalize(corners[0] + corners[1] + corners[2] + corners[3]);
  // The map's lines are great circles, also where a square is folded along its diagonal: the corners are farthest.
  float chord = 0;
  for (const Vec3& c : corners) chord = std::max(chord, glm::length(c - axis));
  const float spread = 2 * std::asin(0.5f * chord) + kRounding;
  return {axis, std::cos(spread), std::sin(spread)};
}

}  // namespace cellcut
