/// \file intervals.h
/// Confidence intervals of what was measured in a few independent runs.
#pragma once

#include <span>

namespace cellcut {

/// A value with the interval that holds its long-run value with a given confidence. Without at least two numbers the
/// bounds are NaN: nothing is known of the spread.
struct Estimate {
  double value = 0;
  double low = 0;
  double high = 0;
};

inline constexpr double kConfidence = 0.95;

/// P(T ≤ t) of Student's distribution.
/// \pre degreesOfFreedom > 0
double studentCdf(double t, double degreesOfFreedom);

/// The t with P(T ≤ t) = p.
/// \pre 0 < p < 1, degreesOfFreedom > 0
double studentQuantile(double p, double degreesOfFreedom);

/// Mean of the numbers with Student's interval: for what may be negative, as a slope.
/// \pre at least one number
Estimate estimateMean(std::span<const double> values, double confidence = kConfidence);

/// Geometric mean with Student's interval of the logarithms: for errors and for times.
///
/// Errors are positive, skewed towards large values (a rare bright path makes one run worse, none makes it much
/// better), compared by their ratios and drawn on logarithmic axes. On that scale a few runs are much nearer to a
/// normal distribution, a bound is never negative, and the intervals of relMSE and of its root say the same. Where a
/// number is not positive, which an error is only without any noise, it is estimateMean().
/// \pre at least one number
Estimate estimatePositive(std::span<const double> values, double confidence = kConfidence);

}  // namespace cellcut
