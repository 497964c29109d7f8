/// \file flip_color.h
/// The colour spaces of ꟻLIP. Tristimulus values are relative to white, so that white is (1, 1, 1) in each of them.
///
/// Source: Andersson et al. 2020, section 4.1; CIE 15:2004 for L*a*b*.
#pragma once

#include "renderer/base/math.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace cellcut::flip {

/// Linear Rec. 709 RGB → XYZ / white, from the primaries and D65 of the standard: each row of RGB → XYZ over its sum.
inline const glm::mat3 kXyzFromRgb =
    glm::transpose(glm::mat3(glm::dmat3{10135552.0 / 23359437, 8788810.0 / 23359437, 4435075.0 / 23359437,  //
                                        2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897,    //
                                        1425312.0 / 80288307, 8788810.0 / 80288307, 70074185.0 / 80288307}));
inline const glm::mat3 kRgbFromXyz = glm::inverse(kXyzFromRgb);

/// Opponent space in which contrast sensitivity is measured: luma, red-green, blue-yellow; linear in RGB.
inline Vec3 opponentFromRgb(const Vec3& rgb) {
  const Vec3 xyz = kXyzFromRgb * rgb;
  return {116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z)};
}

inline Vec3 rgbFromOpponent(const Vec3& opponent) {
  const float y = (opponent.x + 16) / 116;
  return kRgbFromXyz * Vec3(y + opponent.y / 500, y, y - opponent.z / 200);
}

/// L*a*b* with the Hunt effect: chroma counts in proportion to lightness.
inline Vec3 huntLabFromRgb(const Vec3& rgb) {
  constexpr float kDelta = 6.0f / 29;
  const auto f = [](float t) {
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0f / 29;
  };
  const Vec3 xyz = kXyzFromRgb * rgb;
  const float fy = f(xyz.y);
  const float lightness = 116 * fy - 16;
  const float hunt = 0.01f * lightness;
  return {lightness, hunt * 500 * (f(xyz.x) - fy), hunt * 200 * (fy - f(xyz.z))};
}

/// Distance for large differences of colour: city block between lightnesses, Euclidean between chromas.
/// Source: Abasi, Tehran and Fairchild 2020, doi:10.1002/col.22451.
inline float hyab(const Vec3& a, const Vec3& b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

}  // namespace cellcut::flip
