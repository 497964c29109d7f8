/// \file convergence.h
/// Errors along a rendering: at a given time, how fast they fall, and what is worth its time.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace cellcut {

/// A measurement: `y` after `x` (seconds, or samples per pixel).
struct CurvePoint {
  double x = 0;  ///< > 0
  double y = 0;  ///< ≥ 0
};

/// y at x on the broken line through the points on logarithmic axes, on which a Monte Carlo error is straight; linear
/// in y where one of the two ends is 0. Outside of the points the nearest one: what was not measured is not claimed.
/// \pre at least one point, x ascending
double interpolateLogLog(std::span<const CurvePoint> curve, double x);

/// Exponent of y ∝ xᵖ by least squares on logarithmic axes: −1 for the squared error of independent samples. Points
/// with y = 0 are left out; NaN with fewer than two.
double logLogSlope(std::span<const CurvePoint> points);

/// Indices of the points that no other one beats in one coordinate without being worse in the other, by ascending x.
std::vector<std::size_t> paretoFront(std::span<const CurvePoint> points);

}  // namespace cellcut
