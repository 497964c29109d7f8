#include "tests/support/statistics.h"

#include "tests/support/depth.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace cellcut::test {
namespace {

/// Of that many tests, about. Their seeds were seen to pass with all samples; a sixteenth is another draw of them all,
/// one of which fails an honest build at the level of a single test.
constexpr std::size_t kAllComparisons = 1000;

/// Lower regularised gamma function by its series; converges for x < a + 1.
double gammaSeries(double a, double x) {
  double term = 1 / a, sum = term;
  for (int n = 1; term > sum * 1e-16; ++n) sum += term *= x / (a + n);
  return sum * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

/// Upper regularised gamma function by its continued fraction (Lentz); converges for x ≥ a + 1.
double gammaFraction(double a, double x) {
  constexpr double tiny = 1e-300;
  double b = x + 1 - a, c = 1 / tiny, d = 1 / b, h = d;
  for (int k = 1; k < 100000; ++k) {
    const double i = k;
    const double an = -i * (i - a);
    b += 2;
    d = 1 / (std::abs(an * d + b) < tiny ? tiny : an * d + b);
    c = b + an / c;
    if (std::abs(c) < tiny) c = tiny;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-15) break;
  }
  return h * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

}  // namespace

double normalTwoSidedTail(double z) {
  return std::erfc(std::abs(z) / std::numbers::sqrt2);
}

double normalCritical(double alpha) {
  double low = 0, high = 40;
  while (high - low > 1e-12) {
    const double middle = 0.5 * (low + high);
    (normalTwoSidedTail(middle) > alpha ? low : high) = middle;
  }
  return high;
}

double sidak(double alpha, std::size_t comparisons) {
  const std::size_t all = isSixteenth() ? kAllComparisons * comparisons : comparisons;
  return -std::expm1(std::log1p(-alpha) / static_cast<double>(all));
}

double criticalZ(std::size_t comparisons) {
  return normalCritical(sidak(kAlpha, comparisons));
}

double chiSquareTail(double x, double degreesOfFreedom) {
  if (degreesOfFreedom <= 0 || x <= 0) return 1;
  const double a = 0.5 * degreesOfFreedom, half = 0.5 * x;
  return half < a + 1 ? 1 - gammaSeries(a, half) : gammaFraction(a, half);
}

ChiSquare chiSquareTest(std::span<const std::uint64_t> counts, std::span<const double> expected) {
  assert(counts.size() == expected.size());
  const auto n = static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}));
  const double scale = n / std::accumulate(expected.begin(), expected.end(), 0.0);
  ChiSquare result;
  double pooledCount = 0, pooledExpected = 0, bins = 0;
  const auto add = [&](double count, double expectation) {
    result.statistic += (count - expectation) * (count - expectation) / expectation;
    ++bins;
  };
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (!(expected[i] > 0)) {
      result.impossible += counts[i];
    } else if (expected[i] * scale < 5) {
      pooledCount += static_cast<double>(counts[i]);
      pooledExpected += expected[i] * scale;
    } else {
      add(static_cast<double>(counts[i]), expected[i] * scale);
    }
  }
  // A pool that itself expects little is as far from χ² as its bins were.
  if (pooledExpected >= 5) add(pooledCount, pooledExpected);
  result.degreesOfFreedom = bins - 1;
  result.p = chiSquareTail(result.statistic, result.degreesOfFreedom);
  return result;
}

double zScore(double a, double varianceOfA, double b, double varianceOfB) {
  if (a == b) return 0;
  const double variance = varianceOfA + varianceOfB;
  return variance > 0 ? (a - b) / std::sqrt(variance) : std::numeric_limits<double>::infinity();
}

}  // namespace cellcut::test
