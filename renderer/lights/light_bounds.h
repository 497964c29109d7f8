/// \file light_bounds.h
/// What a cluster of lights can send where: a box, a cone of emission axes and a peak intensity.
///
/// Source: Conty Estevez and Kulla 2018, section 4, doi:10.1145/3233305; intensities instead of fluxes.
#pragma once

#include "renderer/base/math.h"
#include "renderer/lights/lights.h"

#include <vector>

namespace cellcut {

/// Directions within `theta` of an axis, by cosine and sine of theta.
struct Cone {
  Vec3 axis{0, 0, 1};  ///< unit
  float cosTheta = 1;
  float sinTheta = 0;
};

/// The smallest cone around both, or all directions. No NaN for opposite axes.
Cone coneUnion(const Cone& a, const Cone& b);

/// Bounds of one light or of a cluster. Local lights have a box; distant ones (directional, environment tiles) have
/// none.
struct LightBounds {
  Bounds box;
  Cone axes;            ///< emission axes: where the lights shine
  float cosThetaE = 0;  ///< emission reaches this angle past the axes; [0, π/2]
  float intensity =
      0;  ///< peak J, ≥ 0, in the unit that the maker chose: of W/sr for local lights, of W/m² for distant ones
  bool twoSided = false;  ///< some light also shines along its negative axis
};

LightBounds merge(const LightBounds& a, const LightBounds& b);

/// Peak J of a light (scalar emission), the unit as in LightBounds. In double: what is left of tiny triangles of tiny
/// radiance.
double peakIntensity(const Lights& lights, LightId light);

/// Bounds of each light of one group; J in units of 2^exponent W/sr or W/m².
std::vector<LightBounds> localBounds(const Lights& lights, int exponent);  ///< point, spot, triangle, in LightId order
std::vector<LightBounds> distantBounds(const Lights& lights, int exponent);  ///< directional, environment tiles

/// Exponent of the power of two just below ΣJ over all lights; 0 without light. In its units intensities of 1e-30 and
/// of 1e30 keep all digits.
int intensityExponent(const Lights& lights);

/// cos(max(0, a − b)) for angles in [0, π] given by cosine and sine.
inline float cosSubClamped(float cosA, float sinA, float cosB, float sinB) {
  return cosA >= cosB ? 1.0f : cosA * cosB + sinA * sinB;
}
/// sin(max(0, a − b)).
inline float sinSubClamped(float cosA, float sinA, float cosB, float sinB) {
  return cosA >= cosB ? 0.0f : sinA * cosB - cosA * sinB;
}

}  // namespace cellcut
