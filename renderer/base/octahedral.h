/// \file octahedral.h
/// Unit vector ↔ two coordinates in [−1, 1]. Source: Cigolle et al. 2014, "A Survey of Efficient Representations for
/// Independent Unit Vectors".
#pragma once

#include "renderer/base/math.h"

namespace cellcut {

inline Vec2 octahedral(const Vec3& unit) {
  const float sum = std::abs(unit.x) + std::abs(unit.y) + std::abs(unit.z);
  const Vec2 p = Vec2(unit.x, unit.y) / sum;
  if (unit.z >= 0) return p;
  return {std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y)};
}

inline Vec3 fromOctahedral(Vec2 p) {
  Vec3 v(p.x, p.y, 1 - std::abs(p.x) - std::abs(p.y));
  if (v.z < 0) {
    v.x = std::copysign(1 - std::abs(p.y), p.x);
    v.y = std::copysign(1 - std::abs(p.x), p.y);
  }
  return glm::normalize(v);
}

}  // namespace cellcut
