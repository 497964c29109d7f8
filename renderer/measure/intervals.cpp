#include "renderer/measure/intervals.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace cellcut {
namespace {

/// The continued fraction of the incomplete beta function, by Lentz' method.
/// Source: Press et al. 2007, "Numerical Recipes", section 6.4.
double betaFraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300;
  constexpr int kMostTerms = 10000;  // O(√max(a, b)) are needed
  const auto away = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
  double c = 1, d = 1 / away(1 - (a + b) * x / (a + 1)), h = d;
  for (int m = 1; m <= kMostTerms; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1 / away(1 + even * d);
    c = away(1 + even / c);
    h *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / away(1 + odd * d);
    c = away(1 + odd / c);
    h *= d * c;
    if (std::abs(d * c - 1) < std::numeric_limits<double>::epsilon()) break;
  }
  return h;
}

/// Regularised incomplete beta function I_x(a, b).
double incompleteBeta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
  return x < (a + 1) / (a + b + 2) ? front * betaFraction(a, b, x) / a : 1 - front * betaFraction(b, a, 1 - x) / b;
}

}  // namespace

double studentCdf(double t, double degreesOfFreedom) {
  assert(degreesOfFreedom > 0);
  const double tail = 0.5 * incompleteBeta(0.5 * degreesOfFreedom, 0.5, degreesOfFreedom / (degreesOfFreedom + t * t));
  return t > 0 ? 1 - tail : tail;
}

double studentQuantile(double p, double degreesOfFreedom) {
  assert(p > 0 && p < 1);
  if (p < 0.5) return -studentQuantile(1 - p, degreesOfFreedom);
  double low = 0, high = 1;
  while (studentCdf(high, degreesOfFreedom) < p && high < 1e300) high *= 2;
  for (int i = 0; i < 200 && low < high; ++i) {  // to the last bit of a double
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (studentCdf(middle, degreesOfFreedom) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Estimate estimateMean(std::span<const double> values, double confidence) {
  assert(!values.empty());
  const auto n = static_cast<double>(values.size());
  double mean = 0;
  for (const double v : values) mean += v / n;
  if (values.size() < 2) {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    return {mean, kUnknown, kUnknown};
  }
  double squares = 0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  const double half = studentQuantile(0.5 + 0.5 * confidence, n - 1) * std::sqrt(squares / (n * (n - 1)));
  return {mean, mean - half, mean + half};
}

Estimate estimatePositive(std::span<const double> values, double confidence) {
  if (!std::all_of(values.begin(), values.end(), [](double v) { return v > 0; }))
    return estimateMean(values, confidence);
  std::vector<double> logarithms;
  logarithms.reserve(values.size());
  for (const double v : values) logarithms.push_back(std::log(v));
  const Estimate estimate = estimateMean(logarithms, confidence);
  return {std::exp(estimate.value), std::exp(estimate.low), std::exp(estimate.high)};
}

}  // namespace cellcut
