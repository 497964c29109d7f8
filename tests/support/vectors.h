/// \file vectors.h
/// Vectors in tests: compared, and drawn at random.
#pragma once

#include "renderer/base/math.h"
#include "renderer/base/rng.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cellcut::test {

/// Floats of size 1 after a few roundings.
inline constexpr float kRounding = 1e-6f;
inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

inline void expectNear(const Vec3& a, const Vec3& b, float tolerance = kRounding) {
  EXPECT_LE(glm::length(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

/// A direction, all equally probable.
inline Vec3 randomUnit(Rng& rng) {
  const float z = rng.uniform(-1, 1), phi = rng.uniform(0, 2 * kPi), r = safeSqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace cellcut::test
