/// \file facing.h
/// Surface normals by the part of the sphere that they fall into: what a cell keeps for surfaces that face about one
/// way.
#pragma once

#include "renderer/base/math.h"

#include <cstddef>

namespace cellcut {

/// Squares of the octahedral map, per side. With 16 no normal is more than 15° from the middle of its facing.
inline constexpr std::size_t kFacingsPerSide = 16;
inline constexpr std::size_t kFacings = kFacingsPerSide * kFacingsPerSide;

struct Facing {
  Vec3 axis;                   ///< unit, in the middle
  float cosSpread, sinSpread;  ///< every normal of the facing is within this angle of the axis; below π/2
};

/// \param n  unit
std::size_t facingOf(const Vec3& n);
/// \pre i < kFacings
Facing facing(std::size_t i);

}  // namespace cellcut
